#include "cloth/cyclic_lines.h"

#include <algorithm>

#include "shared/cyclic_types.h"
#include "shared/parts_types.h"

namespace drape {

namespace {

/// Returns the shared memory, bytes, in which an invocation passes its row to the others of its line (cyclic_group.h,
/// cyclic_bent_group.h).
/// cyclic_bent_group.h), bytes.
std::uint32_t row_bytes(bool bent) {
    return static_cast<std::uint32_t>(sizeof(glsl::vec4) + sizeof(glsl::vec2) + (bent ? sizeof(glsl::vec3) : 0));
}

/// Shared memory, bytes, for what a workgroup reports about its lines.
constexpr std::uint32_t report_bytes = glsl::cyclic_least_invocations / glsl::cyclic_least_width * sizeof(glsl::uint);

/// Returns how many particles of a line a subgroup solves.
int particles_of_part(std::uint32_t subgroup) {
    return static_cast<int>(subgroup) / glsl::part_lines * glsl::part_particles;
}

/// Returns the shared memory, bytes, of a subgroup that solves parts of lines (shaders/line_parts.comp, part_group.h).
std::uint32_t bytes_of_parts(std::uint32_t subgroup) {
    constexpr auto particle = static_cast<std::uint32_t>(glsl::part_particles * sizeof(float)),
                   part = static_cast<std::uint32_t>(6 * sizeof(glsl::vec4) + 2 * sizeof(glsl::vec2));
    return subgroup * particle + glsl::part_lines * part;
}

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

bool can_part(const glsl::LinePush& push, const GroupLimits& limits) {
    // Every subgroup solves the reduced system of all parts, with an invocation for each line's part.
    constexpr auto reports = static_cast<std::uint32_t>(glsl::part_lines * sizeof(glsl::uint));
    const std::uint32_t lanes = limits.subgroup / glsl::part_lines,
                        held = (limits.shared_bytes - reports) / bytes_of_parts(limits.subgroup),
                        parts = std::min({lanes, held, limits.invocations / limits.subgroup});
    return push.bend == 0 && push.particle_count <= static_cast<int>(parts) * particles_of_part(limits.subgroup);
}

std::uint32_t parts_group(int particle_count, std::uint32_t subgroup) {
    return static_cast<std::uint32_t>((particle_count - 1) / particles_of_part(subgroup) + 1) * subgroup;
}

}  // namespace drape
