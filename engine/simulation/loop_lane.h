// The device as a frame loop sees it that shares its dispatches with others: each loop is about one member of an
// ensemble, and what several ask for alike is done at once (lane_server.h).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "cloth/simulation_model.h"
#include "drape/simulation.h"
#include "shared/closed_loop_types.h"
#include "shared/statistics_types.h"
#include "solver/attempt_pass.h"
#include "vulkan/frame_slots.h"

namespace drape {

/// One of the things that a submit does, in order.
struct LanePart {
    enum class Kind : std::uint8_t {
        attempt,    ///< `step` in `set`
        substeps,   ///< a frame of so many `substeps` in `set`
        look,       ///< what is handed out of the state as it is
        statistics  ///< beside that the statistics, as of a frame that was not simulated
    };
    Kind kind = Kind::look;
    StateSet set = StateSet::run;
    AttemptStep step = AttemptStep::keep;
    std::uint32_t substeps = 0;
    bool operator<(const LanePart& other) const {
        return std::tie(kind, set, step, substeps) < std::tie(other.kind, other.set, other.step, other.substeps);
    }
};

/// A submit of a loop: loops that want the same parts take them together, each of its own frame.
struct LaneWork {
    std::vector<LanePart> parts;
    std::uint32_t frame = 0;
    const SimulationModel* run = nullptr;           ///< at the substeps of the frame; inputs are its
    std::vector<glsl::SubstepChange> changes = {};  ///< by cloth, where a part changes them
};

/// The results of a submit, until the slot is submitted again.
struct LaneResult {
    std::vector<glsl::StatisticsRecord> statistics;  ///< by cloth
    std::vector<double> differences;                 ///< by cloth, m
    /// They have four floats a particle, by what was read back and by cloth.
    std::map<std::string, std::vector<std::vector<float>>, std::less<>> arrays;
};

/// Returns whether a loop with so many substeps has this set of the state.
bool has_set(const SimulationModel& model, StateSet set);
/// Returns the steps that it takes in it.
std::vector<AttemptStep> attempt_steps(const SimulationModel& model, StateSet set);

class LoopLane {
  public:
    virtual ~LoopLane() = default;
    /// Returns when it is done.
    virtual void submit(std::uint32_t slot, const LaneWork& work) = 0;
    const LaneResult& result(std::uint32_t slot) const { return results_[slot]; }
    /// The state, by resource, as a solver of the member alone names it (ClothSolver::download_state).
    virtual SimulationState download() const = 0;
    virtual void upload(const SimulationState& state) = 0;

  protected:
    std::array<LaneResult, vulkan::frame_slot_count> results_;
};

}  // namespace drape
