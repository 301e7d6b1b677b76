// The shaders' functions for the native kernels, in each file's own namespace (see native_kernels.h). NATIVE_VARIANT is
// the variant that is being compiled, vector or scalar.
#pragma once

#include "native_kernels.h"

// Loops over calls are not vectorised.
#undef SHARED
#define SHARED [[gnu::always_inline]] inline

namespace drape::native {

namespace {

using namespace glsl;

#include "include/bdf2.h"
#include "include/explicit.h"
#include "include/line.h"
#include "include/spring.h"
#include "include/vector.h"
#include "include/verlet.h"

const vec3 no_pull{-0.0f, -0.0f, -0.0f};  // adding it changes no bit

SHARED vec3 load(const Vectors& v, std::ptrdiff_t at) { return {v.x[at], v.y[at], v.z[at]}; }

SHARED void store(const Vectors& v, std::ptrdiff_t at, vec3 value) {
    v.x[at] = value.x;
    v.y[at] = value.y;
    v.z[at] = value.z;
}

/// One or the other without a branch.
SHARED vec3 chosen(bool first, vec3 a, vec3 b) { return {first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z}; }

SHARED void advance_particle(const SheetView& sheet, std::ptrdiff_t at, vec3 position, vec3 displacement) {
    const CompensatedSum advanced = compensated_add(position, displacement, load(sheet.position_remainder, at));
    store(sheet.position, at, advanced.value);
    store(sheet.position_remainder, at, advanced.remainder);
}

/// Adds an increment to the displacement of a particle that is free to move.
SHARED void step_particle(const SheetView& sheet, std::ptrdiff_t at, vec3 displacement, vec3 increment) {
    const vec3 remainder = load(sheet.displacement_remainder, at);
    const bool is_free = sheet.weight[at] != 0.0f;
    const CompensatedSum stepped = compensated_add(displacement, dragged_increment(increment, 0.0f), remainder);
    store(sheet.displacement, at, chosen(is_free, stepped.value, displacement));
    store(sheet.displacement_remainder, at, chosen(is_free, stepped.remainder, remainder));
}

}  // namespace

namespace NATIVE_VARIANT {

std::uint32_t solve_lines(const SheetView& sheet, const LinePush& push, bool first_iteration, bool is_bdf2, int first,
                          int last, LineParticles* scratch);

}  // namespace NATIVE_VARIANT

}  // namespace drape::native
