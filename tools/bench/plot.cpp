#include "bench/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/xml_text.h"
#include "plot_colours.h"

namespace drape::bench {

namespace {

constexpr double width = 760, height = 520, left = 78, right = 540, top = 44, bottom = 462;
bool drawable(const std::array<double, 2>& point) {
    return std::isfinite(point[0]) && std::isfinite(point[1]) && point[0] > 0 && point[1] > 0;
}

/// One logarithmic axis: decades from `first` to `last` along pixels `begin` to `end`.
struct Axis {
    double first, last, begin, end;
    double place(double value) const { return begin + (std::log10(value) - first) / (last - first) * (end - begin); }
};

/// The axis holds every value; on less than a decade and a half its ends are tenths of a decade.
Axis axis(double least, double most, double begin, double end) {
    const double span = std::log10(most / least), unit = span < 1.5 ? 0.1 : 1.0;
    Axis result{std::floor(std::log10(least) / unit + 1e-9) * unit, std::ceil(std::log10(most) / unit - 1e-9) * unit,
                begin, end};
    if (result.last - result.first < unit) result.last = result.first + unit;
    return result;
}

struct Axes {
    Axis x, y;
};

Axes axes_of(const LogPlot& plot) {
    double low[2] = {INFINITY, INFINITY}, high[2] = {0, 0};
    const auto include = [&](std::size_t k, double value) {
        low[k] = std::min(low[k], value);
        high[k] = std::max(high[k], value);
    };
    for (const PlotSeries& series : plot.series)
        for (const std::array<double, 2>& point : series.points)
            if (drawable(point))
                for (std::size_t k = 0; k < 2; ++k) include(k, point[k]);
    for (const PlotLevel& level : plot.levels)
        if (drawable({1, level.value})) include(1, level.value);
    for (std::size_t k = 0; k < 2; ++k)
        if (high[k] <= 0) low[k] = 0.1, high[k] = 10;
    return {axis(low[0], high[0], left, right), axis(low[1], high[1], bottom, top)};
}

std::string line(double x1, double y1, double x2, double y2, const char* style) {
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, y1, x2, y2, style);
}

std::string text(double x, double y, const std::string& content, const char* style) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, style, xml_text(content));
}

constexpr const char *major_line = "stroke=\"#c4c4c4\"", *minor_line = "stroke=\"#ebebeb\"";

std::string tick_label(double value) {
    const double power = std::log10(value);
    if (std::abs(power - std::round(power)) > 1e-6 || std::abs(power) < 3.5) return fmt::format("{:.4g}", value);
    return fmt::format("1e{:.0f}", power);
}

/// Lines at 1 to 9 times every power of ten in sight; numbers at the powers, and at 2 and 5 on short axes.
std::string grid(const Axis& axis, bool along_x) {
    std::string result;
    const bool is_short = axis.last - axis.first < 2.5;
    for (int decade = static_cast<int>(std::floor(axis.first)); decade <= axis.last + 1e-9; ++decade)
        for (int digit = 1; digit <= 9; ++digit) {
            const double value = digit * std::pow(10.0, decade), power = std::log10(value);
            if (power < axis.first - 1e-9 || power > axis.last + 1e-9) continue;
            const double at = axis.place(value);
            const char* style = digit == 1 ? major_line : minor_line;
            result += along_x ? line(at, top, at, bottom, style) : line(left, at, right, at, style);
            if (digit != 1 && !(is_short && (digit == 2 || digit == 5))) continue;
            result += along_x ? text(at, bottom + 17, tick_label(value), "text-anchor=\"middle\"")
                              : text(left - 7, at + 4, tick_label(value), "text-anchor=\"end\"");
        }
    return result;
}

/// Marker number `kind` around (x, y).
std::string marker(std::size_t kind, double x, double y) {
    const auto polygon = [&](std::initializer_list<std::array<double, 2>> corners) {
        std::string points;
        for (const auto& corner : corners) points += fmt::format("{:.1f},{:.1f} ", x + corner[0], y + corner[1]);
        return "<polygon points=\"" + points + "\"/>";
    };
    switch (kind % plot_colours.size()) {
        case 0:
            return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"/>", x, y);
        case 1:
            return polygon({{-4, -4}, {4, -4}, {4, 4}, {-4, 4}});
        case 2:
            return polygon({{0, -5}, {5, 4}, {-5, 4}});
        case 3:
            return polygon({{0, -6}, {5, 0}, {0, 6}, {-5, 0}});
        case 4:
            return polygon({{0, 5}, {5, -4}, {-5, -4}});
        case 5:
            return polygon({{-5, 0}, {-1, -1}, {0, -6}, {1, -1}, {5, 0}, {1, 1}, {0, 6}, {-1, 1}});
        case 6:
            return polygon({{-5, -2}, {5, -2}, {5, 2}, {-5, 2}});
        default:
            return polygon({{-2, -5}, {2, -5}, {2, 5}, {-2, 5}});
    }
}

