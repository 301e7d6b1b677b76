// Line plots on doubly logarithmic axes, as SVG text.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace drape::bench {

struct PlotSeries {
    std::string name;  ///< in the legend
    /// Joined in this order; one that is not positive and finite is left out.
    std::vector<std::array<double, 2>> points;
    std::vector<bool> doubtful{};  ///< by point: drawn hollow; empty: none
};

/// A dashed horizontal line at a value worth comparing with.
struct PlotLevel {
    std::string name;
    double value;
};

struct LogPlot {
    std::string title, x_label, y_label;  ///< labels with units
    std::vector<PlotSeries> series;       ///< at most 8 are told apart by colour, and all those by their markers too
    std::vector<double> slopes;           ///< of reference lines: y ~ x^slope
    std::vector<PlotLevel> levels;
};

/// A picture of 760 x 520 units on white, its text readable by programs. Every series has a group of its own
/// with its name as title, even without a point.
std::string svg_text(const LogPlot& plot);

}  // namespace drape::bench
