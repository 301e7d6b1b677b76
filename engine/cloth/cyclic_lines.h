// Cyclic reduction solves lines (shaders/line_cyclic.comp) with an invocation per particle instead of one per line, for
// devices that run many at once. The systems are the same, the rounding differs. Pure.
#pragma once

#include "cloth/simulation_model.h"

namespace drape {

/// Returns whether cyclic reduction can solve the lines of a step: they do not bend, and a workgroup holds a line
/// (cyclic_most_particles).
bool can_reduce(const glsl::LinePush& push);

/// Returns the shared memory of a workgroup of so many invocations, bytes.
std::uint32_t cyclic_shared_bytes(std::uint32_t invocations);

/// Returns the size of a workgroup for lines of so many particles: x invocations along a line, y lines, which are
/// several where lines are short.
glsl::ivec2 cyclic_group(int particle_count);

}  // namespace drape
