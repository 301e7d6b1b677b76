// main of every test program: the device of its tests, and of the programs that they start.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

#ifdef DRAPE_TEST_LAVAPIPE
constexpr bool needs_lavapipe = true;
#else
constexpr bool needs_lavapipe = false;
#endif

/// Lavapipe, whatever else is there, unless the environment variable DRAPE_TEST_DEVICE selects another as --device
/// does.
int main(int argc, char** argv) {
    const char* asked = std::getenv("DRAPE_TEST_DEVICE");
    if (needs_lavapipe && asked) std::cerr << "compares bits with the twin: on lavapipe, not on " << asked << "\n";
    setenv("DRAPE_DEVICE", asked && !needs_lavapipe ? asked : "cpu", 1);
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
