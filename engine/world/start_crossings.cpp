#include "world/start_crossings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "base/vectors.h"
#include "world/seam_cover.h"
#include "world/start.h"
#include "world/surface_distance.h"
#include "world/triangle_crossings.h"

namespace drape {

namespace {

constexpr double touching_depth = 1e-4;  ///< m: cloths that overlap by less only touch

/// A cloth at its start.
struct Sheet {
    const Cloth* cloth;
    std::vector<bool> missing;
    std::vector<Vec3> at;
    std::vector<bool> sewn;              ///< by particle
    std::vector<std::uint32_t> indices;  ///< of its triangles, without those that seams leave out
    Vec3 lower, upper;
    double doubt;  ///< m: the resolution of single precision here

    Sheet(const SceneDescription& scene, std::size_t index, const SeamCover& seams) : Sheet(scene.cloths[index]) {
        if (seams.cloths.empty()) return;
        sewn = seams.cloths[index].sewn;
        indices = seams.covered(index, start_mesh(*cloth, at).indices);
    }
    explicit Sheet(const Cloth& of)
        : cloth(&of),
          missing(missing_cells(of)),
          at(start_positions(of)),
          sewn(at.size()),
          indices(start_mesh(of, at).indices),
          lower(at[0]),
          upper(at[0]) {
        double farthest = 0;
        for (const Vec3& x : at)
            for (std::size_t k = 0; k < 3; ++k) {
                lower[k] = std::min(lower[k], x[k]);
                upper[k] = std::max(upper[k], x[k]);
                farthest = std::max(farthest, std::abs(x[k]));
            }
        doubt = 4e-6 * farthest + of.placement.jitter;
    }

    TriangleCrossings::Mesh mesh() const { return {at, indices}; }
    bool is_sewn() const { return std::ranges::find(sewn, true) != sewn.end(); }

