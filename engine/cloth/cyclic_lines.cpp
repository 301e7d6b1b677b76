#include "cloth/cyclic_lines.h"

#include <algorithm>

#include "shared/cyclic_types.h"

namespace drape {

namespace {

/// Shared memory of an invocation for the row that it hands to the others of its line (cyclic_group.h,
/// cyclic_bent_group.h), bytes.
std::uint32_t row_bytes(bool bent) {
    return static_cast<std::uint32_t>(sizeof(glsl::vec4) + sizeof(glsl::vec2) + (bent ? sizeof(glsl::vec3) : 0));
}

/// Shared memory of a workgroup for what it reports of its lines, bytes.
constexpr std::uint32_t report_bytes = glsl::cyclic_least_invocations / glsl::cyclic_least_width * sizeof(glsl::uint);

}  // namespace

int cyclic_most(const GroupLimits& limits, bool bent) {
    const std::uint32_t held = std::min(limits.invocations, (limits.shared_bytes - report_bytes) / row_bytes(bent));
    const int widest = static_cast<int>(held) / glsl::cyclic_least_width * glsl::cyclic_least_width;
    return std::min(widest, glsl::cyclic_most_particles);
}

bool can_reduce(const glsl::LinePush& push, const GroupLimits& limits) {
    return push.particle_count <= cyclic_most(limits, push.bend > 0) && push.bend <= glsl::cyclic_most_bend;
}

std::uint32_t cyclic_shared_bytes(std::uint32_t invocations, bool bent) {
    return invocations * row_bytes(bent) + report_bytes;
}

glsl::ivec2 cyclic_group(int particle_count) {
    constexpr int step = glsl::cyclic_least_width;
    const int width = (particle_count + step - 1) / step * step;
    return {width, std::max(1, glsl::cyclic_least_invocations / width)};
}

}  // namespace drape
