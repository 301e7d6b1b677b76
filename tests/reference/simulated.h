// A scene that is simulated by the twin and tells the forces on its cloths.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "base/vectors.h"
#include "cloth/cloth_statistics.h"
#include "cloth/forces.h"
#include "cloth/frame_inputs.h"
#include "support/force_scenes.h"
#include "twin/statistics.h"
#include "twin/twin.h"

namespace drape::test {

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
    /// Returns the statistics of all cloths, with what seams between them give.
    std::vector<ClothStatistics> all_statistics() {
        std::vector<ClothStatistics> all;
        std::vector<std::span<const std::byte>> impulses;
        for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth) {
            all.push_back(statistics(cloth));
            impulses.push_back(std::as_bytes(std::span(twin_.cloth(cloth).integers(Field::impulses))));
        }
        settle_seams(model_, impulses, frame_, all);
        return all;
    }
    Vec3 force(const std::string& by) { return of(by).force; }
    Vec3 moment(const std::string& by) { return of(by).moment.value(); }
    Vec3 worst(const std::string& by) { return of(by).worst.value(); }
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

}  // namespace drape::test
