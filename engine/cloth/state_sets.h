// A scene's motion may be simulated more than once at a time, each time with a state of its own; and a state may be
// kept, gone back to, and compared. Whoever has the states (the device, or the tests' twin) does these steps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

enum class StateSet : std::uint8_t {
    run,        ///< what is handed out
    companion,  ///< with other substeps, from the start on: what it is away tells the error (control/motion_error.h)
    disturbed,  ///< the companion but for next to nothing, at times: tells chaos from error (control/sensitivity.h)
};
inline constexpr std::size_t state_set_count = 3;

enum class StateStep : std::uint8_t {
    keep,               ///< copies the state
    restore,            ///< is the way back
    change_substep,     ///< gives the substeps another length (cloth/substep_change.h)
    remember,           ///< copies the positions
    compare,            ///< tells how far the positions are from those
    compare_companion,  ///< tells how far the positions are from the companion's
    disturb,            ///< begins the disturbed run with the companion's state
    compare_disturbed,  ///< tells how far the companion's and the disturbed run's positions are apart
};
inline constexpr std::size_t state_step_count = 8;

/// Returns whether a run of this model has the set.
bool has_set(const SimulationModel& model, StateSet set);
/// Returns the steps that it takes in a set.
std::vector<StateStep> state_steps(const SimulationModel& model, StateSet set);

}  // namespace drape
