// Files of shapes and maps, as people bring them to scenes.
#pragma once

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "../output/temporary_folder.h"
#include "output/npy.h"
#include "output/png.h"

namespace drape::testing {

/// Returns an NPY file of these values.
template <class T>
std::string npy_of(const char* type, const std::string& shape, const std::vector<T>& values) {
    return npy_array(type, shape, std::as_bytes(std::span(values)));
}

/// Returns an 8-bit PNG, grey, of so many pixels a row; its encoder writes colours that are all grey.
inline std::string grey_png(std::uint32_t width, const std::vector<std::uint8_t>& pixels) {
    std::vector<std::uint8_t> rgba, png;
    for (const std::uint8_t pixel : pixels) rgba.insert(rgba.end(), {pixel, pixel, pixel, 255});
    encode_png(width, static_cast<std::uint32_t>(pixels.size()) / width, rgba, png);
    return {png.begin(), png.end()};
}

/// Returns places x y z of a sheet of columns x rows particles `spacing` apart, wavy and nowhere flat, m.
inline std::vector<float> wavy_sheet(std::uint32_t columns, std::uint32_t rows, double spacing, double height = 1) {
    std::vector<float> values;
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column)
            for (const double x : {spacing * column, height + 0.4 * spacing * ((column + row) % 3), spacing * row})
                values.push_back(static_cast<float>(x));
    return values;
}

}  // namespace drape::testing
