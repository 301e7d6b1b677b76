#include "solver/copy_bandwidth.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "solver/compute_pass.h"
#include "vulkan/api.h"
#include "vulkan/frame_slots.h"

namespace drape {

namespace {

constexpr std::uint64_t mebibyte = 1 << 20;

void add_command(graph::Graph& graph, graph::Handle source, graph::Handle empty, std::uint64_t byte_count) {
    const auto target = std::make_shared<graph::Handle>();  // set-up sets it, recording uses it
    graph.add_pass(
        {"copy", "copy", "copy"},
        [&](graph::PassSetup& setup) {
            setup.read(source, graph::Access::transfer_read);
            *target = setup.write(empty, graph::Access::transfer_write);
        },
        [source, target, byte_count](graph::PassContext& context) {
            const VkBufferCopy region{0, 0, byte_count};
            vkCmdCopyBuffer(context.commands(), context.buffer(source).handle(), context.buffer(*target).handle(), 1,
                            &region);
        });
}

void add_shader(graph::Graph& graph, Pipelines& pipelines, graph::Handle source, graph::Handle target,
                std::uint64_t byte_count) {
    // A device may have no more than 65,535 workgroups in a row.
    constexpr std::uint64_t across = 1 << 20;
    const std::uint64_t texels = byte_count / sizeof(glsl::vec4);
    const DispatchSize size{static_cast<std::uint32_t>(std::min(texels, across)),
                            static_cast<std::uint32_t>((texels + across - 1) / across)};
    add_compute_pass(graph, {"copy", "copy", "copy"}, pipelines.get("copy.comp"), {}, size,
                     {.own = {{"source", &source}, {"target", &target}}});
}

}  // namespace

CopyRuler copy_ruler(const vulkan::Device& device) {
    if (device.info().type == "cpu") return {false, 64 * mebibyte};
    const std::uint64_t room = std::min<std::uint64_t>(
        {device.limits().maxStorageBufferRange, device.capabilities().max_buffer_size, device.budget().limit() / 4});
    std::uint64_t byte_count = 1024 * mebibyte;
    while (byte_count > 64 * mebibyte && byte_count > room) byte_count /= 2;
    return {true, byte_count};
}

double copy_bandwidth(const vulkan::Device& device, CopyRuler ruler) {
    constexpr int run_count = 7;
    graph::Graph graph;
    Pipelines pipelines(device);
    const auto declare = [&](const char* name) {
        return graph.buffer({name, ruler.byte_count, graph::Lifetime::persistent, &glsl::layout_of<glsl::vec4>()});
    };
    const graph::Handle source = declare("source"), target = declare("target");
    if (ruler.by_pass)
        add_shader(graph, pipelines, source, target, ruler.byte_count);
    else
        add_command(graph, source, target, ruler.byte_count);
    const graph::Plan plan = make_plan(graph);
    const std::pair<const graph::Graph*, const graph::Plan*> plans[] = {{&graph, &plan}};
    const graph::ResourcePool pool(device, plans);
    const graph::RecordedPlan recorded(graph, plan, pool, graph::TimestampMode::passes);
    vulkan::FrameSlots slots(device);
    std::vector<double> milliseconds;
    for (int run = 0; run <= run_count; ++run) {
        slots.submit(0, recorded.commands(0));
        slots.wait(0);
        const std::vector<graph::Timing> timings = recorded.timings(0);
        if (timings.empty()) return 0;
        if (run > 0) milliseconds.push_back(timings[0].milliseconds);
    }
    std::ranges::nth_element(milliseconds, milliseconds.begin() + run_count / 2);
    return 2.0 * static_cast<double>(ruler.byte_count) / (1e-3 * milliseconds[run_count / 2]);
}

}  // namespace drape
