// Creates the resources of a set of graphs, records each plan once per frame slot, resubmits it and reads timestamps.
// No other part of the graph needs a device.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "graph/plan.h"
#include "graph/push_constants.h"
#include "vulkan/descriptors.h"
#include "vulkan/frame_slots.h"
#include "vulkan/pipeline.h"
#include "vulkan/resources.h"

namespace drape::graph {

/// Holds the images and buffers, by name, that all plans of a scene share. Resources that no plan uses are not created.
class ResourcePool {
  public:
    /// Sums all sizes first and throws VulkanError before allocating when they exceed the budget. Usage flags are what
    /// the plans' uses need, plus transfer for set-up and tests. A resource that several graphs declare must be
    /// declared equally (GraphError otherwise). Persistent and constant images start zeroed, in GENERAL; buffers start
    /// zeroed.
    ResourcePool(const vulkan::Device& device, std::span<const std::pair<const Graph*, const Plan*>> plans);

    const vulkan::Device& device() const { return device_; }
    bool has(const std::string& name) const;
    /// Returns an image, or a slice of one that a plan uses alone. Throws GraphError when there is none.
    const vulkan::Image& image(const std::string& name) const;
    /// `slot` matters for host_input and host_output buffers only.
    const vulkan::Buffer& buffer(const std::string& name, std::uint32_t slot = 0) const;

  private:
    const vulkan::Device& device_;
    std::map<std::string, vulkan::Image> images_;
    std::map<std::string, const vulkan::Image*> slices_;
    std::map<std::string, std::vector<vulkan::Buffer>> buffers_;  ///< 1 or frame_slot_count copies
};

/// Returns the bytes of all resources that these plans use together.
std::uint64_t planned_bytes(std::span<const std::pair<const Graph*, const Plan*>> plans);

/// Returns why the device cannot give an image a buffer view with rows `row_pitch` texels apart (0: any); empty when it
/// can. Callers without a buffer view use the image alone.
std::string buffer_view_obstacle(const vulkan::Device& device, const ImageDeclaration& image,
                                 std::uint32_t row_pitch = 0);

enum class TimestampMode { none, stages, passes };

/// The resource that a draw binds to a variable of its shaders.
struct Binding {
    std::string_view variable;
    Handle handle;
};

/// The argument of a pass's execute function. Every access is compared with what the pass declared.
class PassContext {
  public:
    VkCommandBuffer commands() const { return commands_; }
    std::uint32_t slot() const { return slot_; }
    /// Return the resource. They throw GraphError, naming pass and resource, when the pass did not declare the handle.
    const vulkan::Image& image(Handle handle) const;
    const vulkan::Buffer& buffer(Handle handle) const;
    /// Returns the number of texels from one row to the next in the buffer view of an image that has one.
    std::uint32_t row_pitch(Handle handle) const { return image(handle).row_pitch(); }
    /// Returns the image's layout during this pass, which its declared access decides. Throws as `image` does.
    VkImageLayout layout(Handle handle) const;

    /// Binds the pipeline and every declared use that has a variable, pushes the push constants, then dispatches
    /// enough workgroups for width x height invocations, `depth` layers of them. Throws GraphError, naming pass,
    /// pipeline and variable, when the pipeline's descriptors and the declared variables differ (one missing on either
    /// side, image against buffer, read against write, format, layout of a buffer's elements), or the push constants'
    /// layouts. A read-write descriptor needs a write of its name, and a read without one.
    void dispatch(const vulkan::ComputePipeline& pipeline, const PushConstants& push_constants, std::uint32_t width,
                  std::uint32_t height, std::uint32_t depth = 1);
    /// Dispatches as many workgroups as `arguments` says at `offset` bytes (VkDispatchIndirectCommand).
    void dispatch_indirect(const vulkan::ComputePipeline& pipeline, const PushConstants& push_constants,
                           Handle arguments, std::uint64_t offset);

    /// Binds the pipeline and one handle per descriptor, with the same checks, in a pass that draws several things. The
    /// pass must have declared a read of the handle for each stage that uses the descriptor.
    void bind(const vulkan::GraphicsPipeline& pipeline, std::span<const Binding> bindings);
    /// Throws GraphError when the shaders' push constants have another layout.
    void push(const vulkan::Pipeline& pipeline, const PushConstants& push_constants);

  private:
    friend class Recorder;
    PassContext(VkCommandBuffer commands, std::uint32_t slot, const Graph& graph, const Pass& pass,
                const ResourcePool& pool, vulkan::Descriptors& descriptors)
        : commands_(commands), slot_(slot), graph_(graph), pass_(pass), pool_(pool), descriptors_(descriptors) {}
    const Use& use_of(Handle handle) const;
    void bind_uses(const vulkan::ComputePipeline& pipeline);
    void check_use(const vulkan::Pipeline& pipeline, const Use& use) const;
    /// Checks kind, format and element.
    void check_resource(const vulkan::Pipeline& pipeline, std::string_view variable, const Resource& resource) const;
    void bind_descriptors(const vulkan::Pipeline& pipeline, std::span<const Binding> bindings);
    [[noreturn]] void refuse(const vulkan::Pipeline& pipeline, std::string_view variable, const std::string& why) const;
    VkCommandBuffer commands_;
    std::uint32_t slot_;
    const Graph& graph_;
    const Pass& pass_;
    const ResourcePool& pool_;
    vulkan::Descriptors& descriptors_;
};

struct Timing {
    std::string name;  ///< name of the stage or label of the pass
    double milliseconds = 0;
};

/// A filter removes barriers on purpose, for the canary test that a planted hazard is reported.
using BarrierFilter = std::function<bool(const PlannedPass&, const Barrier&)>;

/// A plan recorded into one command buffer per frame slot.
class RecordedPlan {
  public:
    /// `keep` (default: all) may drop barriers, for canary tests only.
    RecordedPlan(const Graph& graph, const Plan& plan, const ResourcePool& pool, TimestampMode timestamps,
                 const BarrierFilter& keep = {});
    ~RecordedPlan();
    RecordedPlan(const RecordedPlan&) = delete;
    RecordedPlan& operator=(const RecordedPlan&) = delete;

    VkCommandBuffer commands(std::uint32_t slot) const { return commands_[slot]; }
    /// Returns the times of the slot's last finished submit, in order, summed by name (stages) or by label (passes).
    /// Ticks are masked by timestampValidBits and multiplied by timestampPeriod in double precision. Empty when the
    /// device has no timestamps, and before the first submit.
    std::vector<Timing> timings(std::uint32_t slot) const;

  private:
    struct Empty {};
    /// Makes an object without handles. After this constructor, an exception in the delegating one runs the destructor.
    RecordedPlan(const vulkan::Device& device, Empty) : device_(device), descriptors_(device) {}
    void set_brackets(const Graph& graph, const Plan& plan, TimestampMode timestamps);
    void make_pools();

    const vulkan::Device& device_;
    vulkan::Descriptors descriptors_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    std::array<VkCommandBuffer, vulkan::frame_slot_count> commands_{};
    std::array<VkQueryPool, vulkan::frame_slot_count> queries_{};
    std::vector<vulkan::Buffer> ticks_;  ///< by slot: the results of its queries, all 0 before its first submit
    /// Name, first and last query; neighbours share one. Each begins with the pass of the same place in
    /// bracket_begins_.
    std::vector<std::pair<std::string, std::array<std::uint32_t, 2>>> brackets_;
    std::vector<std::uint32_t> bracket_begins_;
};

}  // namespace drape::graph
