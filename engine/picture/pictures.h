// A device of its own draws pictures while another simulates the next frames (Device::for_scene). It is given positions
// alone: it makes the normals, and what cuts left to draw, as the simulating device would.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "picture/cloth_raster.h"
#include "picture/frame_copy.h"
#include "picture/picture_options.h"

namespace drape {

/// A frame whose picture waits to be drawn, is being drawn, or is there.
struct PendingPicture {
    FrameCopy frame;
    std::optional<std::uint32_t> slot;  ///< the slot that draws it
    bool has_picture = false;           ///< the copy has it
};

class Pictures {
  public:
    using Finished = std::function<void(const FinishedFrame&)>;

    /// `device` and `model` must outlive it.
    Pictures(const vulkan::Device& device, const SimulationModel& model, const PictureOptions& options);

    /// Takes a frame that has positions. It is given to `finished` with its picture, in order, by a later call of any
    /// of these three, and with positions only where the options want them. Waits for a picture only where more frames
    /// wait than may: those of a probe come all at once, and are to be drawn while the next ones are simulated.
    void draw(const FinishedFrame& frame, const Finished& finished);
    /// Gives frames whose pictures are there and begins to draw others. Waits for none.
    void go_on(const Finished& finished);
    /// Gives all frames that are not given yet.
    void flush(const Finished& finished);
    /// The next frames are of cloth that was cut like this.
    void follow(const std::vector<CutTopology>& topologies);

    const graph::Graph& graph() const { return graph_; }
    const graph::Plan& plan() const { return plan_; }

  private:
    void build();
    void allocate();
    void record();
    std::optional<std::uint32_t> free_slot() const;
    /// Begins as many of those that wait as there are slots.
    void begin_waiting();
    void begin(PendingPicture& picture, std::uint32_t slot);
    /// Returns the frame of a slot, drawn; the picture lies in the slot's buffer.
    FinishedFrame drawn(const PendingPicture& picture);
    bool is_there(const PendingPicture& picture) const;
    /// Gives the first of the frames that wait.
    void deliver(const Finished& finished);

    const vulkan::Device& device_;
    const SimulationModel& model_;
    PictureOptions options_;
    ClothSolver solver_;
    ClothRaster raster_;
    graph::Graph graph_;
    graph::Plan plan_;
    std::unique_ptr<graph::ResourcePool> pool_;
    std::unique_ptr<graph::RecordedPlan> recorded_;
    vulkan::FrameSlots slots_;  ///< goes, and waits for work in flight, before what that uses
    std::size_t most_pending_;
    std::deque<PendingPicture> pending_;  ///< in order
};

}  // namespace drape
