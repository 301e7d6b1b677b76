// What a member's next frame depends on, as named parts (engine/docs/checkpoint.md): the state fields of its cloths by
// the table (cloth/cloth_state.h), their cuts, and what its run knows. The rest follows from the scene and the frame
// alone, such as the bounds of the watch, and is computed again.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "simulation/frame_server.h"

namespace drape {

/// Returns the name of the part that has a field of a cloth.
std::string field_part(const ClothModel& cloth, Field field);

/// Returns the parts; call it only while the member's run `can_save`.
SimulationState saved_state(const FrameServer& server, std::size_t member);
/// Takes members to saved states, one for each. Throws Error where one is not of such a member; then nothing has
/// changed where there are several members, and a single one is over.
void restore_states(FrameServer& server, std::span<const std::size_t> members, std::span<const SimulationState> states);
/// Takes the cloths of members that share dispatches to their starts, in all sets, and leaves their runs as they are.
void put_starts(FrameServer& server, std::span<const std::size_t> members);

}  // namespace drape
