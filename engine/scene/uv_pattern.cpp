#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "base/vectors.h"
#include "input/obj_file.h"
#include "scene/sewing_panels.h"

namespace drape {
namespace {

/// A corner of triangles: a vertex of the mesh where an island has it.
struct Corner {
    std::uint32_t vertex;
    PatternPoint uv;
    auto key() const { return std::tie(vertex, uv); }
    bool operator<(const Corner& other) const { return key() < other.key(); }
};

using Directed = std::pair<std::size_t, std::size_t>;  ///< from one corner to another

/// The islands of a mesh: triangles that share edges on the texture, each with the loops of its rim.
struct Islands {
    std::vector<Corner> corners;
    std::vector<std::array<std::size_t, 3>> triangles;        ///< of corners
    std::vector<std::size_t> island;                          ///< by triangle
    std::vector<std::vector<std::vector<std::size_t>>> rims;  ///< by island: loops of corners
};

/// Where an edge of a rim is.
struct RimEdge {
    std::size_t island, loop, number;
    auto key() const { return std::tie(island, loop, number); }
    bool operator<(const RimEdge& other) const { return key() < other.key(); }
    bool operator==(const RimEdge& other) const { return key() == other.key(); }
};

std::size_t root_of(std::vector<std::size_t>& parents, std::size_t node) {
    while (parents[node] != node) node = parents[node] = parents[parents[node]];
    return node;
}

/// Welds corners that are one on mesh and texture, and leaves out triangles without an area on the texture.
void weld(const input::UvMesh& mesh, Islands& islands) {
    std::map<Corner, std::size_t> known;
    for (std::size_t t = 0; t < mesh.shape.triangles.size(); ++t) {
        std::array<std::size_t, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& at = mesh.chart.vertices[mesh.chart.triangles[t][k]];
            const Corner corner{mesh.shape.triangles[t][k], {at[0], at[1]}};
            const auto [found, fresh] = known.try_emplace(corner, islands.corners.size());
            if (fresh) islands.corners.push_back(corner);
            triangle[k] = found->second;
        }
        const PatternPoint &a = islands.corners[triangle[0]].uv, &b = islands.corners[triangle[1]].uv,
                           &c = islands.corners[triangle[2]].uv;
        if ((b[0] - a[0]) * (c[1] - a[1]) != (b[1] - a[1]) * (c[0] - a[0])) islands.triangles.push_back(triangle);
    }
}

std::string place_text(const PatternPoint& uv) { return fmt::format("{:.6g}, {:.6g}", uv[0], uv[1]); }

/// Returns the edges that one triangle alone has, by their first corner.
std::map<std::size_t, std::size_t> open_edges(const Islands& islands, std::vector<std::size_t>& parents) {
    std::map<Directed, std::size_t> edges;
    for (std::size_t t = 0; t < islands.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const Directed edge{islands.triangles[t][k], islands.triangles[t][(k + 1) % 3]};
            if (!edges.emplace(edge, t).second)
                throw Error(
                    fmt::format("expected islands of the texture whose triangles lie side by side, got two on "
                                "the same side of an edge, at {}",
                                place_text(islands.corners[edge.first].uv)));
        }
    std::map<std::size_t, std::size_t> open;
    for (const auto& [edge, triangle] : edges) {
        const auto other = edges.find({edge.second, edge.first});
        if (other != edges.end())
            parents[root_of(parents, triangle)] = root_of(parents, other->second);
        else if (!open.emplace(edge).second)
            throw Error(
                fmt::format("expected islands of the texture that do not touch themselves at a point, got one "
                            "that does, at {}",
                            place_text(islands.corners[edge.first].uv)));
    }
    return open;
}

Islands find_islands(const input::UvMesh& mesh) {
    Islands islands;
    weld(mesh, islands);
    std::vector<std::size_t> parents(islands.triangles.size());
    std::iota(parents.begin(), parents.end(), std::size_t{0});
    std::map<std::size_t, std::size_t> open = open_edges(islands, parents), numbers;
    std::vector<std::size_t> island_of_corner(islands.corners.size());
    for (std::size_t t = 0; t < islands.triangles.size(); ++t) {
        const std::size_t number = numbers.try_emplace(root_of(parents, t), numbers.size()).first->second;
        islands.island.push_back(number);
        for (const std::size_t corner : islands.triangles[t]) island_of_corner[corner] = number;
    }
    islands.rims.resize(numbers.size());
    // As many edges of a rim end at a corner as begin there, which is one: so they make loops.
    while (!open.empty()) {
        std::vector<std::size_t> loop;
        std::size_t corner = open.begin()->first;
        do {
            loop.push_back(corner);
            corner = open.extract(corner).mapped();
        } while (corner != loop.front());
        islands.rims[island_of_corner[loop.front()]].push_back(loop);
    }
    return islands;
}

Vec3 vertex_of(const input::UvMesh& mesh, const Islands& islands, std::size_t corner) {
    return mesh.shape.vertices[islands.corners[corner].vertex];
}

/// What the triangles of an island have in common.
struct Extent {
    double area = 0, flat_area = 0;  ///< of the mesh; of the texture, below 0 where it is turned over
    Vec3 centre{};
    PatternPoint flat_centre{};
};

double flat_area(const Islands& islands, const std::array<std::size_t, 3>& triangle) {
    const PatternPoint &a = islands.corners[triangle[0]].uv, &b = islands.corners[triangle[1]].uv,
                       &c = islands.corners[triangle[2]].uv;
    return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
}

std::vector<Extent> extents_of(const input::UvMesh& mesh, const Islands& islands) {
    std::vector<Extent> extents(islands.rims.size());
    for (std::size_t t = 0; t < islands.triangles.size(); ++t) {
        Extent& extent = extents[islands.island[t]];
        const auto& triangle = islands.triangles[t];
        const Vec3 a = vertex_of(mesh, islands, triangle[0]);
        const double flat = flat_area(islands, triangle);
        extent.area += length(cross(minus(vertex_of(mesh, islands, triangle[1]), a),
                                    minus(vertex_of(mesh, islands, triangle[2]), a))) /
                       2;
        extent.flat_area += flat;
        for (const std::size_t corner : triangle) {
            const PatternPoint& uv = islands.corners[corner].uv;
            extent.centre = plus(extent.centre, times(flat / 3, vertex_of(mesh, islands, corner)));
            for (std::size_t k = 0; k < 2; ++k) extent.flat_centre[k] += flat / 3 * uv[k];
        }
    }
    for (Extent& extent : extents) {
        if (extent.flat_area == 0) throw Error("expected islands of the texture that are not folded on themselves");
        extent.centre = times(1 / extent.flat_area, extent.centre);
        for (double& x : extent.flat_centre) x /= extent.flat_area;
    }
    return extents;
}

/// Returns the axes u and v, square to each other, of the flat island that is nearest to the mesh: of the sums a = sum
/// w x p and b = sum w y p over places p and flat places (x, y), the orthogonal factor of the polar decomposition.
std::array<Vec3, 2> nearest_axes(const Vec3& a, const Vec3& b) {
    const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), root = std::sqrt(std::max(aa * bb - ab * ab, 0.0));
    const double trace = aa + bb + 2 * root;
    // The square root of [[aa, ab], [ab, bb]] is that matrix with `root` added to its diagonal, over sqrt(trace).
    const double determinant = (aa + root) * (bb + root) - ab * ab;
    if (!(root > 1e-9 * trace)) return {Vec3{1, 0, 0}, Vec3{0, 1, 0}};
    const double factor = std::sqrt(trace) / determinant;
    return {times(factor, minus(times(bb + root, a), times(ab, b))),
            times(factor, minus(times(aa + root, b), times(ab, a)))};
}

