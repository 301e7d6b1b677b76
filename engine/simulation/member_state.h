// What a member's next frame depends on, as named parts (engine/docs/checkpoint.md): the fields of its cloths' state,
// from the table in cloth/cloth_state.h, their cuts, and what its run knows. Everything else, such as the bounds of the
// watch, follows from the scene and the frame alone and is computed again.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "simulation/frame_server.h"

namespace drape {

/// Returns the name of the part that holds a field of a cloth.
std::string field_part(const ClothModel& cloth, Field field);

/// Returns the parts; call it only while the member's run `can_save`.
SimulationState saved_state(const FrameServer& server, std::size_t member);
/// Restores members to saved states, one for each. Throws Error where a state does not fit its member. With several
/// members nothing has changed then; a single member cannot go on.
void restore_states(FrameServer& server, std::span<const std::size_t> members, std::span<const SimulationState> states);
/// Resets the cloths of members that share dispatches to their starts, in all state sets; their runs stay as they are.
void put_starts(FrameServer& server, std::span<const std::size_t> members);

}  // namespace drape
