// Long runs of cloth that meets itself: fold and twist until they have settled or are wound up.
#include <gtest/gtest.h>

#include "reference/twin.h"
#include "support/self_contact_scenes.h"
#include "verify/triangle_crossings.h"

namespace drape {
namespace {

void expect_never_crossed(const SceneDescription& scene, std::uint32_t frames) {
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= frames; ++frame) {
        twin.run_frame(frame);
        const TwinCloth& state = twin.cloth(0);
        std::vector<verify::TriangleCrossings::Point> points;
        for (const glsl::vec4& x : state[Field::position]) points.push_back({double(x.x), double(x.y), double(x.z)});
        ASSERT_EQ(verify::TriangleCrossings(std::move(points), model.cloths[0].grid.triangle_indices()).count(), 0u)
            << frame;
        ASSERT_EQ(state.self.record.unproved, 0u) << frame;
    }
}

TEST(SelfContactLongTest, Fold) { expect_never_crossed(test::fold(33, 0.5, SolverMethod::line, 24), 600); }
TEST(SelfContactLongTest, ThinFold) {
    expect_never_crossed(test::fold(25, 0.1, SolverMethod::explicit_steps, 80), 300);
}
TEST(SelfContactLongTest, Twist) { expect_never_crossed(test::twist(25, 0.4, SolverMethod::line, 40, 8, 8), 600); }

}  // namespace
}  // namespace drape
