#include "gpu_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <vector>

#include "vulkan/api.h"
#include "vulkan/error.h"

#ifdef __SANITIZE_ADDRESS__
extern "C" {
/// Layers and drivers stay loaded, so that the leak report can name their frames, and so that leaks of theirs (a
/// suppression matches loaded modules only) are told apart from ours.
int dlclose(void*) noexcept { return 0; }
const char* __lsan_default_suppressions() { return "leak:libVkLayer_khronos_validation.so\n"; }
/// The driver's freed images would otherwise stay in quarantine.
const char* __asan_default_options() { return "quarantine_size_mb=8"; }
}
#endif

namespace drape::test {

namespace {

std::unique_ptr<Gpu> the_gpu;

void fail_on_messages(vulkan::ValidationLog& log, std::string_view when) {
    if (log.count() == 0) return;
    std::string all;
    for (const std::string& message : log.messages()) all += "\n  " + message;
    ADD_FAILURE() << log.count() << " validation messages " << when << ":" << all;
    log.clear();
}

}  // namespace

class ValidationListener : public testing::EmptyTestEventListener {
  public:
    void OnTestEnd(const testing::TestInfo&) override {
        if (the_gpu) fail_on_messages(the_gpu->instance.validation_log(), "during this test");
    }
    /// The layer names every object that is left when the device goes.
    void OnEnvironmentsTearDownStart(const testing::UnitTest&) override {
        if (!the_gpu) return;
        the_gpu->device_.reset();
        fail_on_messages(the_gpu->instance.validation_log(), "while the device was destroyed");
        the_gpu.reset();
    }
};

Gpu::Gpu()
    : instance_(
          std::make_unique<vulkan::Instance>(vulkan::InstanceOptions{.validation = true, .print_messages = false})),
      device_(std::make_unique<vulkan::Device>(*instance_, "")),
      instance(*instance_),
      device(*device_) {}

Gpu& gpu() {
    if (!the_gpu) {
        the_gpu = std::make_unique<Gpu>();
        static const bool listening = [] {
            testing::UnitTest::GetInstance()->listeners().Append(new ValidationListener);  // gtest owns it
            return true;
        }();
        static_cast<void>(listening);
    }
    return *the_gpu;
}

bool layer_sees_shared_memory() {
    std::uint32_t count = 0;
    vulkan::check(vkEnumerateInstanceLayerProperties(&count, nullptr), "vkEnumerateInstanceLayerProperties");
    std::vector<VkLayerProperties> layers(count);
    vulkan::check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "vkEnumerateInstanceLayerProperties");
    return std::ranges::any_of(layers, [](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, "VK_LAYER_KHRONOS_validation") == 0 &&
               layer.specVersion < VK_MAKE_API_VERSION(0, 1, 3, 275);
    });
}

ExpectValidationMessages::ExpectValidationMessages() {
    fail_on_messages(gpu().instance.validation_log(), "before the first expected one");
}

ExpectValidationMessages::~ExpectValidationMessages() {
    vulkan::ValidationLog& log = gpu().instance.validation_log();
    EXPECT_GT(log.count(), 0u) << "the validation layer should have reported something";
    log.clear();
}

std::vector<std::string> ExpectValidationMessages::messages() const {
    return gpu().instance.validation_log().messages();
}

std::span<const std::uint32_t> test_shader(std::string_view name) {
    static std::map<std::string, std::vector<std::uint32_t>, std::less<>> modules;
    if (const auto known = modules.find(name); known != modules.end()) return known->second;
    const std::string path = std::string(DRAPE_TEST_SHADER_DIR) + "/" + std::string(name) + ".spv";
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (bytes.empty()) throw std::runtime_error("cannot read " + path);
    std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
    return modules.emplace(name, std::move(words)).first->second;
}

}  // namespace drape::test
