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
    double knee = 0;   ///< the scale is logarithmic above this strain, of either sign; 0: linear

    /// Returns the place on the map, 0 at its low end and 1 at its high one; beyond them it is not.
    double place_of(double strain) const;
};

/// The logarithmic scale reaches so many times its knee.
inline constexpr double knees_to_end = 1000;

/// Returns the strain at the end of the colour map where nobody asked for one: what 100 times the weight of a cloth
/// would cause if it hung from one edge (in the shipped scenes the most stretched springs see 20 to 60 times, since
/// pins and folds gather forces), or five times the wind's push on all of it; the largest of the cloths, rounded up to
/// 1, 2 or 5 times a power of ten, from 0.5 % to 100 %. The scene alone decides it, so that colours mean the same in
/// all frames.
double default_strain_range(const SceneDescription& scene);

/// Returns nothing if the view shows no strain. The scale of `stretch` begins at 0; the others extend to both sides of
/// 0. A range that was asked for is linear; the default one is logarithmic, so that neither the small strains of most
/// of a cloth nor the large ones at its pins are all of one colour.
std::optional<StrainScale> strain_scale(const PictureView& view, const SceneDescription& scene);

}  // namespace drape
