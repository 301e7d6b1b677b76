// The twin of the passes that make the fields of meshes that deform.
#pragma once

#include <memory>
#include <vector>

#include "cloth/frame_inputs.h"
#include "shared/collider_types.h"

namespace drape {

/// Returns the texels of all fields in a frame, null where no mesh deforms. Those that were last asked for are kept.
std::shared_ptr<const std::vector<glsl::vec4>> twin_fields(const SimulationModel& model, const FrameInputs& inputs);

}  // namespace drape
