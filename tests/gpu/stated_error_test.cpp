// The error that method `auto` states of its motion is held against runs with so many substeps that their own error is
// small: scenes in which it once stated a third of the error and less, or refined until the motion was worse.
#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "drape/scene_reader.h"
#include "library_device.h"

namespace drape {
namespace {

using test::library_device;

struct Motion {
    std::vector<std::vector<float>> positions;  // by frame, x y z w of every particle
    std::vector<FrameEffort> efforts;
};

Motion motion_of(const SceneDescription& scene) {
    Motion result;
    SimulationOptions options;
    options.draw = false;
    Simulation simulation(scene, options, library_device());
    simulation.run(
        scene.time.frame_count - 1, [](std::uint32_t) { return true; },
        [&](const FinishedFrame& frame) {
            result.positions.emplace_back(frame.positions[0].begin(), frame.positions[0].end());
            result.efforts.push_back(frame.effort);
        });
    return result;
}

SceneDescription with_line(SceneDescription scene, std::uint32_t substeps) {
    scene.solver = {.method = SolverMethod::line, .substeps = substeps};
    return scene;
}

/// RMS distance of the particles that nothing holds, m.
double distance(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    std::size_t free = 0;
    for (std::size_t i = 0; i < a.size(); i += 4) {
        if (!(a[i + 3] > 0)) continue;
        ++free;
        for (std::size_t axis = 0; axis < 3; ++axis) sum += std::pow(double{a[i + axis]} - double{b[i + axis]}, 2);
    }
    return std::sqrt(sum / static_cast<double>(free));
}

SceneDescription scene_of(const char* text) { return parse_scene(text); }

/// Stated errors of the frames asked about lie within a factor of three of the true ones.
void expect_within_a_factor_of_three(const Motion& own, const Motion& truth,
                                     std::initializer_list<std::size_t> frames) {
    for (const std::size_t frame : frames) {
        const double error = distance(own.positions[frame], truth.positions[frame]);
        const double stated = own.efforts[frame].position_error;
        testing::Test::RecordProperty("stated_over_true_at_" + std::to_string(frame), std::to_string(stated / error));
        EXPECT_GT(stated, error / 3) << frame;
        EXPECT_LT(stated, error * 3) << frame;
        EXPECT_FALSE(own.efforts[frame].sensitive);
    }
}

using StatedError = test::LibraryTest;

/// A pin drags weightless cloth along and stops: nothing brings an error back. It was stated as a quarter of itself.
TEST_F(StatedError, OfClothThatIsDraggedAlong) {
    const SceneDescription scene = scene_of(R"({"time": {"fps": 24, "frames": 30}, "gravity": [0, 0, 0],
        "cloths": [{"grid": [9, 5], "size": [0.4, 0.26], "areal_density": 0.87,
                    "stiffness": {"stretch": 366, "shear": 16, "bend": 4e-4},
                    "placement": {"origin": [0, 1, 0], "u": [1, 0, 0], "v": [0, 0, 1]},
                    "pins": [{"at": [4, 1], "path": [{"t": 0}, {"t": 0.3}, {"t": 0.6, "translate": [0.1, 0.07, 0.02]},
                                                     {"t": 0.85, "translate": [0.03, 0.08, -0.08]}]}]}]})");
    const Motion own = motion_of(scene), truth = motion_of(with_line(scene, 256));
    expect_within_a_factor_of_three(own, truth, {13, 17, 21, 25, 29});
}

/// Rigid cloth falls and begins to buckle: it was called unpredictable, without an error, though substeps reduce it.
TEST_F(StatedError, OfRigidClothBeforeItBuckles) {
    const SceneDescription scene = scene_of(R"({"time": {"fps": 60, "frames": 31},
        "cloths": [{"grid": [33, 33], "size": [1, 1], "areal_density": 0.2, "stiffness": "rigid", "thickness": 0.0037,
                    "placement": {"origin": [0, 1, 0], "u": [1, 0, 0], "v": [0, 0, 1]},
                    "pins": [{"corner": "top_left"}, {"corner": "top_right"}]}]})");
    const Motion own = motion_of(scene), truth = motion_of(with_line(scene, 128));
    expect_within_a_factor_of_three(own, truth, {6, 12, 18, 24, 30});
}

