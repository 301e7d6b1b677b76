// A scene's colliders as output formats write them.
#pragma once

#include <vector>

#include "drape/scene.h"
#include "output/written_collider.h"

namespace drape {

/// Returns them in the scene's order. Round ones have 48 segments around, so that their triangles lie within 0.21 % of
/// the radius under the true surface.
std::vector<WrittenCollider> written_colliders(const SceneDescription& scene);

/// Returns them as obstacles of a graph network, whose nodes see nodes alone: round ones have 24 segments around, faces
/// of planes and boxes nodes inside. Their numbers of nodes and triangles follow from kinds and meshes alone.
std::vector<WrittenCollider> written_obstacles(const SceneDescription& scene);

}  // namespace drape
