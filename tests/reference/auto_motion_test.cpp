// Method auto, closed loop and all, follows the motion of the double-precision network.
#include <gtest/gtest.h>

#include "network_scenes.h"
#include "reference/symplectic_reference.h"
#include "support/sheet_state.h"
#include "support/sheets.h"
#include "twin/twin_loop.h"

namespace drape {
namespace {

/// Returns the RMS distance (m) of cloth 0 from the reference at the end of the frame.
double motion_of(const SceneDescription& scene, std::uint32_t frames, const ReferenceRun& reference) {
    const SimulationModel model(scene);
    TwinLoop loop(model);
    std::vector<Vec3> found;
    loop.run(frames, [&](std::uint32_t frame, const Twin& twin, const FrameEffort&) {
        if (frame != frames) return;
        for (std::size_t i = 0; i < model.cloths[0].grid.particle_count(); ++i)
            found.push_back(test::position_of(twin.cloth(0), i));
    });
    return position_rms(found, reference.states[0].position);
}

TEST(AutoMotion, ASheetLetGoFromLevelSwingsAsTheReferenceDoes) {
    SceneDescription scene = test::swing(32, 100, 90);
    scene.solver = {};
    scene.solver.method = SolverMethod::automatic;
    scene.time.frame_count = 31;
    const double times[] = {0.5};
    const ReferenceRun reference = run_symplectic(SpringNetwork(scene, 0), times, {.cfl = 0.2});
    ASSERT_LE(reference.worst_error(), 1e-5);
    const double error = motion_of(scene, 30, reference);
    std::printf("[ measured ] auto, sheet of 1 m from level: %.2e m off after 0.5 s\n", error);
    EXPECT_LE(error, 5e-3);
}

}  // namespace
}  // namespace drape
