// The face of devices (drape/device.h).
#include "drape/device.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "cloth/together.h"
#include "simulation/device_parts.h"
#include "solver/copy_bandwidth.h"
#include "solver/kernel_choice.h"
#include "vulkan/device_requirements.h"
#include "world/start_crossings.h"

namespace drape {

Device::Device(const std::string& selector, Validation validation)
    : parts_(std::make_shared<Parts>(selector, validation)) {}

bool prefers_calling_thread(const SceneDescription& scene) {
    const std::uint64_t most_particles = cloths_meet(scene) ? 85 * 85 : 72 * 72;
    const auto is_small = [&](std::size_t cloth, std::size_t count) {
        const auto [columns, rows] = scene.cloths[cloth].grid;
        return std::uint64_t{columns} * rows * count <= most_particles;
    };
    bool small = true;
    for (std::size_t cloth = 0; cloth < scene.cloths.size(); ++cloth) small = small && is_small(cloth, 1);
    for (const std::vector<std::size_t>& list : cloths_alike(scene)) small = small && is_small(list[0], list.size());
    return small;
}

Device Device::for_scene(const SceneDescription& scene, bool draws, const std::string& selector,
                         Validation validation) {
    constexpr const char* variable = "LP_NUM_THREADS";  // lavapipe reads this when a device is searched for
    if (std::getenv(variable)) return Device(selector, validation);
    if (prefers_calling_thread(scene)) setenv(variable, "0", 0);
    std::optional<Device> device;
    try {
        device.emplace(selector, validation);
    } catch (...) {
        unsetenv(variable);
        throw;
    }
    unsetenv(variable);
    if (draws && device_kind(device->info()) == DeviceKind::cpu)
        device->parts_->drawing = std::make_unique<Parts>(device->info().uuid_text(), validation);
    return *device;
}

std::vector<DeviceInfo> Device::list() { return vulkan::Instance({}).devices(); }
std::string Device::requirements() { return vulkan::device_requirements_document(); }
const DeviceInfo& Device::info() const { return parts_->device.info(); }

std::uint64_t Device::validation_count() const {
    const std::uint64_t own = parts_->instance.validation_log().count();
    return parts_->drawing ? own + parts_->drawing->instance.validation_log().count() : own;
}

std::uint64_t Device::memory_used() const {
    const std::uint64_t own = parts_->device.budget().used();
    return parts_->drawing ? own + parts_->drawing->device.budget().used() : own;
}

std::uint64_t Device::memory_limit() const { return parts_->device.budget().limit(); }
double Device::copy_bandwidth() const { return drape::copy_bandwidth(parts_->device, copy_ruler(parts_->device)); }

}  // namespace drape
