// Colour maps, in which equal steps of a value look like equal steps of colour.
#pragma once

#include <array>
#include <cstdint>

namespace drape {

/// Colours are sRGB, 0xRRGGBB, at even places from 0 to 1; between them they are linear in sRGB.
struct ColorMap {
    std::array<std::uint32_t, 33> colors;
};

/// It goes from dark to bright by even steps of CAM02-UCS, in grey and to the colour-blind too: every eighth colour of
/// the table (CC0) of Smith and van der Walt, "A Better Default Colormap for Matplotlib", SciPy 2015.
extern const ColorMap viridis;
/// It goes from blue over grey to red by even steps of CIELAB distance along each half: every eighth colour of the
/// table of Moreland, "Diverging Color Maps for Scientific Visualization", ISVC 2009.
extern const ColorMap cool_warm;

/// Returns sRGB, 0 to 255, at a place; beyond an end, the colour of that end.
std::array<double, 3> color_at(const ColorMap& map, double place);

}  // namespace drape
