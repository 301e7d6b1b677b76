// The turns of a cloth that nothing but air hinders: about any axis through its centre of mass where it is free, or
// about the line on which it is held where gravity goes along it.
#pragma once

#include <optional>

#include "cloth/cloth_geometry.h"

namespace drape {

struct KeptTurn {
    glsl::ivec2 about;  ///< a particle that is on the axis as long as any is held; a free cloth's is near its middle
    Vec3 axis{};        ///< unit vector; zero: a cloth that is held cannot turn
    bool any = false;   ///< a cloth that is held turns about any axis
    double until = 0;   ///< s: when it is free; infinite: never
    bool turns_held() const { return any || axis != Vec3{}; }
};

/// Returns nothing where the cloth never turns freely, or may come apart: pieces turn each by itself.
std::optional<KeptTurn> kept_turn(const SceneDescription& scene, const ClothGeometry& cloth);

}  // namespace drape
