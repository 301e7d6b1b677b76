#pragma once

#include "drape/scene.h"

namespace drape {

/// Returns the scene if it fulfils what all other code takes for granted, as a scene that was read does. Throws
/// SceneFailure.
const SceneDescription& checked_scene(const SceneDescription& scene);

}  // namespace drape
