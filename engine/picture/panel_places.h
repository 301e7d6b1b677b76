// Where the particles of cloths with an outline lie on their flat panels, for patterns, threads and textures.
#pragma once

#include <span>
#include <vector>

#include "drape/scene.h"
#include "drape/view.h"
#include "shared/raster_types.h"

namespace drape {

class PanelPlaces {
  public:
    /// Empty where pictures of this view show no cloth by its places.
    PanelPlaces(View view, const std::vector<Cloth>& cloths);

    /// Returns metres along columns and rows, by particle, of one cloth after the other.
    std::span<const glsl::vec2> all() const { return places_; }
    bool empty() const { return places_.empty(); }
    /// Returns where those of a cloth begin; -1: it lies on its grid (ClothPush::fabric).
    float first(std::size_t cloth) const { return first_[cloth]; }

  private:
    std::vector<float> first_;
    std::vector<glsl::vec2> places_;
};

}  // namespace drape
