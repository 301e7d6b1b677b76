// Which cloths are simulated together, one dispatch for all of them: their state lies below each other in the same
// images (shaders/include/state_store.h), and a workgroup's z says whose it is. To the same bits. Pure.
#pragma once

#include <cstddef>
#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

/// Cloths that differ in nothing but what lies in their state: name, placement, velocity, pins, looks. A list of two or
/// more per kind, ascending. None where cutters may make any of them another kind or each has its own number of
/// iterations, and of those that are large enough to fill a device alone.
std::vector<std::vector<std::size_t>> cloths_alike(const SceneDescription& scene);

/// The steps of a frame, with those that all cloths of a list take with the same constants made one (Step::together),
/// named for the list's first. What only some of them do, or do otherwise, stays theirs: the sweeps around their pins,
/// pins that let go. Every cloth keeps the order of its steps.
std::vector<Step> steps_together(const std::vector<Step>& steps, const std::vector<std::vector<std::size_t>>& lists);

}  // namespace drape
