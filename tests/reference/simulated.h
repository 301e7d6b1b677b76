// A scene that is simulated by the twin and tells the forces on its cloths.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "base/vectors.h"
#include "cloth/cloth_statistics.h"
#include "cloth/frame_inputs.h"
#include "support/sheets.h"
#include "twin/statistics.h"
#include "twin/twin.h"

namespace drape::test {

inline constexpr SolverMethod all_methods[] = {SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps};

/// Simulates a scene by the twin and tells the statistics of each frame.
class Simulated {
  public:
    explicit Simulated(SceneDescription scene) : model_(with_forces(std::move(scene))), twin_(model_) {}

    void frames(std::uint32_t count) {
        for (std::uint32_t k = 0; k < count; ++k) twin_.run_frame(++frame_);
    }
    ClothStatistics statistics(std::size_t cloth = 0) {
        const TwinCloth& state = twin_.cloth(cloth);
        const FrameInputs inputs = frame_inputs(model_, frame_);
        return cloth_statistics(model_, model_.cloths[cloth], twin_statistics(model_, cloth, state, inputs), frame_,
                                std::as_bytes(std::span(state.integers(Field::impulses))));
    }
    Vec3 force(const std::string& by) { return of(by).force; }
    Vec3 moment(const std::string& by) { return of(by).moment.value(); }
    double weight() { return statistics().mass * 9.81; }
    double frame_time() const { return 1 / model_.scene.time.fps; }
    const SimulationModel& model() const { return model_; }
    const Twin& twin() const { return twin_; }

  private:
    static SceneDescription with_forces(SceneDescription scene) {
        scene.forces = true;
        return scene;
    }
    ForceOnCloth of(const std::string& by) {
        for (const ForceOnCloth& each : statistics().forces)
            if (each.by == by) return each;
        ADD_FAILURE() << "no force by " << by;
        return {};
    }

    SimulationModel model_;
    Twin twin_;
    std::uint32_t frame_ = 0;
};

inline SceneDescription by_method(SceneDescription scene, SolverMethod method, std::uint32_t substeps) {
    scene.solver.method = method;
    scene.solver.substeps = method == SolverMethod::explicit_steps ? 10 * substeps : substeps;
    return scene;
}

/// A level sheet of 9 x 9 particles and 0.4 m a side about the origin, at a height.
inline SceneDescription level_sheet(double height, double damping) {
    SceneDescription scene = test::sheet(9, 9, 0.4, 0.4, 8);
    Cloth& cloth = scene.cloths[0];
    cloth.pins.clear();
    cloth.stiffness = {false, 1000, 100, 0};
    cloth.placement = {{-0.2, height, -0.2}, {1, 0, 0}, {0, 0, 1}};
    cloth.damping = damping;
    cloth.friction = 0.3;
    cloth.thickness = 0.004;
    return scene;
}

inline void expect_near(const Vec3& force, const Vec3& expected, double bound, const char* what) {
    const double off = length(minus(force, expected)) / length(expected);
    std::printf("[ measured ] %s: off by %.1e\n", what, off);
    EXPECT_LT(off, bound) << what;
}

}  // namespace drape::test
