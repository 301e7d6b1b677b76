#include "scene/sewing_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "base/vectors.h"
#include "input/svg_path.h"
#include "scene/scene_node.h"
#include "scene/scene_text_file.h"
#include "scene/sewing_panels.h"

namespace drape {
namespace {

/// A pattern may have this many panels, and a panel this many edges: more than any garment.
constexpr std::size_t most_panels = 1000, most_edges = 10'000;

struct Units {
    double metre = 100;  ///< units in a metre
    bool relative = true;
};

/// Returns a control point of an edge, m. A relative one has the edge as its first axis, of length 1, and the second
/// axis a quarter turn against the clock from it.
PatternPoint control_point(const PatternPoint& given, const PatternEdge& edge, const Units& units) {
    if (!units.relative) return {given[0] / units.metre, given[1] / units.metre};
    const double dx = edge.to[0] - edge.from[0], dy = edge.to[1] - edge.from[1];
    return {edge.from[0] + given[0] * dx - given[1] * dy, edge.from[1] + given[0] * dy + given[1] * dx};
}

/// Reads the control points of a Bezier curve.
bool read_curve(const SceneNode& params, std::size_t count, char letter, const Units& units, PatternEdge& edge) {
    if (!params) return params.fail_expected("the curve's params");
    if (!params.open_array(fmt::format("an array of {} control points", count), count, count)) return false;
    edge.segment = letter;
    for (std::size_t i = 0; i < count; ++i) {
        PatternPoint given{};
        if (!params.element(i).read(std::span<double>(given), "a control point [x, y]", any_number)) return false;
        edge.segment += path_point(control_point(given, edge, units)) + " ";
    }
    edge.segment += path_point(edge.to);
    return true;
}

/// Reads [radius, whether the arc is the large one, whether it turns against the clock].
bool read_circle(const SceneNode& params, const Units& units, PatternEdge& edge) {
    if (!params) return params.fail_expected("the arc's params");
    if (!params.open_array("an array [radius, large, right]", 3, 3)) return false;
    double radius = 0, large = 0, right = 0;
    if (!params.element(0).read(radius, positive)) return false;
    const auto read_flag = [](const SceneNode& node, double& flag) {
        bool set = false;
        if (!node.value()->isBool()) return node.read(flag, unit_interval);
        (void)node.read(set);
        flag = set;
        return true;
    };
    if (!read_flag(params.element(1), large) || !read_flag(params.element(2), right)) return false;
    edge.segment = fmt::format("A{0:.9g} {0:.9g} 0 {1:d} {2:d} {3}", radius / units.metre, large > 0.5, right > 0.5,
                               path_point(edge.to));
    return true;
}

enum class Curvature { quadratic, cubic, circle };
constexpr Spelling<Curvature> curvature_spellings[] = {
    {"quadratic", Curvature::quadratic}, {"cubic", Curvature::cubic}, {"circle", Curvature::circle}};

/// Reads what bends an edge: an object with its type, or, as older files have it, one control point.
bool read_curvature(const SceneNode& node, const Units& units, PatternEdge& edge) {
    edge.segment = "L" + path_point(edge.to);
    if (!node || node.value()->isNull()) return true;
    if (node.value()->isArray()) {
        PatternPoint given{};
        if (!node.read(std::span<double>(given), "a control point [x, y]", any_number)) return false;
        edge.segment = "Q" + path_point(control_point(given, edge, units)) + " " + path_point(edge.to);
        return true;
    }
    if (!node.value()->isObject()) return node.fail_expected("an object with type and params");
    Curvature type{};
    const SceneNode name = node.member("type"), params = node.member("params");
    if (!name) return name.fail_expected("a type: quadratic, cubic or circle");
    if (!name.read_choice(type, std::span<const Spelling<Curvature>>(curvature_spellings))) return false;
    switch (type) {
        case Curvature::quadratic:
            return read_curve(params, 1, 'Q', units, edge);
        case Curvature::cubic:
            return read_curve(params, 2, 'C', units, edge);
        case Curvature::circle:
            return read_circle(params, units, edge);
    }
    return false;
}

/// Returns the length of an edge, m, to a thousandth of its chord or better.
double edge_length(const PatternEdge& edge) {
    const double chord = std::hypot(edge.to[0] - edge.from[0], edge.to[1] - edge.from[1]);
    const auto curves = input::read_path("M" + path_point(edge.from) + edge.segment, 1e-5 * std::max(chord, 1e-3));
    if (curves.empty()) return chord;
    double sum = 0;
    const std::vector<PatternPoint>& points = curves[0].points;
    for (std::size_t i = 1; i < points.size(); ++i)
        sum += std::hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]);
    // A curve's last point stands for its first one where they meet, and a straight edge may be closed by none.
    return std::max(sum, chord);
}

