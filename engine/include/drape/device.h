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
/// What a program's --validate asks for.
constexpr Validation validation_if(bool asked) { return asked ? Validation::print : Validation::off; }

struct SceneDescription;

/// An opened device; copies share it.
class Device {
  public:
    /// `selector`: INDEX, UUID, a unique part of the NAME, or "cpu"; empty: that of the environment variable
    /// DRAPE_DEVICE, without it the best there is. Throws DeviceError that lists the devices.
    explicit Device(const std::string& selector = {}, Validation validation = Validation::off);

    /// The device as it runs a scene soonest: lavapipe without worker threads where prefers_calling_thread. On a CPU
    /// what it `draws` is drawn by a second device with worker threads, while this one simulates the next frames. For
    /// that the environment variable LP_NUM_THREADS is set while devices are opened; where it is set already, and on a
    /// GPU, this is the constructor. To be called before other threads run.
    static Device for_scene(const SceneDescription& scene, bool draws, const std::string& selector = {},
                            Validation validation = Validation::off);

    /// Every Vulkan device. Throws DeviceError without a Vulkan driver.
    static std::vector<DeviceInfo> list();

    const DeviceInfo& info() const;
    std::uint64_t validation_count() const;  ///< messages so far
    std::uint64_t memory_used() const;       ///< bytes, by this library
    std::uint64_t memory_limit() const;      ///< bytes
    /// Bytes per second that a copy of 64 MiB reads and writes, median of several; 0 where the device has no
    /// timestamps.
    double copy_bandwidth() const;

  private:
    friend class Simulation;
    struct Parts;
    std::shared_ptr<Parts> parts_;
};

/// Lavapipe hands every dispatch to its worker threads, which takes about 30 us. Whether a scene's simulation is done
/// sooner on one thread: no cloth, and no cloths that are simulated together, have more than 72 x 72 particles (with
/// self-collision, whose passes are many, 85 x 85).
bool prefers_calling_thread(const SceneDescription& scene);

}  // namespace drape
