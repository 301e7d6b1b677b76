// A scene's colliders in the form that output formats write.
#pragma once

#include <vector>

#include "drape/scene.h"
#include "output/frame_writer.h"

namespace drape {

/// Returns the colliders in the scene's order. Round ones have 48 segments around, so that their triangles lie at most
/// 0.21 % of the radius inside the true surface.
/// Bodies that cloth moves are where `bodies` says; null, or before it says: where they start.
std::vector<WrittenCollider> written_colliders(const SceneDescription& scene,
                                               const std::shared_ptr<const BodyTracks>& bodies = nullptr);

/// Returns the colliders as obstacles of a graph network, whose nodes see only other nodes: round ones have 24 segments
/// around, and faces of planes and boxes have inner nodes. The numbers of nodes and triangles depend on kinds and
/// meshes alone.
std::vector<WrittenCollider> written_obstacles(const SceneDescription& scene,
                                               const std::shared_ptr<const BodyTracks>& bodies = nullptr);

}  // namespace drape
