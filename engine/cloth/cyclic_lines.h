// Cyclic reduction solves lines (shaders/line_cyclic.comp) with an invocation per particle instead of one per line, for
// devices that run many invocations at once. The systems are the same, their rounding differs. Pure.
#pragma once

#include "cloth/simulation_model.h"

namespace drape {

/// Returns the largest number of particles in a line that a workgroup with such limits can hold: with 32 KiB of shared
/// memory 1024, or 896 where lines bend; with 16 KiB 672 and 448.
int cyclic_most(const GroupLimits& limits, bool bent);

/// Returns whether cyclic reduction can solve the lines of a step: each fits into a workgroup, and their bending is not
/// too stiff (cyclic_most_bend).
bool can_reduce(const glsl::LinePush& push, const GroupLimits& limits);

/// Returns the shared memory, bytes, of a workgroup with so many invocations.
std::uint32_t cyclic_shared_bytes(std::uint32_t invocations, bool bent);

/// Returns the size of a workgroup for lines of so many particles: x invocations along a line, and y lines, more than
/// one where lines are short.
glsl::ivec2 cyclic_group(int particle_count);

/// Returns whether lines can be solved in parts (shaders/line_parts.comp): they do not bend, and two of them fit into a
/// workgroup. Such lines have up to 2048 particles with subgroups of 32 and 32 KiB of shared memory, 1664 with 16 KiB,
/// and 128 with subgroups of 8.
bool can_part(const glsl::LinePush& push, const GroupLimits& limits);

/// Returns the invocations of a workgroup that solves lines of so many particles in parts.
std::uint32_t parts_group(int particle_count, std::uint32_t subgroup);

}  // namespace drape
