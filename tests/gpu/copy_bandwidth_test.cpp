// The copy that passes are held against moves memory on every device, by a command and by a pass.
#include "solver/copy_bandwidth.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "gpu_test.h"

namespace drape::test {
namespace {

TEST(CopyBandwidthTest, ACommandAndAPassBothMoveMemory) {
    for (const bool by_pass : {false, true}) {
        const double moved = copy_bandwidth(gpu().device, {by_pass, 16 << 20});
        std::printf("[ measured ] %s: %.2f GB/s\n", by_pass ? "pass" : "command", 1e-9 * moved);
        EXPECT_GT(moved, 1e6);   // a slow disk
        EXPECT_LT(moved, 1e14);  // beyond any memory
    }
}

TEST(CopyBandwidthTest, ADeviceIsMeasuredByItsKindAndHasRoomForIt) {
    const CopyRuler ruler = copy_ruler(gpu().device);
    EXPECT_EQ(ruler.by_pass, gpu().device.info().type != "cpu");
    EXPECT_GE(ruler.byte_count, 64u << 20);
    EXPECT_LE(2 * ruler.byte_count, gpu().device.budget().limit());
}

}  // namespace
}  // namespace drape::test
