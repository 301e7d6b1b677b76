#include "solver/device_schedule.h"

#include <fmt/format.h>

#include <algorithm>

#include "cloth/cyclic_lines.h"
#include "cloth/streams.h"
#include "solver/pass_kit.h"
#include "vulkan/error.h"

namespace drape {

namespace {

/// Why a model cannot run by a schedule other than images; empty when it can.
std::string schedule_obstacle(const vulkan::Device& device, const SimulationModel& model, Schedule schedule) {
    if (schedule == Schedule::images) return {};
    if (schedule == Schedule::tiles || schedule == Schedule::cyclic) return large_group_obstacle(device);
    for (const ClothModel& cloth : model.cloths) {
        const std::string obstacle = schedule == Schedule::streams ? streamed_obstacle(device, cloth.grid)
                                                                   : buffered_obstacle(device, cloth.grid);
        if (!obstacle.empty()) return fmt::format("cloth '{}': {}", cloth.name, obstacle);
    }
    if (model.self_contact) return sheet_obstacle(device, model.self_contact->push.grid);
    return {};
}

/// Whether passes of a model run by a schedule otherwise than by those before it in the list.
bool suits(Schedule schedule, const SimulationModel& model) {
    if (!concerns(schedule, model.scene.solver.method)) return false;
    if (schedule != Schedule::streams && schedule != Schedule::tiles) return true;
    return std::ranges::any_of(
        model.cloths, [](const ClothModel& cloth) { return cloth.plan.spare_state || cloth.plan.spare_displacement; });
}

/// What a kind of device takes, the first that it can and that suits the model: what `drape bench speed --tune` finds
/// the fastest. Else images. On GPUs nothing was measured: LINEAR images may load more slowly there, and a line of n
/// particles walked by one invocation waits 3 n times for memory, by cyclic reduction some log n times.
struct PreferredSchedule {
    DeviceKind device;
    Schedule schedule;
};
constexpr PreferredSchedule preferred_schedules[] = {
    {DeviceKind::cpu, Schedule::streams},
    {DeviceKind::cpu, Schedule::buffers},
    {DeviceKind::gpu, Schedule::tiles},
    {DeviceKind::gpu, Schedule::cyclic},
};

Schedule chosen(const vulkan::Device& device, const SimulationModel& model) {
    for (const PreferredSchedule& row : preferred_schedules)
        if (row.device == device_kind(device.info()) && suits(row.schedule, model) &&
            schedule_obstacle(device, model, row.schedule).empty())
            return row.schedule;
    return Schedule::images;
}

}  // namespace

DeviceKind device_kind(const vulkan::DeviceInfo& device) {
    return device.type == "cpu" ? DeviceKind::cpu : DeviceKind::gpu;
}

Schedule possible_schedule(const vulkan::Device& device, const SimulationModel& model, Schedule asked) {
    if (asked == Schedule::automatic) return chosen(device, model);
    const std::string obstacle = schedule_obstacle(device, model, asked);
    if (!obstacle.empty())
        throw vulkan::VulkanError(fmt::format("schedule '{}', {}", spelling(schedule_spellings, asked), obstacle));
    return asked;
}

bool concerns(Schedule schedule, SolverMethod method) {
    switch (schedule) {
        case Schedule::images:
        case Schedule::buffers:
        case Schedule::streams:  // of `line` cells that twist
            return true;
        case Schedule::tiles:
            return method != SolverMethod::line;
        case Schedule::cyclic:
            return method == SolverMethod::line;
        default:
            return false;
    }
}

bool stores_through_buffers(Schedule schedule) {
    return schedule == Schedule::buffers || schedule == Schedule::streams;
}

std::vector<Step> scheduled_steps(const SimulationModel& model, Schedule schedule) {
    switch (schedule) {
        case Schedule::streams:
            return streamed_steps(model);
        case Schedule::tiles:
            return tiled_steps(model);
        case Schedule::cyclic:
            return cyclic_steps(model);
        default:
            return frame_steps(model);
    }
}

}  // namespace drape
