// Draws pictures on a device of its own while another one simulates the next frames (Device::for_scene). It receives
// positions alone, for motion blur velocities too, and computes normals and the cut triangles to draw as the simulating
// device would.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "picture/cloth_raster.h"
#include "picture/frame_copy.h"
#include "picture/motion_blur.h"
#include "picture/picture_options.h"

namespace drape {

/// A frame whose picture waits to be drawn, is being drawn, or is done.
struct PendingPicture {
    FrameCopy frame;
    std::optional<std::uint32_t> slot;  ///< the slot that draws it
    bool has_picture = false;           ///< the copy contains the picture
};

class Pictures {
  public:
    using Finished = std::function<void(const FinishedFrame&)>;

    /// `device` and `model` must outlive it.
    Pictures(const vulkan::Device& device, const SimulationModel& model, const PictureOptions& options);

    /// Takes a frame with positions. A later call of one of these three functions passes it to `finished` with its
    /// picture, in order, and with positions only if the options ask for them. Waits for a picture only if more frames
    /// wait than are allowed: the frames of a probe come all at once, and are drawn while the next ones are simulated.
    void draw(const FinishedFrame& frame, const Finished& finished);
    /// Passes on frames whose pictures are done, and begins to draw others. Does not wait.
    void go_on(const Finished& finished);
    /// Passes on all remaining frames.
    void flush(const Finished& finished);
    /// The next frames belong to cloth with these cuts.
    void follow(const std::vector<CutTopology>& topologies);

    const graph::Graph& graph() const { return graph_; }
    const graph::Plan& plan() const { return plan_; }

  private:
    void build();
    void allocate();
    void record();
    std::optional<std::uint32_t> free_slot() const;
    /// Begins to draw as many waiting frames as there are free slots.
    void begin_waiting();
    void begin(PendingPicture& picture, std::uint32_t slot);
    /// Begins to draw a frame as it is, or as it was at a moment while the shutter was open: 0 is the frame's own.
    void submit(const FinishedFrame& frame, std::uint32_t slot, std::uint32_t moment);
    /// Has the frame show the mean of all moments, of which the slot has drawn the first.
    void blur(FinishedFrame& frame, std::uint32_t slot);
    void add_timings(FinishedFrame& frame, std::uint32_t slot) const;
    /// Returns the frame that a slot has drawn; the picture is in the slot's buffer.
    FinishedFrame drawn(const PendingPicture& picture);
    bool is_there(const PendingPicture& picture) const;
    /// Passes on the first of the waiting frames.
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
    vulkan::FrameSlots slots_;  ///< destroyed first: it waits for submits that use what is above
    std::size_t most_pending_;
    PictureMean mean_;
    std::deque<PendingPicture> pending_;  ///< in order
};

}  // namespace drape
