// Sewn cloths on the device equal their twin bit for bit (lavapipe), and copies of a sewn particle each other.
#include "cloth/cloth_statistics.h"
#include "cloth/texels.h"
#include "support/sewn_scenes.h"
#include "twin_comparison.h"
#include "world/seams.h"

namespace drape {
namespace {

using test::compare;
using test::frame_count;
using test::three_panels;
using test::tube;
using test::two_panels;

class TwinSeamTest : public ::testing::TestWithParam<SolverMethod> {};

TEST_P(TwinSeamTest, TwoPanels) { compare(two_panels(GetParam())); }

TEST_P(TwinSeamTest, ThreePanelsWithCollidersAndPins) { compare(three_panels(GetParam())); }

TEST_P(TwinSeamTest, ThreeIterationsWithHoles) {
    SceneDescription scene = three_panels(GetParam());
    scene.solver.iterations = 3;
    scene.cloths[0].holes = {{{4, 5}, {8, 11}}};
    scene.cloths[1].damping = 0.7;
    compare(scene);
}

TEST_P(TwinSeamTest, ATube) {
    compare(tube(GetParam()));
    SceneDescription touched = tube(GetParam());
    touched.colliders = {{Sphere{{0.15, -0.2, 0}, 0.06}, 0.3}};
    compare(touched);
}

TEST_P(TwinSeamTest, UnlikePanels) {
    SceneDescription scene = test::unlike_panels(GetParam());
    compare(scene);
    scene.cloths[1].loads = {{.particles = {{0, 0}, {20, 8}}, .force = {{0, 0.4, 0.3}}}};
    scene.solver.iterations = 2;
    compare(scene);
}

TEST_P(TwinSeamTest, SeamsThatRip) {
    SceneDescription ring = tube(GetParam());
    ring.cloths[0].pins = {test::pin_box(6, 0, 18, 0)};
    ring.seams[0].rip = 0.5;
    for (SceneDescription scene : {test::pulled_strip(GetParam(), 60, 3), test::opening_seam(GetParam(), 1), ring}) {
        scene.wind.velocity = {1, 0.3, -2};
        const SimulationModel model(scene);
        Twin twin(model);
        for (std::uint32_t frame = 1; frame <= frame_count; ++frame) twin.run_frame(frame);
        EXPECT_GT(seam_statistics(model.cloths[0], twin.cloth(0).bytes(Field::seam_loads)).ripped, 2u);
        compare(scene);
    }
}

TEST_P(TwinSeamTest, SeamsThatClose) {
    compare(test::unlike_panels(GetParam(), 0.06));
    SceneDescription alike = three_panels(GetParam());
    alike.cloths[1].pins.clear();
    alike.cloths[1].placement.origin[1] += 0.05;
    alike.seams.front().close = 0.05;
    compare(alike);
}

TEST_P(TwinSeamTest, GravityThatChanges) {
    for (SceneDescription scene : {three_panels(GetParam()), test::unlike_panels(GetParam(), 0.06), tube(GetParam())}) {
        scene.gravity_keys = {{0, {0, 0, 0}}, {0.05, {0.4, -12, 0}}, {0.2, {0, -3, 1}}};
        compare(scene);
    }
}

TEST_P(TwinSeamTest, CopiesOfAParticleStayTheSame) {
    for (const SceneDescription& scene : {two_panels(GetParam()), three_panels(GetParam()), tube(GetParam())}) {
        const SimulationModel model(scene);
        Twin twin(model);
        const std::vector<SewnStation> stations = sewing_of(model.scene).stations;
        ASSERT_FALSE(stations.empty());
        for (std::uint32_t frame = 1; frame <= frame_count; ++frame) {
            twin.run_frame(frame);
            for (const auto& [group, close, rip] : stations)
                for (const SewnMember& member : group) {
                    const auto at = [&](const SewnMember& which, Field field) {
                        return xyz(twin.cloth(which.cloth)[field][which.particle]);
                    };
                    for (const Field field : {Field::position, Field::displacement}) {
                        const glsl::vec3 own = at(member, field), leader = at(group.front(), field);
                        ASSERT_TRUE(own.x == leader.x && own.y == leader.y && own.z == leader.z)
                            << "frame " << frame << ", cloth " << member.cloth << ", particle " << member.particle;
                    }
                }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, TwinSeamTest,
                         ::testing::Values(SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps),
                         [](const auto& method) { return std::string(named(method.param).name); });

}  // namespace
}  // namespace drape
