// Small cloths of one shape are simulated together, with one dispatch for all of them: their states lie below each
// other in the same images (shaders/include/state_store.h), and a workgroup's z is the number of its cloth. Their
// numbers may differ; then each has constants of its own (shaders/include/push.h). The result is the same to the bit.
// Pure.
#pragma once

#include <cstddef>
#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

/// Returns lists of two or more cloths, ascending, that have the same grid and holes. The result is empty where seams
/// have cloths take turns, where cutters may make cloths differ, or where each cloth has its own number of iterations.
/// Cloths large enough to fill a device alone are in no list.
std::vector<std::vector<std::size_t>> cloths_alike(const SceneDescription& scene);

/// Splits those lists so that the cloths of each take the same steps with the same fields: for instance, all of them or
/// none have moving pins, and all or none are rigid.
std::vector<std::vector<std::size_t>> cloths_together(const SimulationModel& model);

/// Returns whether cloths differ only in name, looks and the content of their state: placement, velocity, pins.
bool have_same_numbers(const Cloth& one, const Cloth& other);

/// Returns the steps of a frame in which a step of all cloths of a list is one step of the list's first cloth
/// (Step::together). A step of only some of them stays as it is. Every cloth keeps the order of its steps.
std::vector<Step> steps_together(const std::vector<Step>& steps, const std::vector<std::vector<std::size_t>>& lists);

}  // namespace drape
