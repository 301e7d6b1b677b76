// Hands that take particles, move them and let them go do so on the device and in the twin alike, bit for bit.
#include "twin_comparison.h"

namespace drape {
namespace {

using test::everything;
using test::everything_in_lines;
using test::free_lines;

/// A hand on the first cloth takes particles in frame 4 and lets them go in frame 11; a pin that was released takes its
/// own again in frame 14.
void act_by_hand(SimulationModel& model, std::uint32_t frame) {
    const double now = (frame - 1) / model.scene.time.fps;
    for (DynamicPin& pin : model.cloths[0].dynamic_pins) {
        if (!pin.hand && pin.number == 1 && frame == 14) {
            pin.release.reset();
            pin.follows = true;
        }
        if (!pin.hand) continue;
        pin.path.keys = {{0, {0.1, 0.2, 0}, {}}, {0.3, {0.2, 0.4, 0.1}, {0, 40, 20}}};
        if (frame == 4) {
            pin.release.reset();
            pin.follows = true;
            pin.held = {{10, 12}, {14, 20}};
        }
        if (frame == 11) {
            pin.release = now;
            pin.let_go = pin.path;
        }
    }
}

void compare_hands(const SceneDescription& scene) {
    test::compare(scene, {.holds = true, .acts = true, .hands = {0}}, test::gpu().device, {.drawing = true}, {},
                  act_by_hand);
}

TEST(TwinHandsTest, Relaxing) { compare_hands(everything()); }

TEST(TwinHandsTest, InLines) { compare_hands(everything_in_lines()); }

TEST(TwinHandsTest, InSecondOrderOfTwoCloths) {
    SceneDescription scene = free_lines();
    test::add_second_cloth(scene);
    compare_hands(scene);
}

TEST(TwinHandsTest, Explicitly) {
    SceneDescription scene = everything();
    scene.solver.method = SolverMethod::explicit_steps;
    compare_hands(scene);
}

}  // namespace
}  // namespace drape
