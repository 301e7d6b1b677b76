#include "report/curve_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/xml_text.h"
#include "plot_colours.h"

namespace drape::report {

namespace {

constexpr double plot_width = 560, plot_height = 300, left = 70, right = 545, top = 62, bottom = 255;
/// Values from `first` to `last`, a whole number of steps, along pixels.
struct Axis {
    double first, last, step, begin, end;
    double place(double value) const { return begin + (value - first) / (last - first) * (end - begin); }
};

/// Steps of 1, 2 or 5 times a power of ten, about five of them.
Axis axis(double low, double high, double begin, double end) {
    if (!(high > low)) high = low + 1;
    const double rough = (high - low) / 5, power = std::pow(10, std::floor(std::log10(rough)));
    const double share = rough / power, step = power * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
    return {std::floor(low / step + 1e-9) * step, std::ceil(high / step - 1e-9) * step, step, begin, end};
}

bool drawable(const std::array<double, 2>& point) { return std::isfinite(point[0]) && std::isfinite(point[1]); }

std::string text(double x, double y, const std::string& content, const char* style) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, style, xml_text(content));
}

std::string grid(const Axis& x, const Axis& y) {
    std::string svg;
    for (int k = 0; x.first + k * x.step < x.last + x.step / 2; ++k) {
        const double value = x.first + k * x.step, at = x.place(value);
        svg += fmt::format("<path d=\"M{0:.1f} {1}V{2}\" stroke=\"#e4e4e4\"/>\n", at, top, bottom);
        svg += text(at, bottom + 16, fmt::format("{:.4g}", std::abs(value) < x.step / 2 ? 0 : value),
                    "text-anchor=\"middle\"");
    }
    for (int k = 0; y.first + k * y.step < y.last + y.step / 2; ++k) {
        const double value = y.first + k * y.step, at = y.place(value);
        svg += fmt::format("<path d=\"M{1} {0:.1f}H{2}\" stroke=\"#e4e4e4\"/>\n", at, left, right);
        svg += text(left - 6, at + 4, fmt::format("{:.4g}", std::abs(value) < y.step / 2 ? 0 : value),
                    "text-anchor=\"end\"");
    }
    return svg;
}

/// The curve and its place in the legend.
std::string curve_group(const Curve& curve, const Axis& x, const Axis& y, double legend) {
    const char* colour = plot_colours[curve.colour % plot_colours.size()];
    std::string path;
    std::size_t count = 0;
    for (const std::array<double, 2>& point : curve.points)
        if (drawable(point))
            path += fmt::format("{}{:.1f} {:.1f}", count++ == 0 ? "M" : "L", x.place(point[0]), y.place(point[1]));
    if (count == 1) path += "h0.1";  // a dot, by its round ends
    const char* dash = curve.dashed ? " stroke-dasharray=\"5 3\"" : "";
    const double row = curve.dashed ? 48 : 34;
    std::string svg = fmt::format("<g><title>{}</title>\n", xml_text(curve.name));
    if (!path.empty())
        svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n", path, colour,
                           count == 1 ? "5\" stroke-linecap=\"round" : "1.6", dash);
    svg += fmt::format("<path d=\"M{:.1f} {}h18\" stroke=\"{}\" stroke-width=\"2\"{}/>\n", legend, row, colour, dash);
    return svg + text(legend + 22, row + 4, curve.name, "") + "</g>\n";
}

}  // namespace

std::string svg_text(const CurvePlot& plot) {
    std::array<double, 2> low{}, high{plot.x_last, 0};
    for (const Curve& curve : plot.curves)
        for (const std::array<double, 2>& point : curve.points)
            for (std::size_t k = 0; k < 2 && drawable(point); ++k) {
                low[k] = std::min(low[k], point[k]);
                high[k] = std::max(high[k], point[k]);
            }
    const Axis x = axis(low[0], high[0], left, right), y = axis(low[1], high[1], bottom, top);
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" role=\"img\" font-family=\"sans-serif\" "
        "font-size=\"11\">\n<title>{2}</title>\n",
        plot_width, plot_height, xml_text(plot.title));
    svg += text(left, 18, plot.title, "font-size=\"14\" font-weight=\"bold\"") + grid(x, y);
    svg += text((left + right) / 2, plot_height - 10, plot.x_label, "text-anchor=\"middle\"");
    svg += fmt::format("<text transform=\"translate(14 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                       (top + bottom) / 2, xml_text(plot.y_label));
    std::array<double, 2> legend{left, left};
    for (const Curve& curve : plot.curves) {
        double& place = legend[curve.dashed ? 1 : 0];
        svg += curve_group(curve, x, y, place);
        place += 36 + 6.2 * static_cast<double>(curve.name.size());
    }
    return svg + "</svg>\n";
}

}  // namespace drape::report
