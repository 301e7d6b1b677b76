#pragma once

#include <memory>
#include <vector>

#include "picture/picture_options.h"
#include "picture/raster.h"
#include "solver/cloth_solver.h"

namespace drape {

std::vector<RasterCloth> raster_cloths(const SimulationModel& model, const std::vector<ClothState>& states);

class ClothRaster {
  public:
    /// Remakes the pass when a cloth is cut, or gets spring shares, for the first time. Recordings with the old pass
    /// must not run any more.
    void fit(const vulkan::Device& device, const SceneDescription& scene, const PictureOptions& options,
             const std::vector<CutTopology>& topologies);
    explicit operator bool() const { return pass_ != nullptr; }
    RasterPass* operator->() const { return pass_.get(); }

  private:
    std::unique_ptr<RasterPass> pass_;
    bool cut_ = false, masked_ = false;  ///< what the pass was made for
};

}  // namespace drape
