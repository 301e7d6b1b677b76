#include "plot/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "output/xml_text.h"

namespace drape::plot {

namespace {

constexpr double width = 640, left = 72, right = 624, area_height = 290, legend_top = 42, row_height = 18;

/// Okabe and Ito's colours, which the colour-blind tell apart; yellow, too pale on white, is left out.
constexpr std::array colours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#7F7F7F"};
/// Outlines around the point (0, 0): circle, square, triangle, diamond, triangle, star, and bars lying and standing.
constexpr std::array markers = {
    "M-4 0a4 4 0 1 0 8 0a4 4 0 1 0-8 0z",    "M-4-4h8v8h-8z",   "M0-5l5 9h-10z", "M0-6l5 6l-5 6l-5-6z", "M0 5l5-9h-10z",
    "M-5 0l4-1l1-5l1 5l4 1l-4 1l-1 5l-1-5z", "M-5-2h10v4h-10z", "M-2-5h4v10h-4z"};
static_assert(colours.size() == markers.size());

struct Tick {
    double value;
    std::string label;
    bool is_major;
};

/// Values from `first` to `last`, or powers of ten with these exponents, along pixels `begin` to `end`.
struct Axis {
    bool logarithmic;
    double first, last, begin, end;
    std::vector<Tick> ticks{};
    double place(double value) const {
        return begin + ((logarithmic ? std::log10(value) : value) - first) / (last - first) * (end - begin);
    }
};

/// The axis is a whole number of steps long: of 1, 2 or 5 times a power of ten, about five of them.
Axis linear_axis(double low, double high, double begin, double end) {
    if (!(high > low)) high = low + 1;
    const double rough = (high - low) / 5, power = std::pow(10, std::floor(std::log10(rough)));
    const double share = rough / power, step = power * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
    Axis axis{false, std::floor(low / step + 1e-9) * step, std::ceil(high / step - 1e-9) * step, begin, end};
    for (int k = 0; axis.first + k * step < axis.last + step / 2; ++k) {
        const double value = axis.first + k * step;
        axis.ticks.push_back({value, fmt::format("{:.4g}", std::abs(value) < step / 2 ? 0 : value), true});
    }
    return axis;
}

std::string power_label(double value) {
    const double power = std::log10(value);
    if (std::abs(power - std::round(power)) > 1e-6 || std::abs(power) < 3.5) return fmt::format("{:.4g}", value);
    return fmt::format("1e{:.0f}", power);
}

/// The axis holds every value; on less than a decade and a half its ends are tenths of a decade. Ticks stand at 1 to 9
/// times every power of ten, numbers at the powers, and at 2 and 5 on short axes.
Axis logarithmic_axis(double least, double most, double begin, double end) {
    const double span = std::log10(most / least), unit = span < 1.5 ? 0.1 : 1.0;
    Axis axis{true, std::floor(std::log10(least) / unit + 1e-9) * unit,
              std::ceil(std::log10(most) / unit - 1e-9) * unit, begin, end};
    if (axis.last - axis.first < unit) axis.last = axis.first + unit;
    const bool is_short = axis.last - axis.first < 2.5;
    for (int decade = static_cast<int>(std::floor(axis.first)); decade <= axis.last + 1e-9; ++decade)
        for (int digit = 1; digit <= 9; ++digit) {
            const double value = digit * std::pow(10.0, decade), power = std::log10(value);
            if (power < axis.first - 1e-9 || power > axis.last + 1e-9) continue;
            const bool labelled = digit == 1 || (is_short && (digit == 2 || digit == 5));
            axis.ticks.push_back({value, labelled ? power_label(value) : "", digit == 1});
        }
    return axis;
}

std::string stroke(double x1, double y1, double x2, double y2, const std::string& style) {
    return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" {}/>\n", x1, y1, x2, y2, style);
}

/// A plot's axes, its legend's places, and what is drawn into them.
class Drawing {
  public:
    explicit Drawing(const Plot& plot) : plot_(plot) {
        place_legend();
        place_axes();
    }

