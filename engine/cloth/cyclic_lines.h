// Which lines can be solved by cyclic reduction (shaders/line_cyclic.comp): an invocation per particle instead of one
// per line, for devices that have many. The same systems, with other rounding. Pure.
#pragma once

#include "cloth/simulation_model.h"

namespace drape {

/// Whether the lines of a step may be: they do not bend, and a workgroup holds them (cyclic_most_particles).
bool can_reduce(const glsl::LinePush& push);

/// Likewise the lines in the boxes of nested boxes.
bool can_reduce(const glsl::NestedPush& push, const MethodPlan& plan);

/// Shared memory of a workgroup of so many invocations.
std::uint32_t cyclic_shared_bytes(std::uint32_t invocations);

/// Invocations along a line of so many particles and, of short lines, lines in a workgroup.
glsl::ivec2 cyclic_group(int particle_count);

}  // namespace drape
