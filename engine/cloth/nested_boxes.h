// Steps of the line method that solve boxes around particles that are held alone (docs/solvers.md).
#pragma once

#include "cloth/method.h"

namespace drape {

/// Adds the boxes around every held particle without a held neighbour to the steps of an iteration, after the lines of
/// the scheme; or says why not. Sets its `nested_table`.
void add_nested_boxes(const ClothGeometry& cloth, const MethodSettings& settings, MethodScheme& scheme);

/// Returns the rounds of loops of an invocation of a workgroup of `width`, which follows the lines of a pin's blocks.
std::uint64_t nested_rounds(const MethodScheme& scheme, const glsl::NestedPush& push, glsl::ivec2 pin, int width);

}  // namespace drape
