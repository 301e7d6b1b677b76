// A small scene of everything gives every bit of the state after every frame on the device as on the C++ twin, and no
// message of the validation layer. It needs a device with IEEE arithmetic, as lavapipe is.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "cloth/self_contact.h"
#include "device_run.h"
#include "drape/scene_reader.h"
#include "simulation/frame_server.h"
#include "small_scene.h"
#include "solver/contact_readback.h"
#include "support/twin_fields.h"
#include "support/twin_with_cuts.h"
#include "twin/twin.h"
#include "vulkan/error.h"

#ifdef __SANITIZE_ADDRESS__
#define DRAPE_FUZZ_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define DRAPE_FUZZ_SANITIZED
#endif
#endif

namespace drape {
namespace {

using fuzz::require;

/// A device with core and synchronization validation.
struct Gpu {
    vulkan::Instance instance{vulkan::InstanceOptions{.validation = true, .print_messages = false}};
    vulkan::Device device{instance, "cpu"};
};

Gpu& gpu() {
    static Gpu the_gpu;
    return the_gpu;
}

void compare(const FieldRow& row, std::span<const std::byte> device, std::span<const std::byte> twin,
             std::uint32_t frame) {
    if (std::ranges::equal(device, twin)) return;
    std::string where = "not the same";
    if (&row.element == &glsl::layout_of<glsl::vec4>())
        test::same_bits(test::texels_of<glsl::vec4>(device), test::texels_of<glsl::vec4>(twin), where);
    require(false, fmt::format("{} after frame {}: {}", row.name, frame, where));
}

bool is_finite(std::span<const std::byte> texels) {
    return std::ranges::all_of(test::texels_of<float>(texels), [](float number) { return std::isfinite(number); });
}

/// Returns whether the frame is a result at all; a run ends where it is none. Comparisons and conversions of numbers
/// that are none may differ, and so may pairs that found no room in the device's lists, where the twin tries all.
bool goes_on(const SimulationModel& model, const Twin& twin, const test::DeviceRun& device) {
    bool twin_finite = true, device_finite = true;
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
        for (const Field field : {Field::position, Field::displacement}) {
            twin_finite = twin_finite && is_finite(twin.cloth(cloth).bytes(field));
            device_finite = device_finite && is_finite(device.bytes(cloth, field));
        }
    if (self_list_use(device.solver().layout(), self_record(device.solver().layout(), device.pool(), 0)) > 1)
        return false;
    require(twin_finite == device_finite, "finite on the twin or on the device alone");
    return twin_finite;
}

/// Compares every field of the state.
void compare_states(const SimulationModel& model, const Kernels& kernels) {
    Twin twin(model);
    test::DeviceRun device(gpu().device, model, {}, kernels);
    for (std::uint32_t frame = 1; frame < model.scene.time.frame_count; ++frame) {
        twin.run_frame(frame);
        device.run_frame(frame);
        if (!goes_on(model, twin, device)) return;
        test::for_compared_fields(model, twin, [&](std::size_t cloth, const FieldRow& row, const auto& expected) {
            compare(row, device.bytes(cloth, row.field), expected, frame);
        });
    }
}

/// Compares positions, with what the cutters cut.
void compare_cut(const SceneDescription& scene, const Kernels& kernels) {
    test::TwinWithCuts twin(scene);
    FrameOptions options;
    options.draw = false;
    options.positions = true;
    options.kernels = kernels;
    FrameServer server(gpu().device, twin.model(), options);
    bool finite = true;
    const auto compare_frame = [&](const FinishedFrame& frame) {
        twin.run_frame(frame.frame);
        for (std::size_t cloth = 0; cloth < scene.cloths.size(); ++cloth) {
            finite = finite && is_finite(std::as_bytes(std::span(twin.position(cloth))));
            if (!finite) return;
            compare(row_of(Field::position), std::as_bytes(frame.positions[cloth]),
                    std::as_bytes(std::span(twin.position(cloth))), frame.frame);
        }
    };
    try {
        server.run(
            scene.time.frame_count - 1, [](std::uint32_t) { return true; }, compare_frame, [&] { return !finite; });
    } catch (const vulkan::VulkanError&) {
        if (!twin.model().self_contact) throw;  // else its lists were full
    }
}

void check_messages() {
    vulkan::ValidationLog& log = gpu().instance.validation_log();
    if (log.count() == 0) return;
    const std::string first = log.messages().front();
    log.clear();
    require(false, first);
}

}  // namespace
}  // namespace drape

#ifdef DRAPE_FUZZ_SANITIZED
extern "C" {
/// Drivers and layers stay loaded, as in gpu_test.cpp, so that their leaks can be told from ours.
int dlclose(void*) noexcept { return 0; }
}
#endif

extern "C" int DRAPE_FUZZ_ENTRY(twin_device)(const std::uint8_t* data, std::size_t size) {
    using namespace drape;
    fuzz::Dice dice({data, size});
    const std::string text = fuzz::small_scene(dice, {.longest_side = 7, .frames = 2, .substeps = 3});
    if (std::getenv("DRAPE_FUZZ_PRINT")) fmt::print(stderr, "{}\n", text);
    const SceneResult result = read_scene_text(text, "small scene");
    if (!result.scene) return 0;
    const SimulationModel model(*result.scene);
    const std::vector<Kernels> sets = test::kernel_sets(gpu().device, model);
    const Kernels& kernels = sets[dice.below(static_cast<std::uint32_t>(sets.size()))];
    if (result.scene->cutters.empty())
        compare_states(model, kernels);
    else
        compare_cut(*result.scene, kernels);
    check_messages();
    return 0;
}
