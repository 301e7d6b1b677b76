// Functions by which the host and the C++ twin make and read texels.
#pragma once

#include <array>

#include "cloth/grid.h"
#include "drape/scene.h"
#include "shared/glsl_types.h"

namespace drape {

inline glsl::vec4 texel(const glsl::vec3& v, float w = 0.0f) { return {v.x, v.y, v.z, w}; }
inline glsl::vec4 texel(const std::array<double, 4>& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), static_cast<float>(v[3])};
}
inline glsl::vec4 texel(const Vec3& v, double w) { return texel({v[0], v[1], v[2], w}); }

inline glsl::vec3 xyz(const glsl::vec4& v) { return {v.x, v.y, v.z}; }

inline float& component(glsl::vec4& v, std::size_t k) { return k == 0 ? v.x : k == 1 ? v.y : k == 2 ? v.z : v.w; }
inline float component(const glsl::vec4& v, std::size_t k) { return k == 0 ? v.x : k == 1 ? v.y : k == 2 ? v.z : v.w; }

/// Returns the index of a particle's texel, row by row.
inline std::size_t at(const Grid& grid, glsl::ivec2 p) {
    return static_cast<std::size_t>(p.y) * grid.columns() + static_cast<std::size_t>(p.x);
}

}  // namespace drape
