#include "cloth/cyclic_lines.h"

#include <algorithm>
#include <bit>

#include "shared/cyclic_types.h"

namespace drape {

bool can_reduce(const glsl::LinePush& push) {
    return push.bend == 0 && push.particle_count <= glsl::cyclic_most_particles;
}

std::uint32_t cyclic_shared_bytes(std::uint32_t invocations) {
    constexpr std::uint32_t row = sizeof(glsl::vec4) + sizeof(glsl::vec2);
    return invocations * row + glsl::cyclic_least_invocations / glsl::cyclic_least_width * sizeof(glsl::uint);
}

glsl::ivec2 cyclic_group(int particle_count) {
    const auto fitting = static_cast<int>(std::bit_ceil(static_cast<unsigned>(particle_count)));
    const int width = std::max(fitting, glsl::cyclic_least_width);
    return {width, std::max(1, glsl::cyclic_least_invocations / width)};
}

}  // namespace drape
