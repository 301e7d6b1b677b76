# Configures the project `beside` twice; what it has to build is the library, no test, and its own source compiles.
foreach(fetch OFF ON)
  set(build ${WORK}/beside_${fetch})
  file(REMOVE_RECURSE ${build})
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/beside -B ${build} -G Ninja -DDRAPE=${SOURCE}
                          -DFETCH=${fetch} -DDRAPE_PYTHON=OFF -DDRAPE_OPTIMISE_SHADERS=OFF COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${build} -- -t commands beside OUTPUT_VARIABLE steps
                  COMMAND_ERROR_IS_FATAL ANY)
  if(NOT steps MATCHES "libdrape[.]a" OR steps MATCHES "tests/(gpu|twin|cli)/")
    message(FATAL_ERROR "FETCH=${fetch}: the library is not built, or tests are:\n${steps}")
  endif()
endforeach()
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK}/beside_OFF -- CMakeFiles/beside.dir${SOURCE}/tools/examples/flag.cpp.o
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