    /// Returns whether a point is on the flat cloth, or at most `within` (m) away from it.
    bool holds(const Vec3& point, double within) const {
        const Vec3 &origin = at.front(), &u_end = at[cloth->grid[0] - 1], &v_end = at[at.size() - cloth->grid[0]];
        const Vec3 from = minus(point, origin), u = minus(u_end, origin), v = minus(v_end, origin);
        const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), area = uu * vv - uv * uv;
        if (!(area > 0)) return false;
        const double fu = dot(from, u), fv = dot(from, v);
        const double s = (fu * vv - fv * uv) / area, t = (fv * uu - fu * uv) / area;
        const Vec3 off{from[0] - s * u[0] - t * v[0], from[1] - s * u[1] - t * v[1], from[2] - s * u[2] - t * v[2]};
        if (!(s >= 0 && s <= 1 && t >= 0 && t <= 1 && length(off) <= within)) return false;
        const auto cell = [](double share, std::uint32_t particles) {
            return std::min(static_cast<std::size_t>(share * (particles - 1)), std::size_t{particles} - 2);
        };
        return !missing[cell(t, cloth->grid[1]) * (cloth->grid[0] - 1) + cell(s, cloth->grid[0])];
    }
};

bool boxes_meet(const Sheet& a, const Sheet& b, double within) {
    for (std::size_t k = 0; k < 3; ++k)
        if (a.lower[k] > b.upper[k] + within || b.lower[k] > a.upper[k] + within) return false;
    return true;
}

/// The direction and distance that move a sheet off another one.
struct WayOff {
    double depth;  ///< m; not finite: there is no way
    Vec3 way;      ///< unit
};

/// Returns how `b`, moved along the normal of `a` (of any shape), clears it, to the side on which it does so sooner.
WayOff way_off(const Sheet& a, const Sheet& b, const Vec3& normal) {
    const auto heights = [&](const Sheet& sheet) {
        const auto [low, high] =
            std::ranges::minmax(sheet.at, {}, [&](const Vec3& x) { return dot(normal, minus(x, a.at.front())); });
        return std::array{dot(normal, minus(low, a.at.front())), dot(normal, minus(high, a.at.front()))};
    };
    const auto [a_low, a_high] = heights(a);
    const auto [b_low, b_high] = heights(b);
    const double up = std::max(0.0, a_high - b_low), down = std::max(0.0, b_high - a_low), side = down < up ? -1 : 1;
    return {std::min(up, down), {side * normal[0], side * normal[1], side * normal[2]}};
}

/// Returns how `b` clears the plane of `a`, to the side on which most of `b` is.
WayOff way_off(const Sheet& a, const Sheet& b) {
    const Vec3 normal = start_normal(*a.cloth);
    if (!(length(normal) > 0)) return {std::numeric_limits<double>::infinity(), {}};
    double above = 0, below = 0;
    if (!a.cloth->start.empty()) return way_off(a, b, normal);
    for (const Vec3& x : b.at) {
        const double height = dot(normal, minus(x, a.at.front()));
        above = std::max(above, height);
        below = std::max(below, -height);
    }
    const double side = above < below ? -1 : 1;
    return {std::min(above, below), {side * normal[0], side * normal[1], side * normal[2]}};
}

WayOff shorter_way_off(const Sheet& a, const Sheet& b) {
    const WayOff second = way_off(a, b), first = way_off(b, a);
    if (!(first.depth < second.depth)) return second;
    return {first.depth, {-first.way[0], -first.way[1], -first.way[2]}};
}

/// Returns whether a point is on a triangle, or at most `within` (m) off its plane.
bool holds(const std::array<Vec3, 3>& corner, const Vec3& point, double within) {
    const Vec3 u = minus(corner[1], corner[0]), v = minus(corner[2], corner[0]), from = minus(point, corner[0]);
    const Vec3 normal = cross(u, v);
    const double squared = dot(normal, normal);
    if (!(squared > 0) || std::abs(dot(normal, from)) > within * std::sqrt(squared)) return false;
    constexpr double least = -1e-6;
    const double s = dot(cross(from, v), normal) / squared, t = dot(cross(u, from), normal) / squared;
    return s >= least && t >= least && s + t <= 1 - least;
}

/// Points in slabs across one axis, sorted within a slab along another: a box finds its points without a test of all
/// points.
class Slabs {
  public:
    /// Uses the two axes along which the box is longest.
    Slabs(std::vector<Vec3> points, const Vec3& lower, const Vec3& upper, double width)
        : points_(std::move(points)), lower_(lower), width_(width) {
        std::array<std::size_t, 3> axes{0, 1, 2};
        std::ranges::sort(axes, std::greater(), [&](std::size_t axis) { return upper[axis] - lower[axis]; });
        across_ = axes[0], along_ = axes[1];
        std::ranges::sort(points_, {}, [this](const Vec3& x) { return key(x); });
    }

    /// Returns whether some point in the box passes `test`.
    template <class Test>
    bool any(const Vec3& low, const Vec3& high, const Test& test) const {
        for (double slab = slab_of(low); slab <= slab_of(high); ++slab) {
            const auto first = std::ranges::lower_bound(points_, std::pair(slab, low[along_]), {},
                                                        [this](const Vec3& x) { return key(x); });
            for (auto x = first; x != points_.end() && key(*x) <= std::pair(slab, high[along_]); ++x)
                if (test(*x)) return true;
        }
        return false;
    }

  private:
    double slab_of(const Vec3& x) const { return std::floor((x[across_] - lower_[across_]) / width_); }
    std::pair<double, double> key(const Vec3& x) const { return {slab_of(x), x[along_]}; }