/// The panels of a mesh, in metres.
class Panels {
  public:
    Panels(const input::UvMesh& mesh, const Islands& islands)
        : mesh_(mesh), islands_(islands), extents_(extents_of(mesh, islands)) {
        double area = 0, flat = 0;
        for (const Extent& extent : extents_) {
            area += extent.area;
            flat += std::abs(extent.flat_area);
        }
        metres_ = std::sqrt(area / flat);
        if (!std::isfinite(metres_) || metres_ <= 0)
            throw Error("expected triangles that a texture lays out flat, got none with an area on both");
        place_panels();
    }
    std::vector<PatternPanel> panels() const {
        std::vector<PatternPanel> panels;
        for (std::size_t i = 0; i < extents_.size(); ++i) {
            PatternPanel& panel = panels.emplace_back();
            panel.name = fmt::format("panel_{}", i + 1);
            panel.placement = placements_[i];
            for (const std::vector<std::size_t>& rim : islands_.rims[i]) panel.loops.push_back(edges(i, rim));
        }
        return panels;
    }
    double metres() const { return metres_; }

  private:
    /// Returns where a corner is on its panel. Those that the texture has turned over are turned back.
    PatternPoint place(std::size_t island, std::size_t corner) const {
        const PatternPoint &uv = islands_.corners[corner].uv, &centre = extents_[island].flat_centre;
        const double mirror = extents_[island].flat_area < 0 ? -1 : 1;
        return {mirror * metres_ * (uv[0] - centre[0]), metres_ * (uv[1] - centre[1])};
    }
    std::vector<PatternEdge> edges(std::size_t island, const std::vector<std::size_t>& rim) const {
        std::vector<PatternEdge> edges;
        for (std::size_t i = 0; i < rim.size(); ++i) {
            const PatternPoint from = place(island, rim[i]), to = place(island, rim[(i + 1) % rim.size()]);
            edges.push_back({from, to, "L" + path_point(to), std::hypot(to[0] - from[0], to[1] - from[1])});
        }
        return edges;
    }
    void place_panels() {
        // The integral of x p over a triangle of area A is A/12 (sum x sum p + sum x p), the sums over its corners.
        std::vector<std::array<Vec3, 2>> sums(extents_.size());
        for (std::size_t t = 0; t < islands_.triangles.size(); ++t) {
            const std::size_t island = islands_.island[t];
            const double weight = std::abs(flat_area(islands_, islands_.triangles[t])) / 12;
            Vec3 p_sum{};
            PatternPoint q_sum{};
            const auto add = [&](const PatternPoint& q, const Vec3& p) {
                for (std::size_t k = 0; k < 2; ++k) sums[island][k] = plus(sums[island][k], times(weight * q[k], p));
            };
            for (const std::size_t corner : islands_.triangles[t]) {
                const Vec3 p = minus(vertex_of(mesh_, islands_, corner), extents_[island].centre);
                const PatternPoint q = place(island, corner);
                add(q, p);
                p_sum = plus(p_sum, p);
                for (std::size_t k = 0; k < 2; ++k) q_sum[k] += q[k];
            }
            add(q_sum, p_sum);
        }
        for (std::size_t i = 0; i < extents_.size(); ++i) {
            const auto [u, v] = nearest_axes(sums[i][0], sums[i][1]);
            placements_.push_back({extents_[i].centre, u, v});
        }
    }

