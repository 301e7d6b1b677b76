#include "picture/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace drape {

namespace {

constexpr std::uint32_t glyph_width = 5, glyph_height = 7, advance = 6;

/// A glyph has five by seven pixels, rows from the top, the leftmost pixel in bit 4.
struct Glyph {
    char letter;
    std::array<std::uint8_t, glyph_height> rows;
};

/// The characters of percentages and titles.
constexpr Glyph glyphs[] = {
    {'0', {0x0e, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0e}}, {'1', {0x04, 0x0c, 0x04, 0x04, 0x04, 0x04, 0x0e}},
    {'2', {0x0e, 0x11, 0x01, 0x02, 0x04, 0x08, 0x1f}}, {'3', {0x1f, 0x02, 0x04, 0x02, 0x01, 0x11, 0x0e}},
    {'4', {0x02, 0x06, 0x0a, 0x12, 0x1f, 0x02, 0x02}}, {'5', {0x1f, 0x10, 0x1e, 0x01, 0x01, 0x11, 0x0e}},
    {'6', {0x06, 0x08, 0x10, 0x1e, 0x11, 0x11, 0x0e}}, {'7', {0x1f, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08}},
    {'8', {0x0e, 0x11, 0x11, 0x0e, 0x11, 0x11, 0x0e}}, {'9', {0x0e, 0x11, 0x11, 0x0f, 0x01, 0x02, 0x0c}},
    {'.', {0x00, 0x00, 0x00, 0x00, 0x00, 0x0c, 0x0c}}, {'-', {0x00, 0x00, 0x00, 0x1f, 0x00, 0x00, 0x00}},
    {'%', {0x18, 0x19, 0x02, 0x04, 0x08, 0x13, 0x03}}, {'a', {0x00, 0x00, 0x0e, 0x01, 0x0f, 0x11, 0x0f}},
    {'c', {0x00, 0x00, 0x0e, 0x10, 0x10, 0x11, 0x0e}}, {'e', {0x00, 0x00, 0x0e, 0x11, 0x1f, 0x10, 0x0e}},
    {'f', {0x06, 0x09, 0x08, 0x1c, 0x08, 0x08, 0x08}}, {'h', {0x10, 0x10, 0x16, 0x19, 0x11, 0x11, 0x11}},
    {'i', {0x04, 0x00, 0x0c, 0x04, 0x04, 0x04, 0x0e}}, {'n', {0x00, 0x00, 0x16, 0x19, 0x11, 0x11, 0x11}},
    {'p', {0x00, 0x00, 0x1e, 0x11, 0x1e, 0x10, 0x10}}, {'r', {0x00, 0x00, 0x16, 0x19, 0x10, 0x10, 0x10}},
    {'s', {0x00, 0x00, 0x0e, 0x10, 0x0e, 0x01, 0x1e}}, {'t', {0x08, 0x08, 0x1c, 0x08, 0x08, 0x09, 0x06}},
    {'w', {0x00, 0x00, 0x11, 0x11, 0x15, 0x15, 0x0a}}};

using Color = std::array<double, 3>;
constexpr Color ink{245, 245, 245}, paper{24, 24, 28};
constexpr double paper_share = 0.72;  ///< share of the panel; the rest is the picture behind it

/// Returns the pixels of the picture per pixel of a letter.
std::uint32_t letter_scale(std::uint32_t height) { return std::max(1u, (height + 180) / 360); }

struct Canvas {
    std::span<std::uint8_t> rgba;
    std::uint32_t width, height;

    void paint(std::uint32_t x, std::uint32_t y, const Color& color, double share) {
        if (x >= width || y >= height) return;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            std::uint8_t& level = rgba[4 * (std::size_t{y} * width + x) + channel];
            level = static_cast<std::uint8_t>(std::lround(share * color[channel] + (1 - share) * level));
        }
        rgba[4 * (std::size_t{y} * width + x) + 3] = 255;
    }
    void fill(std::uint32_t x, std::uint32_t y, std::uint32_t columns, std::uint32_t rows, const Color& color,
              double share = 1) {
        for (std::uint32_t row = 0; row < rows; ++row)
            for (std::uint32_t column = 0; column < columns; ++column) paint(x + column, y + row, color, share);
    }
    void write(std::uint32_t x, std::uint32_t y, std::string_view text, std::uint32_t scale) {
        for (const char letter : text) {
            const auto* glyph = std::ranges::find(glyphs, letter, &Glyph::letter);
            if (glyph != std::end(glyphs))
                for (std::uint32_t row = 0; row < glyph_height; ++row)
                    for (std::uint32_t column = 0; column < glyph_width; ++column)
                        if (glyph->rows[row] >> (glyph_width - 1 - column) & 1u)
                            fill(x + column * scale, y + row * scale, scale, scale, ink);
            x += advance * scale;
        }
    }
};

}  // namespace

LegendBar legend_bar(std::uint32_t width, std::uint32_t height) {
    const std::uint32_t scale = letter_scale(std::min(width, height));
    return {10 * scale, 22 * scale, 8 * scale, std::max(48 * scale, height * 2 / 5)};
}

std::string percent_text(double strain) { return fmt::format("{:.6g}%", 100 * strain); }

void draw_legend(std::span<std::uint8_t> rgba, std::uint32_t width, std::uint32_t height, const StrainScale& scale) {
    if (width < legend_least_width || height < legend_least_height) return;
    Canvas canvas{rgba, width, height};
    const std::uint32_t unit = letter_scale(std::min(width, height));
    const LegendBar bar = legend_bar(width, height);
    std::vector<double> strains{scale.high, 0.5 * (scale.low + scale.high), scale.low};
    if (scale.knee > 0 && scale.low == 0) strains = {scale.high, 0.1 * scale.high, 0.01 * scale.high, 0};
    std::vector<std::string> labels;
    for (const double strain : strains) labels.push_back(percent_text(strain));
    std::size_t letters = scale.title.size();  // of the widest line, counted from the bar
    for (const std::string& label : labels) letters = std::max(letters, label.size() + 2);
    const auto columns = static_cast<std::uint32_t>(letters) * advance * unit;
    canvas.fill(4 * unit, 4 * unit, columns + 13 * unit, bar.y + bar.height + 4 * unit, paper, paper_share);
    canvas.write(bar.x, 9 * unit, scale.title, unit);
    for (std::uint32_t row = 0; row < bar.height; ++row)
        canvas.fill(bar.x, bar.y + row, bar.width, 1,
                    color_at(*scale.map, 1 - static_cast<double>(row) / (bar.height - 1)));
    for (std::uint32_t i = 0; i < labels.size(); ++i) {
        const double down = (1 - scale.place_of(strains[i])) * (bar.height - 1);
        const std::uint32_t at = bar.y + static_cast<std::uint32_t>(down + 1e-6);
        canvas.fill(bar.x + bar.width, at - unit / 2, 2 * unit, unit, ink);
        canvas.write(bar.x + bar.width + 5 * unit, at - glyph_height * unit / 2, labels[i], unit);
    }
}

}  // namespace drape