    std::vector<Vec3> points_;
    Vec3 lower_;
    double width_;
    std::size_t across_ = 0, along_ = 1;
};

/// Returns whether any particle of `a` that no seam joins lies on the triangles of `b`, of any shape.
bool lies_on(const Sheet& a, const Sheet& b, double within) {
    std::vector<Vec3> near;
    for (std::size_t particle = 0; particle < a.at.size(); ++particle) {
        const Vec3& x = a.at[particle];
        bool is_near = !a.sewn[particle];
        for (std::size_t k = 0; k < 3; ++k)
            is_near = is_near && x[k] >= b.lower[k] - within && x[k] <= b.upper[k] + within;
        if (is_near) near.push_back(x);
    }
    const double width =
        std::max(length(minus(b.upper, b.lower)) / std::sqrt(static_cast<double>(b.at.size())), within);
    const Slabs points(std::move(near), b.lower, b.upper, width);
    const TriangleCrossings::Mesh mesh = b.mesh();
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::array<Vec3, 3> corner{mesh.points[mesh.indices[i]], mesh.points[mesh.indices[i + 1]],
                                         mesh.points[mesh.indices[i + 2]]};
        Vec3 low, high;
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min({corner[0][k], corner[1][k], corner[2][k]}) - within;
            high[k] = std::max({corner[0][k], corner[1][k], corner[2][k]}) + within;
        }
        if (points.any(low, high, [&](const Vec3& x) { return holds(corner, x, within); })) return true;
    }
    return false;
}

bool touches(const Sheet& a, const Sheet& b, double within) {
    const auto is_rectangle = [](const Sheet& sheet) {
        return sheet.cloth->start.empty() && sheet.cloth->panel.empty() && !sheet.is_sewn();
    };
    if (!is_rectangle(a) || !is_rectangle(b)) return lies_on(a, b, within) || lies_on(b, a, within);
    return std::ranges::any_of(a.at, [&](const Vec3& x) { return b.holds(x, within); }) ||
           std::ranges::any_of(b.at, [&](const Vec3& x) { return a.holds(x, within); });
}

/// Returns whether the height of the sheet's triangles is below the rounding of positions.
bool is_gathered(const Sheet& sheet) {
    return !(start_height(*sheet.cloth) > sheet.doubt - sheet.cloth->placement.jitter);
}

/// Returns whether a cloth with self-contact crosses itself. If jitter turns no triangle over, as seen along the
/// normal, no triangles can cross.
bool crosses_itself(const Sheet& sheet, const std::vector<std::uint32_t>& same) {
    if (!sheet.cloth->start.empty()) return TriangleCrossings({sheet.mesh()}, same).any();
    return start_height(*sheet.cloth) <= 4 * start_jitter(*sheet.cloth) &&
           TriangleCrossings({sheet.mesh()}, same).any();
}

/// Returns the cover of seams that can be sewn; none of others, which are told elsewhere.
SeamCover cover_of(const SceneDescription& scene) {
    return seam_faults(scene).empty() ? SeamCover(scene) : SeamCover(SceneDescription());
}

/// Returns how two cloths start through each other or on each other, if they do. Those that are sewn, to each other or
/// to others, are not led apart: there is no way that all would go.
std::optional<StartCrossing> crossing_of(const std::vector<Sheet>& sheets, const SeamCover& seams, std::size_t first,
                                         std::size_t second) {
    const Sheet &a = sheets[first], &b = sheets[second];
    const double within = a.doubt + b.doubt;
    if (!boxes_meet(a, b, within)) return std::nullopt;
    const std::vector<std::uint32_t> same =
        seams.are_sewn(first, second) ? seams.joined({first, second}) : std::vector<std::uint32_t>();
    const std::size_t crossings =
        TriangleCrossings({a.mesh(), b.mesh()}, same)
            .count([](std::size_t one, std::size_t other) { return one != other; }, StartCrossing::most_counted);
    if (crossings == 0 && !touches(a, b, within)) return std::nullopt;
    const WayOff off = shorter_way_off(a, b);
    const bool are_free = !a.is_sewn() && !b.is_sewn();
    return StartCrossing{.first = first,
                         .second = second,
                         .triangles = crossings,
                         .depth = std::isfinite(off.depth) ? off.depth : 0,
                         .way = are_free ? off.way : Vec3{}};
}

}  // namespace

