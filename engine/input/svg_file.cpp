#include "input/svg_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <numbers>
#include <pugixml.hpp>
#include <stdexcept>
#include <string_view>

#include "input/file_source.h"

namespace drape::input {

namespace {

using Point = std::array<double, 2>;

constexpr std::uint64_t most_drawing_bytes = std::uint64_t{64} << 20;
constexpr std::size_t most_shapes = 10'000;
constexpr int most_nested = 256;
constexpr double inch = 0.0254, pixel = inch / 96;

/// x' = a x + c y + e, y' = b x + d y + f.
struct Transform {
    double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
    Point of(const Point& p) const { return {a * p[0] + c * p[1] + e, b * p[0] + d * p[1] + f}; }
    /// Returns a bound of how much longer it makes anything.
    double growth() const { return std::sqrt(a * a + b * b + c * c + d * d); }
};

/// Returns the transform that does `inner` first.
Transform operator*(const Transform& outer, const Transform& inner) {
    const Point x = outer.of({inner.a, inner.b}), y = outer.of({inner.c, inner.d}), o = outer.of({inner.e, inner.f});
    return {x[0] - outer.e, x[1] - outer.f, y[0] - outer.e, y[1] - outer.f, o[0], o[1]};
}

[[noreturn]] void fail(const pugi::xml_node& node, std::string_view expected) {
    const std::string_view id = node.attribute("id").value();
    throw std::invalid_argument(fmt::format("{} in element <{}{}> of the file", expected, node.name(),
                                            id.empty() ? "" : fmt::format(" id=\"{}\"", id)));
}

bool is_blank(char letter) { return std::string_view(" \t\r\n\f,").find(letter) != std::string_view::npos; }

/// Takes the number with which a text begins, after blanks and commas.
std::optional<double> take_number(std::string_view& text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || !(std::abs(value) <= 1e9)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

std::vector<double> numbers_of(std::string_view text) {
    std::vector<double> all;
    while (const std::optional<double> value = take_number(text)) all.push_back(*value);
    return all;
}

/// Returns an attribute's number of user units; `absent` where it is missing.
double units_of(const pugi::xml_node& node, const char* name, double absent = 0) {
    std::string_view text = node.attribute(name).value();
    if (text.empty()) return absent;
    const std::optional<double> value = take_number(text);
    if (!value || (!text.empty() && text != "px")) fail(node, fmt::format("a number {} without a unit", name));
    return *value;
}

/// Returns a length in m; nothing where it is none, or a share of something.
std::optional<double> metres_of(std::string_view text) {
    const std::optional<double> value = take_number(text);
    if (!value || !(*value > 0)) return std::nullopt;
    for (const auto& [name, size] : std::initializer_list<std::pair<std::string_view, double>>{
             {"", pixel}, {"px", pixel}, {"mm", 1e-3}, {"cm", 1e-2}, {"in", inch}, {"pt", inch / 72}, {"pc", inch / 6}})
        if (text == name) return *value * size;
    return std::nullopt;
}

Transform turned(double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return {std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle), 0, 0};
}

/// Returns one function of a transform list; nothing: there is none of this name with so many numbers.
std::optional<Transform> function_of(std::string_view name, const std::vector<double>& n) {
    const auto slope = [&](std::size_t k) { return std::tan(n[k] * std::numbers::pi / 180); };
    if (name == "matrix" && n.size() == 6) return Transform{n[0], n[1], n[2], n[3], n[4], n[5]};
    if (name == "translate" && (n.size() == 1 || n.size() == 2))
        return Transform{1, 0, 0, 1, n[0], n.size() == 2 ? n[1] : 0};
    if (name == "scale" && (n.size() == 1 || n.size() == 2)) return Transform{n[0], 0, 0, n.back(), 0, 0};
    if (name == "rotate" && n.size() == 1) return turned(n[0]);
    if (name == "rotate" && n.size() == 3)
        return Transform{1, 0, 0, 1, n[1], n[2]} * turned(n[0]) * Transform{1, 0, 0, 1, -n[1], -n[2]};
    if (name == "skewX" && n.size() == 1) return Transform{1, 0, slope(0), 1, 0, 0};
    if (name == "skewY" && n.size() == 1) return Transform{1, slope(0), 0, 1, 0, 0};
    return std::nullopt;
}

Transform own_transform(const pugi::xml_node& node) {
    std::string_view text = node.attribute("transform").value();
    Transform all;
    while (true) {
        while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
        if (text.empty()) return all;
        const std::size_t open = text.find('('), close = text.find(')');
        if (open == std::string_view::npos || close == std::string_view::npos || close < open)
            fail(node, "a transform like translate(1 2)");
        std::string_view name = text.substr(0, open);
        while (!name.empty() && is_blank(name.back())) name.remove_suffix(1);
        const std::optional<Transform> next = function_of(name, numbers_of(text.substr(open + 1, close - open - 1)));
        if (!next) fail(node, "a transform of matrix, translate, scale, rotate, skewX and skewY");
        all = all * *next;
        text.remove_prefix(close + 1);
    }
}

std::string ellipse_path(double x, double y, double rx, double ry) {
    return fmt::format("M{0} {2}A{3} {4} 0 0 0 {1} {2}A{3} {4} 0 0 0 {0} {2}Z", x - rx, x + rx, y, rx, ry);
}

std::string rectangle_path(const pugi::xml_node& node) {
    const double x = units_of(node, "x"), y = units_of(node, "y"), width = units_of(node, "width"),
                 height = units_of(node, "height");
    const double given = units_of(node, "rx", units_of(node, "ry"));
    const double rx = std::clamp(given, 0.0, std::max(width / 2, 0.0)),
                 ry = std::clamp(units_of(node, "ry", given), 0.0, std::max(height / 2, 0.0));
    return fmt::format(
        "M{0} {1}H{2}a{4} {5} 0 0 1 {4} {5}V{3}a{4} {5} 0 0 1 -{4} {5}H{0}a{4} {5} 0 0 1 -{4} -{5}V{6}a{4} "
        "{5} 0 0 1 {4} -{5}Z",
        x + rx, y, x + width - rx, y + height - ry, rx, ry, y + ry);
}

/// The elements that are shapes, as path data.
struct ShapeKind {
    std::string_view name;
    std::string (*path)(const pugi::xml_node&);
};
constexpr ShapeKind shape_kinds[] = {
    {"path", [](const pugi::xml_node& node) { return std::string(node.attribute("d").value()); }},
    {"rect", rectangle_path},
    {"circle",
     [](const pugi::xml_node& node) {
         const double r = units_of(node, "r");
         return ellipse_path(units_of(node, "cx"), units_of(node, "cy"), r, r);
     }},
    {"ellipse",
     [](const pugi::xml_node& node) {
         return ellipse_path(units_of(node, "cx"), units_of(node, "cy"), units_of(node, "rx"), units_of(node, "ry"));
     }},
    {"polygon", [](const pugi::xml_node& node) { return fmt::format("M{}Z", node.attribute("points").value()); }},
    {"polyline", [](const pugi::xml_node& node) { return fmt::format("M{}Z", node.attribute("points").value()); }},
};

const ShapeKind* shape_kind(const pugi::xml_node& node) {
    const auto found = std::ranges::find(shape_kinds, std::string_view(node.name()), &ShapeKind::name);
    return found == std::end(shape_kinds) ? nullptr : found;
}

/// Elements whose content is defined, not drawn.
bool only_defines(const pugi::xml_node& node) {
    constexpr std::string_view names[] = {"defs", "symbol", "clipPath", "mask", "marker", "pattern"};
    return std::ranges::count(names, std::string_view(node.name())) > 0;
}

/// Visits an element and all in it in the file's order, without recursion: files may nest as deep as they like.
void visit_all(const pugi::xml_node& root, const std::function<void(const pugi::xml_node&)>& visit) {
    struct Walker : pugi::xml_tree_walker {
        const std::function<void(const pugi::xml_node&)>* visit;
        bool for_each(pugi::xml_node& node) override {
            (*visit)(node);
            return true;
        }
    } walker;
    walker.visit = &visit;
    visit(root);
    pugi::xml_node(root).traverse(walker);
}

class SvgReader {
  public:
    SvgReader(const pugi::xml_node& svg, const SvgChoice& choice) : choice_(choice), unit_(choice.unit.value_or(0)) {
        if (std::string_view(svg.name()) != "svg")
            throw std::invalid_argument("an SVG file, whose first element is svg");
        const std::vector<double> box = numbers_of(svg.attribute("viewBox").value());
        const bool has_box = box.size() == 4 && box[2] > 0 && box[3] > 0;
        const std::optional<double> width = metres_of(svg.attribute("width").value()),
                                    height = metres_of(svg.attribute("height").value());
        if (!choice.unit) unit_ = !has_box ? pixel : width ? *width / box[2] : height ? *height / box[3] : pixel;
    }

