// Curves on linear or logarithmic axes, as SVG text.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace drape::plot {

struct Curve {
    std::string name;                             ///< in the legend, and the title of the curve's group
    std::vector<std::array<double, 2>> points{};  ///< joined in this order; those that no axis can show are left out
    std::vector<bool> doubtful{};                 ///< by point: drawn hollow; empty: none
    std::optional<std::size_t> look{};            ///< colour and marker, of 8; default: the curve's place
    bool dashed = false;
    bool joined = true;  ///< false: marks alone
};

/// A dashed horizontal line at a value worth comparing with.
struct Level {
    std::string name;
    double value;
};

struct Plot {
    std::string title, x_label, y_label;  ///< labels with units
    std::vector<Curve> curves{};
    std::vector<double> slopes{};  ///< of reference lines y ~ x^slope; logarithmic axes only
    std::vector<Level> levels{};
    bool logarithmic = true;  ///< both axes
    bool from_zero = true;    ///< linear axes begin there
    double x_last = 0;        ///< linear: where the axis ends at least, so that plots beside each other agree
};

/// Plots by their file names.
using Plots = std::vector<std::pair<std::string, Plot>>;

/// A picture 640 units wide on white, its text readable by programs. Every curve has a group of its own with its name
/// as title, even without a point.
std::string svg_of(const Plot& plot);
std::map<std::string, std::string> svg_of(const Plots& plots);

/// The parts of other drawings: the opening tag, title and white ground of a picture; a line of text.
std::string svg_begin(double width, double height, const std::string& title, int font_size);
std::string svg_text(double x, double y, const std::string& content, const char* style = "");

}  // namespace drape::plot