bool cloths_meet(const SceneDescription& scene) {
    return std::ranges::any_of(scene.cloths, [](const Cloth& cloth) { return cloth.self_collision.has_value(); });
}

std::vector<StartCrossing> start_crossings(const SceneDescription& scene) {
    const SeamCover seams = cover_of(scene);
    std::vector<Sheet> sheets;
    for (std::size_t cloth = 0; cloth < scene.cloths.size(); ++cloth) sheets.emplace_back(scene, cloth, seams);
    std::vector<StartCrossing> all;
    for (std::size_t cloth = 0; cloth < sheets.size(); ++cloth) {
        if (!scene.cloths[cloth].self_collision) continue;
        const std::vector<std::uint32_t> same =
            sheets[cloth].is_sewn() ? seams.joined({cloth}) : std::vector<std::uint32_t>();
        const bool gathered = is_gathered(sheets[cloth]), crosses = !gathered && crosses_itself(sheets[cloth], same);
        const double untied = gathered || crosses ? 0 : start_untied(scene.cloths[cloth], sheets[cloth].at);
        if (gathered || crosses || untied > 0)
            all.push_back({.first = cloth, .second = cloth, .untied = untied, .gathered = gathered});
    }
    for (std::size_t second = 1; second < sheets.size(); ++second)
        for (std::size_t first = 0; first < second; ++first)
            if (auto crossing = crossing_of(sheets, seams, first, second)) all.push_back(*crossing);
    return all;
}

bool is_refused(const SceneDescription& scene, const StartCrossing& crossing) {
    return crossing.gathered || scene.overlap == Overlap::refuse;
}

bool is_worked_apart(const StartCrossing& crossing) {
    const bool through = crossing.triangles > 0 || crossing.depth > touching_depth;
    return crossing.first != crossing.second && through && length(crossing.way) > 0;
}

bool is_led_apart(const SceneDescription& scene, const StartCrossing& crossing) {
    const bool both_held = !scene.cloths[crossing.first].pins.empty() && !scene.cloths[crossing.second].pins.empty();
    return is_worked_apart(crossing) && !both_held;
}

std::string crossing_text(const SceneDescription& scene, const StartCrossing& crossing) {
    if (crossing.gathered)
        return fmt::format(
            "cloth \"{}\", which meets itself, starts gathered on a line or in a point, where contact would hold it (a "
            "scale away from 0, or no self_collision, would do)",
            scene.cloths[crossing.first].name);
    const std::string& name = scene.cloths[crossing.first].name;
    if (crossing.untied > 0)
        return fmt::format(
            "cloth \"{}\" would start through itself by its jitter: particles start nearer to their places, by up to "
            "{:.3g} m, so that it does not",
            name, crossing.untied);
    if (crossing.first == crossing.second) return fmt::format("cloth \"{}\" starts through itself", name);
    const char *are = crossing.triangles == 1 ? "" : "s", *cross = crossing.triangles == 1 ? "es" : "";
    const std::string off = fmt::format("moved by {:.3g} m one would be off the other", crossing.depth);
    const char* least = crossing.triangles < StartCrossing::most_counted ? "" : "at least ";
    const std::string how = crossing.triangles > 0
                                ? fmt::format("through each other ({}{} pair{} of triangles cross{}; {})", least,
                                              crossing.triangles, are, cross, off)
                            : crossing.depth > touching_depth ? fmt::format("on or through each other ({})", off)
                                                              : "on each other";
    return fmt::format("cloths \"{}\" and \"{}\" start {}", scene.cloths[crossing.first].name,
                       scene.cloths[crossing.second].name, how);
}

}  // namespace drape