std::string series_group(const PlotSeries& series, std::size_t index, const Axes& axes) {
    const char* colour = plot_colours[index % plot_colours.size()];
    std::string places, markers;
    for (std::size_t k = 0; k < series.points.size(); ++k) {
        const std::array<double, 2>& point = series.points[k];
        if (!drawable(point)) continue;
        const double x = axes.x.place(point[0]), y = axes.y.place(point[1]);
        places += fmt::format("{:.1f},{:.1f} ", x, y);
        const bool doubtful = k < series.doubtful.size() && series.doubtful[k];
        markers += doubtful ? fmt::format("<g class=\"doubtful\" fill=\"#ffffff\" stroke=\"{}\">{}</g>", colour,
                                          marker(index, x, y))
                            : marker(index, x, y);
    }
    return fmt::format(
        "<g class=\"series\" fill=\"{0}\"><title>{1}</title>\n"
        "<polyline points=\"{2}\" fill=\"none\" stroke=\"{0}\" stroke-width=\"1.8\"/>\n{3}\n</g>\n",
        colour, xml_text(series.name), places, markers);
}

/// Reference lines through a point a little inside, each labelled where it leaves the frame.
std::string slope_lines(const LogPlot& plot, const Axes& axes) {
    std::string result;
    for (const double slope : plot.slopes) {
        const double x0 = axes.x.first + 0.08 * (axes.x.last - axes.x.first);
        const double y0 = slope < 0 ? axes.y.last - 0.08 * (axes.y.last - axes.y.first)
                                    : axes.y.first + 0.08 * (axes.y.last - axes.y.first);
        const double limit = slope < 0 ? axes.y.first : axes.y.last;
        const double x1 = std::min(axes.x.last, x0 + (limit - y0) / slope);
        const double y1 = y0 + slope * (x1 - x0);
        const double px = axes.x.place(std::pow(10.0, x1)), py = axes.y.place(std::pow(10.0, y1));
        result += line(axes.x.place(std::pow(10.0, x0)), axes.y.place(std::pow(10.0, y0)), px, py,
                       "stroke=\"#606060\" stroke-width=\"1\" stroke-dasharray=\"2 4\"");
        result += text(px - 5, py + (slope < 0 ? -5 : 13), fmt::format("slope {:g}", slope),
                       "text-anchor=\"end\" fill=\"#505050\" font-size=\"11\"");
    }
    return result;
}

std::string level_lines(const LogPlot& plot, const Axes& axes) {
    std::string result;
    for (const PlotLevel& level : plot.levels) {
        if (!drawable({1, level.value})) continue;
        const double y = axes.y.place(level.value);
        result += line(left, y, right, y, "stroke=\"#303030\" stroke-dasharray=\"7 4\"");
        result += text(left + 6, y - 4, level.name, "fill=\"#303030\" font-size=\"11\"");
    }
    return result;
}

std::string legend(const LogPlot& plot) {
    std::string result;
    for (std::size_t k = 0; k < plot.series.size(); ++k) {
        const double y = top + 12 + 22 * static_cast<double>(k);
        result += fmt::format(
            "<g fill=\"{0}\"><line x1=\"{1}\" y1=\"{2}\" x2=\"{3}\" y2=\"{2}\" stroke=\"{0}\" "
            "stroke-width=\"1.8\"/>{4}</g>\n",
            plot_colours[k % plot_colours.size()], right + 14, y, right + 42, marker(k, right + 28, y));
        result += text(right + 48, y + 4, plot.series[k].name, "fill=\"#202020\"");
    }
    const bool any_doubtful = std::ranges::any_of(plot.series, [](const PlotSeries& series) {
        return std::ranges::find(series.doubtful, true) != series.doubtful.end();
    });
    if (any_doubtful)
        result += text(right + 14, top + 16 + 22 * static_cast<double>(plot.series.size()), "hollow: time doubtful",
                       "fill=\"#505050\" font-size=\"11\"");
    return result;
}

}  // namespace

std::string svg_text(const LogPlot& plot) {
    const Axes axes = axes_of(plot);
    std::string result = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"sans-serif\" font-size=\"12\" fill=\"#202020\">\n<title>{2}</title>\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
        width, height, xml_text(plot.title));
    result +=
        text(0.5 * (left + right), 26, plot.title, "text-anchor=\"middle\" font-size=\"15\" font-weight=\"bold\"");
    result += grid(axes.x, true) + grid(axes.y, false);
    result += fmt::format(
        "<clipPath id=\"frame\"><rect x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\"/></clipPath>\n"
        "<rect x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" fill=\"none\" stroke=\"#404040\"/>\n",
        left, top, right - left, bottom - top);
    result += "<g clip-path=\"url(#frame)\">\n" + slope_lines(plot, axes) + level_lines(plot, axes) + "</g>\n";
    for (std::size_t k = 0; k < plot.series.size(); ++k) result += series_group(plot.series[k], k, axes);
    result += legend(plot);
    result += text(0.5 * (left + right), height - 16, plot.x_label, "text-anchor=\"middle\"");
    result += fmt::format("<text transform=\"translate(20 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                          0.5 * (top + bottom), xml_text(plot.y_label));
    return result + "</svg>\n";
}

}  // namespace drape::bench
