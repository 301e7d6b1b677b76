// What bodies that cloth moves may not be.
#pragma once

#include <optional>
#include <string>

#include "drape/scene.h"

namespace drape {

/// Pairs of a body with a body or with a collider without a mass are searched in every substep; a scene may have so
/// many, each body counting once with every collider.
inline constexpr std::size_t most_body_pairs = 4096;

struct BodyFault {
    std::size_t collider;  ///< number of the body among the scene's colliders
    std::string expected;  ///< what was expected instead
};

/// Returns the first body whose shape or company has no contact: a mesh that is a shell or deforms, an ellipsoid beside
/// what it cannot meet (a box, a mesh or another ellipsoid), or one too many.
std::optional<BodyFault> body_fault(const SceneDescription& scene);

}  // namespace drape
