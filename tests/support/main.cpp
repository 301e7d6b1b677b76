// main of every test program: the device of its tests, and of the programs that they start.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <string>

#ifdef DRAPE_TEST_LAVAPIPE
constexpr bool needs_lavapipe = true;
#else
constexpr bool needs_lavapipe = false;
#endif

/// Lavapipe, whatever else is there, unless the environment variable DRAPE_TEST_DEVICE selects another as --device
/// does. There, programs that need lavapipe's bits are left out: 77 is ctest's code of a test that was not run.
int main(int argc, char** argv) {
    const char* const asked = std::getenv("DRAPE_TEST_DEVICE");
    const std::string device = asked ? asked : "cpu";
    setenv("DRAPE_DEVICE", device.c_str(), 1);
    testing::InitGoogleTest(&argc, argv);
    if (needs_lavapipe && device != "cpu" && !GTEST_FLAG_GET(list_tests)) {
        std::cerr << "needs lavapipe's bits: left out on " << device << "\n";
        return 77;
    }
    return RUN_ALL_TESTS();
}
