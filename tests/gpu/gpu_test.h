// All tests that need a device share one validated device per process, and a listener that fails the test during which
// the validation layer said anything.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vulkan/device.h"
#include "vulkan/instance.h"

namespace drape::test {

/// The device under test, with core and synchronization validation.
class Gpu {
  public:
    Gpu();
    Gpu(const Gpu&) = delete;
    Gpu& operator=(const Gpu&) = delete;

  private:
    friend class ValidationListener;
    std::unique_ptr<vulkan::Instance> instance_;
    std::unique_ptr<vulkan::Device> device_;

  public:
    const vulkan::Instance& instance;
    const vulkan::Device& device;
};

/// Made at the first call, on the device that main() chose.
/// Without a device, a driver or the validation layer it throws, so the test fails: a machine that cannot
/// run these tests must not look green. From then on every test of the process fails when the layer reports
/// something during it, and the process fails when device objects are left at its end.
Gpu& gpu();

/// Whether the validation layer sees a hazard between a linear image and a buffer that share memory (docs/devices.md):
/// where it does not, no message can be expected of one.
bool layer_sees_shared_memory();

/// While it lives the validation layer is expected to speak: the test fails when it does not, and does not fail because
/// it does.
class ExpectValidationMessages {
  public:
    ExpectValidationMessages();
    ~ExpectValidationMessages();
    ExpectValidationMessages(const ExpectValidationMessages&) = delete;
    ExpectValidationMessages& operator=(const ExpectValidationMessages&) = delete;
    /// Returns the layer's messages so far.
    std::vector<std::string> messages() const;
};

/// Returns the SPIR-V of tests/gpu/shaders/NAME, valid for the rest of the process.
std::span<const std::uint32_t> test_shader(std::string_view name);

}  // namespace drape::test
