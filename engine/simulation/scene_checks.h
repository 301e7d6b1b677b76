#pragma once

#include "drape/scene.h"

namespace drape {

/// Returns the scene, if it has what everything else takes for granted; one that was read has it. Throws SceneFailure.
const SceneDescription& checked_scene(const SceneDescription& scene);

}  // namespace drape
