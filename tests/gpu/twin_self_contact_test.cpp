// Self-contact on the device against the twin, which looks for pairs among all that there are.
#include "support/self_contact_scenes.h"
#include "twin_comparison.h"

namespace drape {
namespace {

using test::compare;

/// A sheet that starts low and fast, so that it is folded after 18 frames.
SceneDescription crumpling(std::uint32_t n, SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = test::fold(n, 0.5, method, substeps);
    scene.cloths[0].velocity = {0, -4, 0};
    return scene;
}

TEST(TwinSelfContactTest, Explicit) { compare(crumpling(17, SolverMethod::explicit_steps, 40)); }
TEST(TwinSelfContactTest, Line) { compare(crumpling(17, SolverMethod::line, 16)); }

TEST(TwinSelfContactTest, WithHolesOnAGridOfNoPowerOfTwo) {
    SceneDescription scene = crumpling(21, SolverMethod::line, 12);
    scene.cloths[0].grid = {21, 13};
    scene.cloths[0].size = {1, 0.6};
    scene.cloths[0].holes = {{{4, 3}, {9, 8}}};
    compare(scene);
}

}  // namespace
}  // namespace drape
