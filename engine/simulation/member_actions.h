// What an ensemble's members are told to do in a step: whether they can, and what it changes in their models.
#pragma once

#include "simulation/member.h"

namespace drape {

/// Returns whether members may be told anything.
bool acts(const EnsembleControls& controls);
/// Returns the scene with paths for all that these controls may move.
SceneDescription able_to_move(SceneDescription scene, const EnsembleControls& controls);
/// Returns the options of a model that these controls may change.
ModelOptions controlled(ModelOptions options, const EnsembleControls& controls);

/// Returns the number of pins of all cloths.
std::size_t pin_count(const SimulationModel& model);
/// Returns the number of loads of all cloths.
std::size_t load_count(const SimulationModel& model);
/// Returns the particles that a hand is to hold, `index` counting those of all members; nothing: none.
std::optional<IndexBox> grasp_of(const EnsembleActions& actions, std::size_t index);

/// Throws ActionError where lists are not as long as `count` members need, or have numbers that are not finite.
void check_lists(const EnsembleActions& actions, const EnsembleControls& controls, const SimulationModel& model,
                 std::size_t count);
/// Throws ActionError where members cannot follow these actions.
void check_actions(const EnsembleActions& actions, const EnsembleControls& controls, const Members& members);
/// Throws ActionError where a single member that is at a frame cannot follow them.
void check_actions(const EnsembleActions& actions, const EnsembleControls& controls, const SimulationModel& model,
                   std::uint32_t frame);
/// Applies a member's part of the actions to its model, for the frame after `frame`.
void act(const EnsembleActions& actions, std::size_t number, std::uint32_t frame, SimulationModel& model, Acted& acted);
/// Returns whether there is anything to do.
bool is_any(const EnsembleActions& actions);

}  // namespace drape
