// Cyclic reduction solves lines (shaders/line_cyclic.comp) with an invocation per particle instead of one per line, for
// devices that run many at once. The systems are the same, the rounding differs. Pure.
#pragma once

#include "cloth/simulation_model.h"

namespace drape {

/// Returns the most particles of a line that a workgroup of such limits holds: 1024 and, where it bends, 896 in 32 KiB
/// of shared memory; 672 and 448 in 16 KiB.
int cyclic_most(const GroupLimits& limits, bool bent);

/// Returns whether cyclic reduction can solve the lines of a step: a workgroup holds a line, and they do not bend too
/// stiffly (cyclic_most_bend).
bool can_reduce(const glsl::LinePush& push, const GroupLimits& limits);

/// Returns the shared memory of a workgroup of so many invocations, bytes.
std::uint32_t cyclic_shared_bytes(std::uint32_t invocations, bool bent);

/// Returns the size of a workgroup for lines of so many particles: x invocations along a line, y lines, which are
/// several where lines are short.
glsl::ivec2 cyclic_group(int particle_count);

/// Returns whether lines can be solved in parts (shaders/line_parts.comp): they do not bend, and a workgroup holds two
/// of them, of up to 2048 particles with subgroups of 32 in 32 KiB of shared memory, 1664 in 16 KiB, 128 with subgroups
/// of 8.
bool can_part(const glsl::LinePush& push, const GroupLimits& limits);

/// Returns the invocations of a workgroup that solves lines of so many particles in parts.
std::uint32_t parts_group(int particle_count, std::uint32_t subgroup);

}  // namespace drape
