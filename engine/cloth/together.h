// Small cloths that are alike are simulated together, one dispatch for all of them: their state lies below each other
// in the same images (shaders/include/state_store.h), and a workgroup's z says whose it is. The result is the same to
// the bit. Pure.
#pragma once

#include <cstddef>
#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

/// Returns lists of two or more cloths, ascending, that differ only in name and looks and in what their state holds:
/// placement, velocity, pins. There are none where cutters may make cloths differ or where each cloth has its own
/// number of iterations, and cloths that are large enough to fill a device alone are in no list.
std::vector<std::vector<std::size_t>> cloths_alike(const SceneDescription& scene);

/// Returns the steps of a frame in which a step that all cloths of a list take with the same constants is one step of
/// the list's first cloth (Step::together). A step that only some of them take, or take with other constants, stays as
/// it is. Every cloth keeps the order of its steps.
std::vector<Step> steps_together(const std::vector<Step>& steps, const std::vector<std::vector<std::size_t>>& lists);

}  // namespace drape
