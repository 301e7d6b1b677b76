// Which colour of a picture means which strain.
#pragma once

#include <optional>
#include <string_view>

#include "drape/scene.h"
#include "drape/view.h"
#include "picture/color_map.h"

namespace drape {

struct StrainScale {
    std::string_view title;
    const ColorMap* map;
    double low, high;  ///< strains at the map's ends; beyond them the end's colour is shown
};

/// Returns the strain at the end of the colour map where nobody asked for one: what 20 times the weight of a cloth
/// would cause if it hung from one edge (in the shipped scenes the most stretched springs see 20 to 60 times, since
/// pins and folds gather forces), or the wind's push on all of it; the largest of the cloths, rounded up to 1, 2 or 5
/// times a power of ten, from 0.1 % to 50 %. The scene alone decides it, so that colours mean the same in all frames.
double default_strain_range(const SceneDescription& scene);

/// Returns nothing if the view shows no strain. The scale of `stretch` begins at 0; the others extend to both sides of
/// 0.
std::optional<StrainScale> strain_scale(const PictureView& view, const SceneDescription& scene);

}  // namespace drape