/// Explicit steps stated nothing, and were off by up to 9 %.
TEST_F(StatedError, OfExplicitSteps) {
    SceneDescription scene = scene_of(R"({"time": {"fps": 60, "frames": 31},
        "cloths": [{"grid": [7, 6], "size": [0.5, 0.4], "areal_density": 0.3, "stiffness": {"stretch": 300, "shear": 60},
                    "placement": {"origin": [0, 1, 0], "u": [1, 0, 0], "v": [0, 0, 1]},
                    "pins": [{"edge": "top"}]}],
        "wind": {"velocity": [0, 0, 6]}})");
    const Motion own = motion_of(scene);
    scene.solver = {.method = SolverMethod::explicit_steps, .substeps = 1024};
    const Motion truth = motion_of(scene);
    for (const std::size_t frame : {10, 20, 30}) {
        const double error = distance(own.positions[frame], truth.positions[frame]);
        const double stated = own.efforts[frame].position_error;
        RecordProperty("stated_over_true_at_" + std::to_string(frame), std::to_string(stated / error));
        EXPECT_GT(stated, error / 3) << frame;
        EXPECT_LT(stated, error * 3) << frame;
    }
}

/// A method that is named states it where it is asked to, frame by frame, and nothing else changes by a bit.
TEST_F(StatedError, OfAMethodThatIsNamed) {
    SceneDescription scene = parse_scene(R"({"time": {"fps": 60, "frames": 31},
        "cloths": [{"grid": [13, 11], "size": [1, 0.8], "areal_density": 0.2, "stiffness": {"stretch": 500, "shear": 50},
                    "placement": {"origin": [0, 1, 0], "u": [1, 0, 0], "v": [0, 0, 1]},
                    "pins": [{"edge": "top"}]}]})");
    const Motion truth = motion_of(with_line(scene, 128)), silent = motion_of(with_line(scene, 12));
    scene.solver = {.method = SolverMethod::line, .substeps = 12, .estimate_error = true};
    const Motion own = motion_of(scene);
    EXPECT_EQ(own.positions, silent.positions);
    double error = 0, stated = 0;
    for (std::size_t frame = 1; frame < own.positions.size(); ++frame) {
        EXPECT_TRUE(std::isfinite(own.efforts[frame].position_error));
        EXPECT_TRUE(std::isnan(silent.efforts[frame].position_error));
        error += distance(own.positions[frame], truth.positions[frame]);
        stated += own.efforts[frame].position_error;
    }
    // The two meet where the sheet turns back, which the statement ignores: so the means are compared.
    RecordProperty("stated_over_true", std::to_string(stated / error));
    EXPECT_GT(stated, error / 3);
    EXPECT_LT(stated, error * 3);
}

/// Rigid light cloth that meets itself: 16 to 256 substeps were 13 mm off where 12 are 2.9, since the last attempt was
/// kept and not the best.
TEST_F(StatedError, RefiningDoesNotHarm) {
    const SceneDescription scene = scene_of(R"({"time": {"fps": 60, "frames": 19},
        "gravity": [0, -11.24, 0],
        "cloths": [{"grid": [33, 33], "size": [0.3, 0.3], "areal_density": 0.03, "stiffness": "rigid", "damping": 2,
                    "thickness": 0.0037, "self_collision": true,
                    "placement": {"origin": [0, 1, 0], "u": [1, 0, 0], "v": [0, 0, 1]},
                    "pins": [{"corner": "top_left"}, {"corner": "top_right"}]}]})");
    const Motion own = motion_of(scene), truth = motion_of(with_line(scene, 256)),
                 coarse = motion_of(with_line(scene, 12));
    const double error = distance(own.positions[18], truth.positions[18]);
    RecordProperty("error_mm", std::to_string(1000 * error));
    EXPECT_LT(error, distance(coarse.positions[18], truth.positions[18]));
}

}  // namespace
}  // namespace drape
