// A scene's motion may be simulated in several versions at a time, each with a state of its own. A state may be saved,
// restored and compared. The owner of the states (the device, or the tests' twin) does these steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

enum class StateSet : std::uint8_t {
    run,        ///< the motion that is handed out
    companion,  ///< simulated with other substeps from the start on; its distance shows the error
                ///< (control/motion_error.h)
    disturbed,  ///< at times, the companion with a tiny disturbance; tells chaos from error (control/sensitivity.h)
};
inline constexpr std::size_t state_set_count = 3;

enum class StateStep : std::uint8_t {
    keep,               ///< saves a copy of the state
    restore,            ///< restores the copy
    change_substep,     ///< changes the length of the substeps (cloth/substep_change.h)
    remember,           ///< saves a copy of the positions
    compare,            ///< measures how far the positions are from that copy
    compare_companion,  ///< measures how far the positions are from the companion's
    disturb,            ///< starts the disturbed run from the companion's state
    compare_disturbed,  ///< measures how far apart the companion's and the disturbed run's positions are
};
inline constexpr std::size_t state_step_count = 8;

/// Returns whether a run of this model has the state set.
bool has_set(const SimulationModel& model, StateSet set);
/// Returns the steps that the run uses in a state set.
std::vector<StateStep> state_steps(const SimulationModel& model, StateSet set);

}  // namespace drape