    const input::UvMesh& mesh_;
    const Islands& islands_;
    std::vector<Extent> extents_;
    std::vector<Placement> placements_;
    double metres_;  ///< of a unit of the texture
};

/// Finds the seams: runs of edges of rims that are the same edges of the mesh.
class Seams {
  public:
    explicit Seams(const Islands& islands) : islands_(islands) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<RimEdge>> sharers;
        for (std::size_t i = 0; i < islands.rims.size(); ++i)
            for (std::size_t l = 0; l < islands.rims[i].size(); ++l)
                for (std::size_t n = 0; n < islands.rims[i][l].size(); ++n) {
                    const auto [from, to] = ends({i, l, n});
                    sharers[{std::min(from, to), std::max(from, to)}].push_back({i, l, n});
                }
        // Of more than two, which meet as the panels of a star do, each is sewn to the first one.
        for (const auto& [ends, edges] : sharers)
            for (std::size_t k = 1; k < edges.size(); ++k) pairs_.emplace(edges[0], edges[k]);
    }
    std::vector<PatternSeam> seams() {
        std::vector<PatternSeam> seams;
        while (!pairs_.empty()) {
            const auto [a, b] = *pairs_.begin();
            const int step = ends(a).first == ends(b).first ? 1 : -1;
            take(a, b);
            std::size_t after = 0, before = 0;
            while (take(moved(a, 1 + static_cast<int>(after)), moved(b, step * (1 + static_cast<int>(after))))) ++after;
            while (take(moved(a, -1 - static_cast<int>(before)), moved(b, -step * (1 + static_cast<int>(before)))))
                ++before;
            add(moved(a, -static_cast<int>(before)), moved(b, -step * static_cast<int>(before)), step,
                after + before + 1, seams);
        }
        return seams;
    }

  private:
    std::size_t size(const RimEdge& edge) const { return islands_.rims[edge.island][edge.loop].size(); }
    std::pair<std::uint32_t, std::uint32_t> ends(const RimEdge& edge) const {
        const std::vector<std::size_t>& rim = islands_.rims[edge.island][edge.loop];
        return {islands_.corners[rim[edge.number]].vertex,
                islands_.corners[rim[(edge.number + 1) % rim.size()]].vertex};
    }
    RimEdge moved(const RimEdge& edge, int by) const {
        const auto count = static_cast<int>(size(edge));
        return {edge.island, edge.loop,
                static_cast<std::size_t>(((static_cast<int>(edge.number) + by) % count + count) % count)};
    }
    /// Takes a pair, in either order, out of those that are left.
    bool take(const RimEdge& a, const RimEdge& b) { return pairs_.erase({a, b}) > 0 || pairs_.erase({b, a}) > 0; }
    /// Adds a run. One that goes all the way round has no ends, so it becomes two.
    void add(const RimEdge& a, const RimEdge& b, int step, std::size_t count, std::vector<PatternSeam>& seams) const {
        const std::size_t most = std::min(size(a), size(b)), first = count < most ? count : count / 2;
        seams.push_back({{a.island, a.loop, a.number, first, 1}, {b.island, b.loop, b.number, first, step}});
        if (first == count) return;
        const auto by = static_cast<int>(first);
        seams.push_back({{a.island, a.loop, moved(a, by).number, count - first, 1},
                         {b.island, b.loop, moved(b, step * by).number, count - first, step}});
    }

    const Islands& islands_;
    std::set<std::pair<RimEdge, RimEdge>> pairs_;
};

}  // namespace

PatternResult read_uv_pattern(const std::string& path, const PatternOptions& options) {
    PatternResult result;
    const input::UvMesh mesh = input::read_obj_with_uv(path);
    try {
        const Islands islands = find_islands(mesh);
        const Panels panels(mesh, islands);
        result.metres_per_unit = panels.metres();
        write_pattern_scene(panels.panels(), Seams(islands).seams(), options, result);
    } catch (const Error& error) {
        result.errors.push_back({path, 0, 0, "", error.what()});
    }
    return result;
}

}  // namespace drape
