// Passes around the attempts at a frame in a closed loop: keeping the state that the frame starts from, going back to
// it, giving it substeps of another length, remembering where a run with half the substeps ended, comparing with it.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

enum class AttemptStep : std::uint8_t {
    keep,               ///< reads the state, writes its copy
    restore,            ///< the way back
    change_substep,     ///< reads `attempt`; reads and writes displacement, end excess and history
    remember,           ///< reads position, writes its copy
    compare,            ///< reads both, writes a record per workgroup for the host
    compare_companion,  ///< reads position here and in the companion's set, writes likewise
    disturb,            ///< reads the companion's state, writes that of the disturbed run
    compare_disturbed,  ///< reads position in both, writes likewise
};
inline constexpr std::size_t attempt_step_count = 8;

inline constexpr const char* attempt_name = "attempt";
/// Host output buffer with the differences of a state's cloths (ClothState::name, count), difference_count each.
std::string difference_readback_name(const std::string& state);

/// Does what `step` does with the state for what contact between the cloths hands from frame to frame.
void add_contact_attempt(graph::Graph& graph, ContactHandles& contact, AttemptStep step);
/// `first_change`: place in `attempt` of the change of the state's first cloth; the others' follow.
void add_attempt(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SceneInputs& inputs,
                 const SimulationModel& run, AttemptStep step, std::size_t first_change);

}  // namespace drape
