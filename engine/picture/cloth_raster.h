#pragma once

#include <memory>
#include <span>
#include <vector>

#include "picture/layers.h"
#include "picture/picture_options.h"
#include "picture/raster.h"
#include "solver/cloth_solver.h"

namespace drape {

std::vector<RasterCloth> raster_cloths(const SimulationModel& model, const std::vector<ClothState>& states);

/// Makes the pictures of cloth that may be cut, their layers, or both.
class ClothRaster {
  public:
    /// Remakes the passes when a cloth is cut, or gets spring shares, for the first time. Recordings with the old ones
    /// must not run any more.
    void fit(const vulkan::Device& device, const SceneDescription& scene, const PictureOptions& options,
             const std::vector<CutTopology>& topologies);
    explicit operator bool() const { return picture_ || layers_; }

    /// These do as the functions of RasterPass and LayerPass.
    void add(graph::Graph& graph, std::span<const RasterCloth> cloths) const;
    void upload(const graph::ResourcePool& pool) const;
    void write_frame(const graph::ResourcePool& pool, std::uint32_t slot, double time,
                     std::span<const BodyState> moved = {}) const;
    /// Has the frame show what a slot has drawn, which stays until the slot is submitted again.
    void read(const graph::ResourcePool& pool, std::uint32_t slot, FinishedFrame& frame) const;

  private:
    std::unique_ptr<RasterPass> picture_;
    std::unique_ptr<LayerPass> layers_;
    bool cut_ = false, masked_ = false;  ///< what the passes were made for
};

}  // namespace drape
