// Which schedule (drape/schedule.h) a device takes for a model, and the steps of a frame by it.
#pragma once

#include <vector>

#include "cloth/simulation_model.h"
#include "cloth/solver_choice.h"
#include "drape/schedule.h"
#include "vulkan/device.h"

namespace drape {

/// What method `auto` has to know of a device.
DeviceKind device_kind(const vulkan::DeviceInfo& device);

/// The schedule asked for; automatic: the one that such a device takes for such a model. Throws VulkanError where the
/// device has not what it needs.
Schedule possible_schedule(const vulkan::Device& device, const SimulationModel& model, Schedule asked);

/// Whether passes of a method run by a schedule otherwise than by those before it in the list; not of `automatic`.
bool concerns(Schedule schedule, SolverMethod method);

/// Whether passes write the state through buffers of its images' memory (shaders/include/state_store.h).
bool stores_through_buffers(Schedule schedule);

std::vector<Step> scheduled_steps(const SimulationModel& model, Schedule schedule);

}  // namespace drape
