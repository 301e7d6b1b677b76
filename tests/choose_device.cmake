# Read by ctest before it runs anything: the device of tests that are scripts, as support/main.cpp chooses that of others.
if(DEFINED ENV{DRAPE_TEST_DEVICE})
  set(ENV{DRAPE_DEVICE} "$ENV{DRAPE_TEST_DEVICE}")
else()
  set(ENV{DRAPE_DEVICE} cpu)
endif()
