#include "graph/executor.h"

#include <algorithm>
#include <cstring>

#include "vulkan/api.h"
#include "vulkan/structure.h"

namespace drape::graph {

using vulkan::structure;

/// Records a plan for one frame slot.
class Recorder {
  public:
    Recorder(const Graph& graph, const Plan& plan, const ResourcePool& pool, const BarrierFilter& keep,
             vulkan::Descriptors& descriptors)
        : graph_(graph), plan_(plan), pool_(pool), keep_(keep), descriptors_(descriptors) {
        if (!pool.device().instance().validation()) return;
        const VkInstance instance = pool.device().instance().handle();
        begin_label_ = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(
            vkGetInstanceProcAddr(instance, "vkCmdBeginDebugUtilsLabelEXT"));
        end_label_ = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(
            vkGetInstanceProcAddr(instance, "vkCmdEndDebugUtilsLabelEXT"));
    }

    /// Timestamps are written before the passes at the ascending positions `bracket_begins`; all end up in `ticks`.
    void record(VkCommandBuffer commands, std::uint32_t slot, VkQueryPool queries, const vulkan::Buffer* ticks,
                std::span<const std::uint32_t> bracket_begins) const {
        auto begin = structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
        vulkan::check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
        const auto query_count = static_cast<std::uint32_t>(bracket_begins.size() + 1);
        if (queries) vkCmdResetQueryPool(commands, queries, 0, query_count);
        std::uint32_t query = 0;
        for (std::uint32_t position = 0; position < plan_.passes.size(); ++position) {
            if (query < bracket_begins.size() && bracket_begins[query] == position) {
                write_timestamp(commands, queries, query++);
            }
            record_pass(commands, slot, plan_.passes[position]);
        }
        emit(commands, plan_.final_barriers);
        write_timestamp(commands, queries, query);
        if (queries) copy_timestamps(commands, queries, query_count, *ticks);
        vulkan::check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
    }

  private:
    void record_pass(VkCommandBuffer commands, std::uint32_t slot, const PlannedPass& planned) const {
        const Pass& pass = graph_.passes()[planned.pass];
        if (begin_label_) {
            auto label = structure<VkDebugUtilsLabelEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT);
            label.pLabelName = pass.name.c_str();
            begin_label_(commands, &label);
        }
        if (keep_) {
            std::vector<Barrier> kept;
            for (const Barrier& barrier : planned.barriers) {
                if (keep_(planned, barrier)) kept.push_back(barrier);
            }
            emit(commands, kept);
        } else {
            emit(commands, planned.barriers);
        }
        if (pass.execute) {
            PassContext context(commands, slot, graph_, pass, pool_, descriptors_);
            pass.execute(context);
        }
        if (end_label_) end_label_(commands);
    }

    static void write_timestamp(VkCommandBuffer commands, VkQueryPool queries, std::uint32_t query) {
        if (queries) vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries, query);
    }

    /// The device copies the timestamps, since a query by the host makes the default device finish all of its work
    /// first (docs/devices.md).
    static void copy_timestamps(VkCommandBuffer commands, VkQueryPool queries, std::uint32_t count,
                                const vulkan::Buffer& ticks) {
        vkCmdCopyQueryPoolResults(commands, queries, 0, count, ticks.handle(), 0, sizeof(std::uint64_t),
                                  VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
        auto memory = structure<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
        memory.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
        memory.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        memory.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
        memory.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
        depend(commands, memory, {});
    }

    static void depend(VkCommandBuffer commands, const VkMemoryBarrier2& memory,
                       const std::vector<VkImageMemoryBarrier2>& images) {
        auto dependency = structure<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
        dependency.memoryBarrierCount = memory.dstStageMask != 0 ? 1 : 0;
        dependency.pMemoryBarriers = &memory;
        dependency.imageMemoryBarrierCount = static_cast<std::uint32_t>(images.size());
        dependency.pImageMemoryBarriers = images.data();
        vkCmdPipelineBarrier2(commands, &dependency);
    }

    /// A single command contains everything: layout changes as image barriers, the rest merged into one memory barrier.
    void emit(VkCommandBuffer commands, const std::vector<Barrier>& barriers) const {
        if (barriers.empty()) return;
        auto memory = structure<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
        std::vector<VkImageMemoryBarrier2> images;
        for (const Barrier& barrier : barriers) {
            if (barrier.old_layout != barrier.new_layout) {
                images.push_back(layout_change(barrier));
                continue;
            }
            memory.srcStageMask |= barrier.source_stages;
            memory.srcAccessMask |= barrier.source_accesses;
            memory.dstStageMask |= barrier.destination_stages;
            memory.dstAccessMask |= barrier.destination_accesses;
        }
        depend(commands, memory, images);
    }

    VkImageMemoryBarrier2 layout_change(const Barrier& barrier) const {
        const vulkan::Image& image = pool_.image(graph_.resources()[barrier.resource].name);
        auto change = structure<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
        change.srcStageMask = barrier.source_stages;
        change.srcAccessMask = barrier.source_accesses;
        change.dstStageMask = barrier.destination_stages;
        change.dstAccessMask = barrier.destination_accesses;
        change.oldLayout = barrier.old_layout;
        change.newLayout = barrier.new_layout;
        change.srcQueueFamilyIndex = change.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        change.image = image.handle();
        change.subresourceRange = {image.aspect(), 0, 1, 0, 1};
        return change;
    }

    const Graph& graph_;
    const Plan& plan_;
    const ResourcePool& pool_;
    const BarrierFilter& keep_;
    vulkan::Descriptors& descriptors_;
    PFN_vkCmdBeginDebugUtilsLabelEXT begin_label_ = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT end_label_ = nullptr;
};