std::optional<std::vector<PatternPoint>> read_vertices(const SceneNode& node, const Units& units) {
    if (!node) return node.fail_expected("the panel's vertices"), std::nullopt;
    if (!node.open_array("an array of 3 to 10000 vertices", 3, most_edges)) return {};
    std::vector<PatternPoint> vertices(node.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (!node.element(i).read(std::span<double>(vertices[i]), "a vertex [x, y]", any_number)) return {};
        for (double& x : vertices[i]) x /= units.metre;
    }
    return vertices;
}

/// Reads the edges, each of which begins where the one before it ends.
bool read_edges(const SceneNode& node, const std::vector<PatternPoint>& vertices, const Units& units,
                std::vector<PatternEdge>& edges) {
    if (!node) return node.fail_expected("the panel's edges");
    if (!node.open_array("an array of 2 to 10000 edges", 2, most_edges)) return false;
    const auto last = static_cast<std::uint32_t>(vertices.size() - 1);
    std::uint32_t begin = 0, end = 0;
    for (std::size_t i = 0; i < node.size(); ++i) {
        const SceneNode endpoints = node.element(i).member("endpoints");
        if (!endpoints) return endpoints.fail_expected("the edge's endpoints");
        if (!endpoints.open_array("an array of 2 indices of vertices", 2, 2)) return false;
        std::uint32_t from = 0, to = 0;
        if (!endpoints.element(0).read(from, 0, last) || !endpoints.element(1).read(to, 0, last)) return false;
        if (i == 0) begin = from;
        if (i > 0 && from != end)
            return endpoints.fail(
                fmt::format("expected the edge to begin at vertex {}, where the one before it ends, "
                            "got {}",
                            end, from));
        end = to;
        PatternEdge& edge = edges.emplace_back();
        edge.from = vertices[from];
        edge.to = vertices[to];
        if (!read_curvature(node.element(i).member("curvature"), units, edge)) return false;
        try {
            edge.length = edge_length(edge);
        } catch (const std::invalid_argument& error) {
            return node.element(i).fail(error.what());
        }
    }
    return end == begin || node.fail(fmt::format("expected a loop of edges that ends at vertex {}, got one that ends "
                                                 "at {}",
                                                 begin, end));
}

/// Returns where a panel is: its x and y turned about the axes x, y and z, one after the other, by angles in degrees.
Placement placement_of(const Vec3& translation, const Vec3& rotation, const Units& units) {
    Vec3 u{1, 0, 0}, v{0, 1, 0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double angle = rotation[axis] * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
        const std::size_t next = (axis + 1) % 3, after = (axis + 2) % 3;
        for (Vec3* vector : {&u, &v}) {
            const double y = (*vector)[next], z = (*vector)[after];
            (*vector)[next] = c * y - s * z;
            (*vector)[after] = s * y + c * z;
        }
    }
    return {times(1 / units.metre, translation), u, v};
}

std::optional<PatternPanel> read_panel(const SceneNode& node, const std::string& name, const Units& units) {
    if (!node.value()->isObject()) return node.fail_expected("a panel"), std::nullopt;
    const auto legal = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-'; };
    if (name.empty() || name.size() > 64 || !std::all_of(name.begin(), name.end(), legal))
        return node.fail("expected a name of 1 to 64 letters, digits, _ and -, which becomes the cloth's"),
               std::nullopt;
    PatternPanel panel{name, {}, {}};
    Vec3 translation{}, rotation{};
    if (!node.member("translation").read(translation) || !node.member("rotation").read(rotation)) return {};
    panel.placement = placement_of(translation, rotation, units);
    const auto vertices = read_vertices(node.member("vertices"), units);
    if (!vertices || !read_edges(node.member("edges"), *vertices, units, panel.loops.emplace_back())) return {};
    return panel;
}

