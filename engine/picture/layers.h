// Draws the layers of a frame: what is seen at the centre of each pixel, as numbers (LayerPixel).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "drape/frame.h"
#include "drape/scene.h"
#include "graph/executor.h"
#include "picture/cloth_look.h"
#include "picture/drawn_bodies.h"
#include "picture/raster_cloth.h"
#include "picture/raster_frame.h"
#include "vulkan/pipeline.h"

namespace drape {

class LayerPass {
  public:
    /// `cut`, `masked`: whether some cloth has cut vertices, spring shares.
    LayerPass(const vulkan::Device& device, const SceneDescription& scene, std::uint32_t width, std::uint32_t height,
              bool cut, bool masked);
    LayerPass(const LayerPass&) = delete;
    LayerPass& operator=(const LayerPass&) = delete;

    /// Declares the host inputs, the attachments and the passes of the stage "layers". The graph's plans may run as
    /// long as this object lives.
    void add(graph::Graph& graph, std::span<const RasterCloth> cloths) const;
    /// Fills the data that is the same in all frames; call it once for each pool.
    void upload(const graph::ResourcePool& pool) const;
    /// Fills the host inputs of a slot for the layers at `time` (s). `moved`: where bodies that cloth moves are.
    void write_frame(const graph::ResourcePool& pool, std::uint32_t slot, double time,
                     std::span<const BodyState> moved = {}) const;
    /// Returns what a slot has drawn: rows from the top, tightly packed, until the slot is submitted again.
    std::span<const LayerPixel> pixels(const graph::ResourcePool& pool, std::uint32_t slot) const;

  private:
    struct Draw {
        ColliderDraw range;
        std::unique_ptr<vulkan::GraphicsPipeline> pipeline;
    };
    struct Targets {
        graph::Handle frame, colliders, meshes;  ///< the last two are invalid where there are none
        graph::Handle pixels, depth;
    };

    void make_cloth_pipelines(const vulkan::Device& device, bool cut, bool masked);
    void make_body_pipelines(const vulkan::Device& device, const SceneDescription& scene);
    Targets declare(graph::Graph& graph) const;
    void draw(graph::PassContext& context, const Targets& targets, const std::vector<RasterCloth>& cloths) const;

    std::uint32_t width_, height_;
    FrameView frame_view_;
    DrawnBodies bodies_;
    std::vector<std::uint16_t> ids_;  ///< of the bodies
    ClothPipelines cloth_pipelines_;
    std::vector<Draw> draws_;
};

}  // namespace drape
