// The device that cloth is simulated on.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace drape {

struct DeviceInfo {
    std::uint32_t index = 0;
    std::string name, type, driver, driver_version, api_version;  ///< type: discrete, integrated, virtual, cpu, other
    std::array<std::uint8_t, 16> uuid{};
    bool usable = true;
    std::string unusable_reason;  ///< which requirement it lacks

    std::string uuid_text() const;
};

/// Core and synchronization validation by the Khronos layer, which must be installed.
enum class Validation { off, count, print };  ///< print: each message on stderr, too

/// An opened device; copies share it.
class Device {
  public:
    /// `selector`: empty (the best there is), INDEX, UUID, a unique part of the NAME, or "cpu". Throws DeviceError that
    /// lists the devices.
    explicit Device(const std::string& selector = {}, Validation validation = Validation::off);

    /// Every Vulkan device. Throws DeviceError without a Vulkan driver.
    static std::vector<DeviceInfo> list();

    const DeviceInfo& info() const;
    std::uint64_t validation_count() const;  ///< messages so far
    std::uint64_t memory_used() const;       ///< bytes, by this library
    std::uint64_t memory_limit() const;      ///< bytes

  private:
    friend class Simulation;
    struct Parts;
    std::shared_ptr<Parts> parts_;
};

}  // namespace drape
