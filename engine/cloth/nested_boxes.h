// Steps of the line method that solve boxes around lone pins (docs/solvers.md).
#pragma once

#include "cloth/method.h"

namespace drape {

/// Adds, after the lines of an iteration, boxes around every held particle that has no held neighbour, or notes why
/// not. Sets the scheme's `nested_table`.
void add_nested_boxes(const ClothGeometry& cloth, const MethodSettings& settings, MethodScheme& scheme);

/// Returns how many rounds of loops an invocation runs through when a workgroup of `width` follows the lines of a pin's
/// blocks.
std::uint64_t nested_rounds(const MethodScheme& scheme, const glsl::NestedPush& push, glsl::ivec2 pin, int width);

}  // namespace drape
