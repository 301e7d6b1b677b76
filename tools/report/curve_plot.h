// Curves over time on linear axes, as SVG text.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace drape::report {

struct Curve {
    std::string name;                           ///< in the legend
    std::vector<std::array<double, 2>> points;  ///< joined in this order; what is not finite is left out
    std::size_t colour = 0;                     ///< of 8
    bool dashed = false;                        ///< and in the legend's second row
};

struct CurvePlot {
    std::string title, x_label, y_label;  ///< labels with units
    std::vector<Curve> curves;
    double x_last = 0;  ///< the axis reaches there at least, so that plots beside each other agree
};

/// A picture of 560 x 300 units, zero in it; every curve has a group of its own with its name as title.
std::string svg_text(const CurvePlot& plot);

}  // namespace drape::report
