#include "graph/copy_bandwidth.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "graph/executor.h"
#include "vulkan/api.h"
#include "vulkan/frame_slots.h"

namespace drape::graph {

double copy_bandwidth(const vulkan::Device& device) {
    constexpr std::uint64_t byte_count = 64 << 20;
    constexpr int run_count = 7;
    Graph graph;
    const Handle source = graph.buffer({"source", byte_count, Lifetime::persistent});
    const Handle empty = graph.buffer({"target", byte_count, Lifetime::persistent});
    const auto target = std::make_shared<Handle>();  // set-up sets it, recording uses it
    graph.add_pass(
        {"copy", "copy", "copy"},
        [&](PassSetup& setup) {
            setup.read(source, Access::transfer_read);
            *target = setup.write(empty, Access::transfer_write);
        },
        [source, target](PassContext& context) {
            const VkBufferCopy region{0, 0, byte_count};
            vkCmdCopyBuffer(context.commands(), context.buffer(source).handle(), context.buffer(*target).handle(), 1,
                            &region);
        });
    const Plan plan = make_plan(graph);
    const std::pair<const Graph*, const Plan*> plans[] = {{&graph, &plan}};
    const ResourcePool pool(device, plans);
    const RecordedPlan recorded(graph, plan, pool, TimestampMode::passes);
    vulkan::FrameSlots slots(device);
    std::vector<double> milliseconds;
    for (int run = 0; run <= run_count; ++run) {
        slots.submit(0, recorded.commands(0));
        slots.wait(0);
        const std::vector<Timing> timings = recorded.timings(0);
        if (timings.empty()) return 0;
        if (run > 0) milliseconds.push_back(timings[0].milliseconds);
    }
    std::ranges::nth_element(milliseconds, milliseconds.begin() + run_count / 2);
    return 2.0 * byte_count / (1e-3 * milliseconds[run_count / 2]);
}

}  // namespace drape::graph
