// Colour maps: equal steps of a value look like equal steps of colour.
#pragma once

#include <array>
#include <cstdint>

namespace drape {

/// sRGB, 0xRRGGBB, at even places from 0 to 1; between them linear in sRGB.
struct ColorMap {
    std::array<std::uint32_t, 33> colors;
};

/// From dark to bright. Smith and van der Walt, "A Better Default Colormap for Matplotlib", SciPy 2015: even steps of
/// CAM02-UCS, in grey and to the colour-blind too. Their table (CC0), every eighth colour.
extern const ColorMap viridis;
/// Blue, grey in the middle, red. Moreland, "Diverging Color Maps for Scientific Visualization", ISVC 2009: even steps
/// of CIELAB distance along each half. His table, every eighth colour.
extern const ColorMap cool_warm;

/// sRGB, 0 to 255, at a place; beyond the ends theirs.
std::array<double, 3> color_at(const ColorMap& map, double place);

}  // namespace drape