    std::vector<PathCurve> read(const pugi::xml_node& svg) {
        pugi::xml_node from = svg;
        if (!choice_.element.empty()) {
            from = {};
            visit_all(svg, [&](const pugi::xml_node& node) {
                if (from.empty() && node.attribute("id").value() == choice_.element) from = node;
            });
            if (from.empty())
                throw std::invalid_argument(fmt::format("an element with the id \"{}\"", choice_.element));
        }
        visit_all(from, [&](const pugi::xml_node& node) {
            if (const ShapeKind* kind = shape_kind(node)) add(node, *kind, from);
        });
        if (curves_.empty())
            throw std::invalid_argument(
                "a path, rect, circle, ellipse, polygon or polyline that goes around something");
        return std::move(curves_);
    }

  private:
    void add(const pugi::xml_node& node, const ShapeKind& kind, const pugi::xml_node& from) {
        if (++shapes_ > most_shapes) throw std::invalid_argument(fmt::format("at most {} shapes", most_shapes));
        Transform all{unit_, 0, 0, unit_, 0, 0};
        std::vector<Transform> inward;
        bool is_within = true;
        for (pugi::xml_node at = node; at; at = at.parent()) {
            if (inward.size() > most_nested) fail(node, fmt::format("at most {} groups around a shape", most_nested));
            if (is_within && at != from && only_defines(at)) return;
            if (at == from) is_within = false;
            inward.push_back(own_transform(at));
        }
        std::for_each(inward.rbegin(), inward.rend(), [&](const Transform& next) { all = all * next; });
        if (!(all.growth() > 0 && all.growth() < 1e12)) fail(node, "a transform that leaves a shape its size");
        std::vector<PathCurve> curves;
        try {
            curves = read_path(kind.path(node), choice_.tolerance / all.growth());
        } catch (const std::invalid_argument& error) {
            fail(node, error.what());
        }
        for (PathCurve& curve : curves) {
            for (Point& at : curve.points) at = all.of(at);
            curves_.push_back(std::move(curve));
        }
    }

    const SvgChoice& choice_;
    double unit_;  ///< m of a user unit
    std::size_t shapes_ = 0;
    std::vector<PathCurve> curves_;
};

}  // namespace

std::vector<PathCurve> read_svg(const std::filesystem::path& path, const SvgChoice& choice) {
    FileSource file(path);
    if (file.size() > most_drawing_bytes)
        throw unreadable(file.name(), fmt::format("a drawing has at most {} MiB", most_drawing_bytes >> 20));
    std::vector<std::uint8_t> bytes = file.rest();
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_buffer_inplace(bytes.data(), bytes.size());
    if (!result) throw unreadable(file.name(), fmt::format("{} at byte {}", result.description(), result.offset));
    const pugi::xml_node svg = document.document_element();
    return SvgReader(svg, choice).read(svg);
}

}  // namespace drape::input