    std::string svg() const {
        const double middle = 0.5 * (left + right), height = y_.begin + 52;
        std::string svg = svg_begin(width, height, plot_.title, 12);
        svg += svg_text(middle, 22, plot_.title, "text-anchor=\"middle\" font-size=\"15\" font-weight=\"bold\"");
        svg += grid() + slope_lines() + level_lines();
        for (std::size_t k = 0; k < plot_.curves.size(); ++k) svg += curve_group(k);
        svg += svg_text(middle, height - 14, plot_.x_label, "text-anchor=\"middle\"");
        svg += fmt::format("<text transform=\"translate(18 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                           0.5 * (y_.begin + y_.end), xml_text(plot_.y_label));
        const bool any_doubtful = std::ranges::any_of(plot_.curves, [](const Curve& curve) {
            return std::ranges::find(curve.doubtful, true) != curve.doubtful.end();
        });
        if (any_doubtful) svg += svg_text(right, height - 14, "hollow: time doubtful", "text-anchor=\"end\"");
        if (!plot_.logarithmic) svg += cursor();
        return svg + "</svg>\n";
    }

  private:
    /// An empty group, which says where on the axis a page's script may mark a place.
    std::string cursor() const {
        return fmt::format(
            "<g class=\"cursor\" data-left=\"{}\" data-right=\"{}\" data-first=\"{}\" data-last=\"{}\" "
            "data-top=\"{:.1f}\" "
            "data-bottom=\"{:.1f}\"></g>\n",
            left, right, x_.first, x_.last, y_.end, y_.begin);
    }

    /// Names side by side, in as many rows as it takes.
    void place_legend() {
        double x = left, y = legend_top;
        for (const Curve& curve : plot_.curves) {
            const double needed = 44 + 6.6 * static_cast<double>(curve.name.size());
            if (x > left && x + needed > right) x = left, y += row_height;
            legend_.push_back({x, y});
            x += needed;
        }
    }

    void place_axes() {
        const bool from_zero = !plot_.logarithmic && plot_.from_zero;
        const double start = from_zero ? 0 : INFINITY, end = from_zero || plot_.logarithmic ? 0 : -INFINITY;
        std::array<double, 2> low{start, start}, high{from_zero ? plot_.x_last : end, end};
        const auto include = [&](std::size_t k, double value) {
            low[k] = std::min(low[k], value);
            high[k] = std::max(high[k], value);
        };
        for (const Curve& curve : plot_.curves)
            for (const std::array<double, 2>& point : curve.points)
                for (std::size_t k = 0; k < 2 && drawable(point); ++k) include(k, point[k]);
        for (const Level& level : plot_.levels)
            if (drawable({1, level.value})) include(1, level.value);
        for (std::size_t k = 0; k < 2 && plot_.logarithmic; ++k)
            if (high[k] <= 0) low[k] = 0.1, high[k] = 10;
        for (std::size_t k = 0; k < 2; ++k)
            if (low[k] > high[k]) low[k] = high[k] = 0;
        const auto axis = plot_.logarithmic ? logarithmic_axis : linear_axis;
        const double top = (legend_.empty() ? legend_top : legend_.back()[1]) + 16;
        x_ = axis(low[0], high[0], left, right);
        y_ = axis(low[1], high[1], top + area_height, top);
    }

    bool drawable(const std::array<double, 2>& point) const {
        return std::ranges::all_of(
            point, [&](double value) { return std::isfinite(value) && (!plot_.logarithmic || value > 0); });
    }

    std::string grid() const {
        std::string svg;
        const auto style = [](const Tick& tick) { return tick.is_major ? "stroke=\"#d0d0d0\"" : "stroke=\"#ebebeb\""; };
        for (const Tick& tick : x_.ticks) {
            const double at = x_.place(tick.value);
            svg += stroke(at, y_.begin, at, y_.end, style(tick));
            if (!tick.label.empty()) svg += svg_text(at, y_.begin + 17, tick.label, "text-anchor=\"middle\"");
        }
        for (const Tick& tick : y_.ticks) {
            const double at = y_.place(tick.value);
            svg += stroke(left, at, right, at, style(tick));
            if (!tick.label.empty()) svg += svg_text(left - 7, at + 4, tick.label, "text-anchor=\"end\"");
        }
        return svg;
    }

    /// Reference lines through a point a little inside, each labelled where it leaves the frame.
    std::string slope_lines() const {
        std::string svg;
        for (const double slope : plot_.slopes) {
            const double inside = 0.08 * (y_.last - y_.first), x0 = x_.first + 0.08 * (x_.last - x_.first);
            const double y0 = slope < 0 ? y_.last - inside : y_.first + inside;
            const double x1 = std::min(x_.last, x0 + ((slope < 0 ? y_.first : y_.last) - y0) / slope);
            const auto x = [&](double power) { return x_.place(std::pow(10.0, power)); };
            const auto y = [&](double power) { return y_.place(std::pow(10.0, power)); };
            const double end = y(y0 + slope * (x1 - x0));
            svg += stroke(x(x0), y(y0), x(x1), end, "stroke=\"#606060\" stroke-dasharray=\"2 4\"");
            svg += svg_text(x(x1) - 5, end + (slope < 0 ? -5 : 13), fmt::format("slope {:g}", slope),
                            "text-anchor=\"end\" fill=\"#505050\" font-size=\"11\"");
        }
        return svg;
    }

    std::string level_lines() const {
        std::string svg;
        for (const Level& level : plot_.levels) {
            if (!drawable({1, level.value})) continue;
            const double y = y_.place(level.value);
            svg += stroke(left, y, right, y, "stroke=\"#303030\" stroke-dasharray=\"7 4\"");
            svg += svg_text(left + 6, y - 4, level.name, "font-size=\"11\"");
        }
        return svg;
    }

    /// The curve, the marks of its points where they are few, and its place in the legend.
    std::string curve_group(std::size_t index) const {
        const Curve& curve = plot_.curves[index];
        const std::size_t look = curve.look.value_or(index) % colours.size();
        const auto [legend_x, legend_y] = legend_[index];
        const bool marked = plot_.logarithmic || !curve.joined || curve.points.size() == 1;
        const auto marker = [&](double x, double y) {
            return marked ? fmt::format("<path transform=\"translate({:.1f} {:.1f})\" d=\"{}\"/>", x, y, markers[look])
                          : std::string();
        };
        std::string places, marks = marker(legend_x + 14, legend_y);
        for (std::size_t k = 0; k < curve.points.size(); ++k) {
            if (!drawable(curve.points[k])) continue;
            const double x = x_.place(curve.points[k][0]), y = y_.place(curve.points[k][1]);
            if (curve.joined) places += fmt::format("{:.1f},{:.1f} ", x, y);
            const bool doubtful = k < curve.doubtful.size() && curve.doubtful[k];
            marks += doubtful ? fmt::format("<g class=\"doubtful\" fill=\"#ffffff\" stroke=\"{}\">{}</g>",
                                            colours[look], marker(x, y))
                              : marker(x, y);
        }
        const std::string line = fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"{}", colours[look],
                                             curve.dashed ? " stroke-dasharray=\"5 3\"" : "");
        return fmt::format(
            "<g class=\"series\" fill=\"{}\"><title>{}</title>\n<polyline points=\"{}\" {}/>\n{}{}\n{}</g>\n",
            colours[look], xml_text(curve.name), places, line,
            curve.joined ? stroke(legend_x, legend_y, legend_x + 28, legend_y, line) : std::string(), marks,
            svg_text(legend_x + 33, legend_y + 4, curve.name, "fill=\"#202020\""));
    }

    const Plot& plot_;
    std::vector<std::array<double, 2>> legend_;
    Axis x_{}, y_{};
};

}  // namespace

std::string svg_begin(double picture_width, double height, const std::string& title, int font_size) {
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
        "font-family=\"sans-serif\" font-size=\"{2}\" fill=\"#202020\">\n<title>{3}</title>\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
        picture_width, height, font_size, xml_text(title));
}

std::string svg_text(double x, double y, const std::string& content, const char* style) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, style, xml_text(content));
}

std::string svg_of(const Plot& plot) { return Drawing(plot).svg(); }

std::map<std::string, std::string> svg_of(const Plots& plots) {
    std::map<std::string, std::string> drawn;
    for (const auto& [name, plot] : plots) drawn[name] = svg_of(plot);
    return drawn;
}

}  // namespace drape::plot
