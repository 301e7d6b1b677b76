// The frames of a scene on the device: graphs for each kind of frame, two frames in flight, results handed out
// in order. The host never reads positions to simulate; it reads them only where an export asks for them.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cloth/schedule.h"
#include "drape/simulation.h"
#include "graph/executor.h"
#include "passes/cloth_solver.h"
#include "passes/raster.h"

namespace drape {

/// A cut found at the end of a frame; it acts from the next frame on.
struct CutEvent {
    std::uint32_t frame;
    std::size_t cloth;
    CutCounts counts;
};

struct FrameLoopOptions {
    bool draw = true;         ///< colour images are wanted
    bool positions = false;   ///< position arrays are wanted
    bool normals = false;     ///< arrays of normals are wanted
    bool statistics = false;  ///< statistics of every frame handed out are wanted
    std::uint32_t width = 1280, height = 720, samples = 4;
    graph::TimestampMode timestamps = graph::TimestampMode::stages;
    /// Told of every cut, with the cloth's topology after it.
    std::function<void(const CutEvent&, const CutTopology&)> on_cut;
    graph::BarrierFilter barrier_filter;  ///< canary tests only
};

/// What happens in a frame: frame 0 is the initial state; frames that nobody asked for are only simulated. The
/// second three also search for cuts; they exist only when the scene has cutters.
enum class FrameKind { initial, simulate, simulate_and_output, initial_cut, simulate_cut, simulate_and_output_cut };
inline constexpr std::size_t plain_frame_kind_count = 3, frame_kind_count = 6;
constexpr bool searches_cuts(FrameKind kind) { return static_cast<std::size_t>(kind) >= plain_frame_kind_count; }
constexpr FrameKind with_cut_search(FrameKind kind) {
    return static_cast<FrameKind>(static_cast<std::size_t>(kind) + plain_frame_kind_count);
}
/// The kind without the search for cuts.
constexpr FrameKind plain(FrameKind kind) {
    return static_cast<FrameKind>(static_cast<std::size_t>(kind) % plain_frame_kind_count);
}

class FrameLoop {
  public:
    /// Builds and plans the graphs of every kind of frame, allocates what they use (VulkanError when over
    /// budget, before anything is allocated), records them, and uploads the initial state. `device` and `model` must
    /// outlive the loop.
    FrameLoop(const vulkan::Device& device, const SimulationModel& model, const FrameLoopOptions& options);
    FrameLoop(const vulkan::Device& device, SimulationModel&& model, const FrameLoopOptions& options) = delete;
    ~FrameLoop();

    /// Frames next_frame() .. last; `wanted(frame)` says which are handed to `finished`, in order. `stop()` is asked
    /// before each submit; true ends the loop after what is in flight. Returns whether it ran to the end.
    bool run(std::uint32_t last, const std::function<bool(std::uint32_t)>& wanted,
             const std::function<void(const FinishedFrame&)>& finished, const std::function<bool()>& stop = {});

    /// 0 in the beginning.
    std::uint32_t next_frame() const { return next_frame_; }
    /// Three particles per triangle that no cut has split so far.
    std::vector<std::uint32_t> whole_triangles(std::size_t cloth) const;

    const graph::Graph& graph(FrameKind kind) const { return frames_[static_cast<std::size_t>(kind)].graph; }
    const graph::Plan& plan(FrameKind kind) const { return frames_[static_cast<std::size_t>(kind)].plan; }
    const graph::ResourcePool& pool() const { return *pool_; }

  private:
    struct Frame {
        graph::Graph graph;
        graph::Plan plan;
        std::unique_ptr<graph::RecordedPlan> recorded;
    };
    struct InFlight {
        std::uint32_t frame = 0;
        FrameKind kind = FrameKind::initial;
        bool output = false;
    };

    std::size_t kind_count() const { return model_.scene.cutters.empty() ? plain_frame_kind_count : frame_kind_count; }
    bool cutters_active_in(std::uint32_t frame) const;
    void build_graphs();
    void allocate_and_record();
    void record();
    void take_cuts(std::uint32_t slot, std::uint32_t frame);
    bool outgrown(const CutImages& before, const CutTopology& topology) const;
    void rebuild_resources();
    void build(FrameKind kind);
    void submit(std::uint32_t slot, std::uint32_t frame, FrameKind kind, bool output);
    void deliver(std::uint32_t slot, const std::function<void(const FinishedFrame&)>& finished);

    const vulkan::Device& device_;
    const SimulationModel& model_;
    FrameLoopOptions options_;
    ClothSolver solver_;
    std::unique_ptr<RasterPass> raster_;
    bool draws_cut_ = false;  ///< raster_ was made for cut cloths
    std::array<Frame, frame_kind_count> frames_;
    std::unique_ptr<graph::ResourcePool> pool_;
    vulkan::FrameSlots slots_;
    std::array<std::optional<InFlight>, vulkan::frame_slot_count> in_flight_;
    std::uint32_t next_frame_ = 0, next_slot_ = 0;
};

}  // namespace drape
