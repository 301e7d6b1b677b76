// The committed table of what every step's shaders read and write is what the modules say.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "solver/step_row.h"

namespace drape {
namespace {

TEST(StepDocument, IsWhatTheModulesSay) {
    std::ifstream file(DRAPE_SOURCE_DIR "/engine/docs/passes.md");
    const std::string committed{std::istreambuf_iterator<char>(file), {}};
    EXPECT_TRUE(committed == step_document()) << "build/drape graph --steps > engine/docs/passes.md";
}

TEST(StepRows, StandByTheirKindsAndHaveEveryKernelOnce) {
    ASSERT_EQ(step_rows().size(), step_kind_count);
    for (std::size_t k = 0; k < step_kind_count; ++k) {
        const StepRow& row = step_rows()[k];
        EXPECT_EQ(row.kind, static_cast<StepKind>(k));
        for (const KernelRow& kernel : row.kernels)
            EXPECT_EQ(std::ranges::count(row.kernels, kernel.kernel, &KernelRow::kernel), 1) << kernel.shader;
    }
}

}  // namespace
}  // namespace drape
