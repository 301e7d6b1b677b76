// Pictures that a device of their own draws while another simulates the next frames (Device::for_scene). It is given
// positions alone: the normals, and what cuts left to draw, it makes as the simulating device would.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "frame_copy.h"
#include "frame_loop.h"

namespace drape {

/// A frame whose picture is being drawn.
struct PendingPicture {
    FrameCopy frame;
    bool has_picture = false;  ///< the copy has it
};

class Pictures {
  public:
    using Finished = std::function<void(const FinishedFrame&)>;

    /// Of `options`, what is said of pictures. `device` and `model` must outlive it.
    Pictures(const vulkan::Device& device, const SimulationModel& model, const FrameLoopOptions& options);

    /// Takes a frame that has positions. A later `draw` or `flush` gives it to `finished` with its picture, in order,
    /// and with positions only where the options want them.
    void draw(const FinishedFrame& frame, const Finished& finished);
    /// Gives those that are not given yet.
    void flush(const Finished& finished);
    /// The next frames are of cloth that was cut like this.
    void follow(const std::vector<CutTopology>& topologies);

    const graph::Graph& graph() const { return graph_; }
    const graph::Plan& plan() const { return plan_; }

  private:
    void build();
    void allocate();
    void record();
    /// The slot's frame, drawn; the picture lies in the slot's buffer.
    FinishedFrame drawn(std::uint32_t slot);
    void deliver(std::uint32_t slot, const Finished& finished);

    const vulkan::Device& device_;
    const SimulationModel& model_;
    FrameLoopOptions options_;
    ClothSolver solver_;
    ClothRaster raster_;
    graph::Graph graph_;
    graph::Plan plan_;
    std::unique_ptr<graph::ResourcePool> pool_;
    std::unique_ptr<graph::RecordedPlan> recorded_;
    vulkan::FrameSlots slots_;  ///< goes, and waits for what is in flight, before what that uses
    std::array<std::optional<PendingPicture>, vulkan::frame_slot_count> pending_;
    std::uint32_t next_slot_ = 0;
};

}  // namespace drape
