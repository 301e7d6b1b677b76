// Reads maps: numbers from 0 to 1 over a cloth.
#pragma once

#include <cstdint>
#include <filesystem>

#include "input/png_picture.h"

namespace drape::input {

/// Returns a map as it stands in a grey PNG (`decode_grey_png`) or in an array .npy [rows, columns]: uint8 or uint16,
/// over their largest value, bool, or float32 or float64 from 0 to 1. Throws OutputError naming the file.
GreyPicture read_map(const std::filesystem::path& path);

/// Returns its value at a place from 0 to 1 along its width and height, between the middles of its pixels by bilinear
/// interpolation. On the middle of a pixel it is that pixel's.
double sampled(const GreyPicture& map, double across, double down);

}  // namespace drape::input