bool read_units(const SceneNode& properties, Units& units) {
    enum class Coordinates { relative, absolute };
    constexpr Spelling<Coordinates> spellings[] = {{"relative", Coordinates::relative},
                                                   {"absolute", Coordinates::absolute}};
    Coordinates coordinates{};
    if (!properties.member("units_in_meter").read(units.metre, positive) ||
        !properties.member("curvature_coords")
             .read_choice(coordinates, std::span<const Spelling<Coordinates>>(spellings)))
        return false;
    units.relative = coordinates == Coordinates::relative;
    return true;
}

/// Reads one end of a stitch: the side of a seam.
bool read_end(const SceneNode& node, const std::vector<PatternPanel>& panels, PatternSide& side) {
    std::string name;
    const SceneNode panel = node.member("panel"), edge = node.member("edge");
    if (!panel) return panel.fail_expected("the name of a panel");
    if (!panel.read(name)) return false;
    while (side.panel < panels.size() && panels[side.panel].name != name) ++side.panel;
    if (side.panel == panels.size()) return panel.fail_expected("the name of a panel");
    std::uint32_t number = 0;
    if (!edge) return edge.fail_expected("the number of an edge");
    if (!edge.read(number, 0, static_cast<std::uint32_t>(panels[side.panel].loops[0].size() - 1))) return false;
    side.first = number;
    return true;
}

/// Reads the stitches. A third element of one, which says which sides of the cloth face each other, is passed over.
bool read_stitches(const SceneNode& stitches, const std::vector<PatternPanel>& panels,
                   std::vector<PatternSeam>& seams) {
    if (stitches && !stitches.open_array("an array of at most 4096 stitches", 0, 4096)) return false;
    bool fits = true;
    for (std::size_t i = 0; stitches && i < stitches.size(); ++i) {
        const SceneNode stitch = stitches.element(i);
        PatternSeam& seam = seams.emplace_back();
        fits = stitch.open_array("a stitch: an array of two edges", 2, 3) &&
               read_end(stitch.element(0), panels, seam.a) && read_end(stitch.element(1), panels, seam.b) && fits;
    }
    return fits;
}

/// Reads the panels, by name.
bool read_panels(const SceneNode& nodes, const Units& units, std::vector<PatternPanel>& panels) {
    if (!nodes || !nodes.value()->isObject() || nodes.value()->empty() || nodes.value()->size() > most_panels)
        return nodes.fail_expected(fmt::format("an object of 1 to {} panels, by name", most_panels));
    for (const std::string& name : nodes.value()->getMemberNames())
        if (auto panel = read_panel(nodes.member(name), name, units)) panels.push_back(std::move(*panel));
    return panels.size() == nodes.value()->size();
}

/// Makes the scene of a pattern, or reports what is wrong with it.
void make_scene(const SceneNode& root, const PatternOptions& options, PatternResult& result) {
    const SceneNode pattern = root.member("pattern");
    Units units;
    std::vector<PatternPanel> panels;
    std::vector<PatternSeam> seams;
    if (read_units(root.member("properties"), units) && read_panels(pattern.member("panels"), units, panels) &&
        read_stitches(pattern.member("stitches"), panels, seams))
        write_pattern_scene(panels, seams, options, result);
}

}  // namespace

PatternResult read_sewing_pattern_text(std::string_view text, const std::string& file_name,
                                       const PatternOptions& options) {
    PatternResult result;
    if (const std::string fault = size_fault(text.size()); !fault.empty()) {
        result.errors.push_back({file_name, 0, 0, "", fault});
        return result;
    }
    SceneDocument document(text, file_name);
    SceneReport report{document, {}, {}};
    for (const PlacedError& error : document.errors()) result.errors.push_back(error.error);
    if (!result.errors.empty()) return result;
    make_scene(SceneNode(report, document.root()), options, result);
    result.errors = report.errors.told();
    return result;
}

PatternResult read_sewing_pattern(const std::string& path, const PatternOptions& options) {
    if (path.ends_with(".obj") || path.ends_with(".OBJ")) return read_uv_pattern(path, options);
    const TextFile file = read_text_file(path);
    if (file.error.empty()) return read_sewing_pattern_text(file.text, path, options);
    PatternResult result;
    result.errors.push_back({path, 0, 0, "", file.error});
    result.unreadable = true;
    return result;
}

}  // namespace drape
