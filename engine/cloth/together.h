// Small cloths of one shape are simulated together, one dispatch for all of them: their state lies below each other in
// the same images (shaders/include/state_store.h), and a workgroup's z says whose it is. Their numbers may differ; then
// each has constants of its own (shaders/include/push.h). The result is the same to the bit. Pure.
#pragma once

#include <cstddef>
#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

/// Returns lists of two or more cloths, ascending, that have the same grid and holes. There are none where cutters may
/// make cloths differ or where each cloth has its own number of iterations, and cloths that are large enough to fill a
/// device alone are in no list.
std::vector<std::vector<std::size_t>> cloths_alike(const SceneDescription& scene);

/// Returns parts of those lists whose cloths take the same steps with the same fields: all of them move pins or none
/// does, all are rigid or none is, and so on.
std::vector<std::vector<std::size_t>> cloths_together(const SimulationModel& model);

/// Returns whether cloths differ only in name and looks and in what their state holds: placement, velocity, pins.
bool have_same_numbers(const Cloth& one, const Cloth& other);

/// Returns the steps of a frame in which a step that all cloths of a list take is one step of the list's first cloth
/// (Step::together). A step that only some of them take stays as it is. Every cloth keeps the order of its steps.
std::vector<Step> steps_together(const std::vector<Step>& steps, const std::vector<std::vector<std::size_t>>& lists);

}  // namespace drape
