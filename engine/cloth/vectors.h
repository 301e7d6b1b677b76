// The few operations on double vectors and texels that the host needs.
#pragma once

#include <array>
#include <cmath>

#include "scene/scene_description.h"
#include "shared/glsl_types.h"

namespace drape {

inline double length(const Vec3& v) { return std::hypot(v[0], v[1], v[2]); }

inline glsl::vec4 texel(const Vec3& v, float w) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), w};
}
inline glsl::vec4 texel(const std::array<double, 4>& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), static_cast<float>(v[3])};
}

}  // namespace drape
