#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "drape/device.h"
#include "vulkan/error.h"

namespace drape::vulkan {

/// Counts validation messages (warnings and errors) and keeps the texts of the first `kept_message_count`; thread-safe.
/// The performance warning about copies and clears in GENERAL is not counted, because storage images stay in GENERAL on
/// purpose.
class ValidationLog {
  public:
    static constexpr std::size_t kept_message_count = 1000;
    void add(std::string message_id, std::string text);
    std::uint64_t count() const { return count_; }
    std::vector<std::string> messages() const;
    void clear();

  private:
    std::atomic<std::uint64_t> count_ = 0;
    mutable std::mutex mutex_;
    std::vector<std::string> messages_;
};

struct InstanceOptions {
    bool validation = false;     ///< core + synchronization validation; throws when the layer is missing
    bool print_messages = true;  ///< echo each message on stderr
};

using drape::DeviceInfo;

class Instance {
  public:
    /// Throws VulkanError without a loader, a driver or (when asked for) the validation layer. Several instances may
    /// live at once.
    explicit Instance(const InstanceOptions& options);
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    VkInstance handle() const { return handle_; }
    bool validation() const { return validation_; }
    ValidationLog& validation_log() const { return *log_; }
    /// Returns every physical device, in the loader's order, with the reason if it cannot be used. The driver was
    /// queried once, when the instance was made.
    std::vector<DeviceInfo> devices() const { return devices_; }
    VkPhysicalDevice physical_device(std::uint32_t index) const { return physical_devices_.at(index); }

  private:
    struct Echo;
    struct Empty {};
    /// Makes an object without handles. After this constructor, an exception in the delegating one runs the destructor.
    Instance(const InstanceOptions& options, Empty);
    void create(bool validation);
    void list_devices();
    VkInstance handle_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    bool validation_ = false;
    std::unique_ptr<ValidationLog> log_;
    std::unique_ptr<Echo> echo_;
    std::vector<VkPhysicalDevice> physical_devices_;
    std::vector<DeviceInfo> devices_;
};

}  // namespace drape::vulkan
