#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "picture/strain_scale.h"

namespace drape {

/// Pictures smaller than this, in pixels, get no legend.
inline constexpr std::uint32_t legend_least_width = 160, legend_least_height = 120;

/// The place of the colour bar in a picture, in pixels; its top row shows the high end of the scale, its bottom row the
/// low one.
struct LegendBar {
    std::uint32_t x, y, width, height;
};
LegendBar legend_bar(std::uint32_t width, std::uint32_t height);

/// Returns a strain as percent, with as many digits as it takes: "2.5%".
std::string percent_text(double strain);

/// Draws the scale at the left of `rgba` (rows from the top, 8-bit sRGB, four bytes a pixel): a bar with its title and
/// the strains at its ends and in the middle, in letters that grow with the picture. Smaller pictures than the least
/// stay as they are.
void draw_legend(std::span<std::uint8_t> rgba, std::uint32_t width, std::uint32_t height, const StrainScale& scale);

}  // namespace drape