RecordedPlan::RecordedPlan(const Graph& graph, const Plan& plan, const ResourcePool& pool, TimestampMode timestamps,
                           const BarrierFilter& keep)
    : RecordedPlan(pool.device(), Empty{}) {
    set_brackets(graph, plan, timestamps);
    make_pools();
    const Recorder recorder(graph, plan, pool, keep, descriptors_);
    for (std::uint32_t slot = 0; slot < commands_.size(); ++slot) {
        recorder.record(commands_[slot], slot, queries_[slot], ticks_.empty() ? nullptr : &ticks_[slot],
                        bracket_begins_);
    }
}

RecordedPlan::~RecordedPlan() {
    for (const VkQueryPool queries : queries_) vkDestroyQueryPool(device_.handle(), queries, nullptr);
    vkDestroyCommandPool(device_.handle(), pool_, nullptr);
}

void RecordedPlan::set_brackets(const Graph& graph, const Plan& plan, TimestampMode timestamps) {
    if (timestamps == TimestampMode::none || device_.capabilities().timestamp_valid_bits == 0) return;
    for (std::uint32_t position = 0; position < plan.passes.size(); ++position) {
        const Pass& pass = graph.passes()[plan.passes[position].pass];
        const std::string& name = timestamps == TimestampMode::stages ? pass.stage : pass.label;
        const bool continues =
            timestamps == TimestampMode::stages && !brackets_.empty() && brackets_.back().first == name;
        if (continues) continue;
        // A timestamp costs 10 us on a CPU device, so the end of one bracket is also the begin of the next.
        const auto query = static_cast<std::uint32_t>(brackets_.size());
        brackets_.push_back({name, {query, query + 1}});
        bracket_begins_.push_back(position);
    }
}

void RecordedPlan::make_pools() {
    auto pool = structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.queueFamilyIndex = device_.queue_family();
    vulkan::create_handle(vkCreateCommandPool, device_.handle(), pool, pool_, "vkCreateCommandPool", "plan");
    auto allocation = structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocation.commandPool = pool_;
    allocation.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocation.commandBufferCount = static_cast<std::uint32_t>(commands_.size());
    vulkan::check(vkAllocateCommandBuffers(device_.handle(), &allocation, commands_.data()), "vkAllocateCommandBuffers",
                  "plan");
    if (brackets_.empty()) return;
    auto queries = structure<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
    queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
    queries.queryCount = static_cast<std::uint32_t>(brackets_.size() + 1);
    for (VkQueryPool& slot : queries_) {
        vulkan::create_handle(vkCreateQueryPool, device_.handle(), queries, slot, "vkCreateQueryPool", "plan");
        const vulkan::Buffer& ticks = ticks_.emplace_back(
            device_, vulkan::BufferDescription{"timestamps", queries.queryCount * sizeof(std::uint64_t),
                                               VK_BUFFER_USAGE_TRANSFER_DST_BIT, vulkan::BufferHome::readback});
        std::ranges::fill(ticks.mapped(), std::byte{0});
    }
}

std::vector<Timing> RecordedPlan::timings(std::uint32_t slot) const {
    std::vector<Timing> timings;
    if (brackets_.empty()) return timings;
    std::vector<std::uint64_t> ticks(brackets_.size() + 1);
    std::memcpy(ticks.data(), ticks_[slot].mapped().data(), std::span(ticks).size_bytes());
    if (ticks.back() == 0) return timings;  // it was never submitted
    const std::uint32_t bits = device_.capabilities().timestamp_valid_bits;
    const std::uint64_t mask = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    const double milliseconds_per_tick = static_cast<double>(device_.limits().timestampPeriod) * 1e-6;
    std::map<std::string, std::size_t> places;
    for (const auto& [name, queries] : brackets_) {
        const auto [place, added] = places.emplace(name, timings.size());
        if (added) timings.push_back({name, 0});
        const std::uint64_t elapsed = (ticks[queries[1]] - ticks[queries[0]]) & mask;
        timings[place->second].milliseconds += static_cast<double>(elapsed) * milliseconds_per_tick;
    }
    return timings;
}

}  // namespace drape::graph
