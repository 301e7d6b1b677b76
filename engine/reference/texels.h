// Texels as the twin reads them.
#pragma once

#include "cloth/grid.h"
#include "shared/glsl_types.h"

namespace drape {

inline glsl::vec3 xyz(const glsl::vec4& v) { return {v.x, v.y, v.z}; }
inline glsl::vec4 texel(const glsl::vec3& v, float w = 0.0f) { return {v.x, v.y, v.z, w}; }

inline std::size_t at(const Grid& grid, glsl::ivec2 p) {
    return static_cast<std::size_t>(p.y) * grid.columns() + static_cast<std::size_t>(p.x);
}

inline float component(const glsl::vec4& v, int channel) {
    return channel == 0 ? v.x : channel == 1 ? v.y : channel == 2 ? v.z : v.w;
}

}  // namespace drape
