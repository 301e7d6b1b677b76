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
    std::string unusable_reason;     ///< the requirement that it lacks
    std::vector<std::string> lacks;  ///< names of what it is used without (docs/devices.md)

    std::string uuid_text() const;
};

/// The Khronos layer, which must be installed, does core and synchronization validation.
enum class Validation { off, count, print };  ///< print: each message goes to stderr, too
/// Returns what a program's option --validate asks for.
constexpr Validation validation_if(bool asked) { return asked ? Validation::print : Validation::off; }

struct SceneDescription;

/// An opened device that cloth is simulated on; copies share it. One that is validated has to end before main() does,
/// so it is no static variable: Khronos' layer keeps what it needs by thread.
class Device {
  public:
    /// `selector`: INDEX, UUID, a unique part of the NAME, or "cpu"; empty: that of the environment variable
    /// DRAPE_DEVICE, without it the best there is. Throws DeviceError that lists the devices.
    explicit Device(const std::string& selector = {}, Validation validation = Validation::off);

    /// Opens the device so that it runs a scene soonest: lavapipe without worker threads where prefers_calling_thread
    /// says so. If it `draws` on a CPU, a second device with worker threads draws while this one simulates the next
    /// frames. To that end the environment variable LP_NUM_THREADS is set while devices are opened; where it is set
    /// already, and on a GPU, this is the constructor. Call it before other threads run.
    static Device for_scene(const SceneDescription& scene, bool draws, const std::string& selector = {},
                            Validation validation = Validation::off);

    /// Returns every Vulkan device. Throws DeviceError without a Vulkan driver.
    static std::vector<DeviceInfo> list();
    /// Returns what a device must have or may lack, as Markdown; asks none.
    static std::string requirements();

    const DeviceInfo& info() const;
    std::uint64_t validation_count() const;  ///< number of messages so far
    std::uint64_t memory_used() const;       ///< bytes that this library uses
    std::uint64_t memory_limit() const;      ///< bytes
    /// Returns the bytes per second that a copy between buffers reads and writes, 64 MiB on a CPU and 1 GiB by a pass
    /// on a GPU, the median of several; 0 without timestamps.
    double copy_bandwidth() const;

  private:
    friend class Simulation;
    friend class Ensemble;
    struct Parts;
    std::shared_ptr<Parts> parts_;
};

/// Returns whether a scene's simulation is done sooner on one thread, as lavapipe takes about 30 us to hand a dispatch
/// to its worker threads: no cloth, and no cloths that are simulated together, have more than 72 x 72 particles (with
/// self-collision, whose passes are many, 85 x 85).
bool prefers_calling_thread(const SceneDescription& scene);

}  // namespace drape
