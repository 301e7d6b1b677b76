// Contact between sewn cloths on the device equals that of their twin bit for bit (lavapipe).
#include "support/sewn_scenes.h"
#include "twin_comparison.h"

namespace drape {
namespace {

using test::compare;

class TwinSewnContactTest : public ::testing::TestWithParam<SolverMethod> {};

void expect_contact(const SceneDescription& scene) { EXPECT_GT(compare(scene).most_pairs, 20u) << "nothing met"; }

TEST_P(TwinSewnContactTest, ATubeThatFallsOver) { expect_contact(test::falling_tube(GetParam())); }

TEST_P(TwinSewnContactTest, ACushion) { expect_contact(test::dropped_cushion(GetParam(), 13)); }

TEST_P(TwinSewnContactTest, WithoutColliders) {
    SceneDescription scene = test::dropped_cushion(GetParam(), 11);
    scene.colliders.clear();
    expect_contact(scene);
}

TEST_P(TwinSewnContactTest, UnlikePanelsOfUnlikeThicknessThatClose) {
    SceneDescription scene = test::folding_panels(GetParam(), true);
    scene.cloths[1].self_collision->thickness = 0.006;
    expect_contact(scene);
}

TEST_P(TwinSewnContactTest, PanelsBesideAClothOfItsOwn) {
    SceneDescription scene = test::folding_panels(GetParam(), false);
    Cloth other = scene.cloths[1];
    other.name = "other";
    other.placement = {{-0.3, 0.3, -0.2}, {1, 0, 0}, {0, 0, 1}};
    other.velocity = {0, -3, 0};
    scene.cloths.push_back(other);
    expect_contact(scene);
}

INSTANTIATE_TEST_SUITE_P(Methods, TwinSewnContactTest,
                         ::testing::Values(SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps),
                         [](const auto& method) { return std::string(named(method.param).name); });

}  // namespace
}  // namespace drape
