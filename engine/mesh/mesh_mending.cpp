#include "mesh/mesh_mending.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "base/vectors.h"
#include "mesh/surface_edges.h"
#include "mesh/surface_parts.h"

namespace drape {

namespace {

/// A hole with more edges than this stays open, since closing it takes their number squared.
constexpr std::size_t most_hole_edges = 10'000;
constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

std::size_t open_edges(const std::vector<Triangle>& triangles) {
    std::size_t open = 0;
    SurfaceEdges(triangles).each([&](std::span<const SurfaceEdges::Use> uses) { open += uses.size() % 2; });
    return open;
}

bool has_corner_twice(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

double bounding_diagonal(const Surface& surface) {
    const auto& [lower, upper] = bounds(surface, surface.triangles);
    return distance(lower, upper);
}

/// Finds points that lie near one of those before.
class NearPoints {
  public:
    NearPoints(const std::vector<Vec3>& points, double within) : points_(points), within_(within) {}

    /// Returns the first one within the distance, of those that were asked for before, or itself.
    std::uint32_t first_near(std::uint32_t point) {
        std::uint32_t found = point;
        const Cell own = cell(points_[point]);
        for (int k = 0; k < 27; ++k)
            if (const auto at = cells_.find({own[0] + k % 3 - 1, own[1] + k / 3 % 3 - 1, own[2] + k / 9 - 1});
                at != cells_.end())
                for (const std::uint32_t other : at->second)
                    if (distance(points_[other], points_[point]) <= within_) found = std::min(found, other);
        if (found == point) cells_[own].push_back(point);
        return found;
    }

  private:
    using Cell = std::array<std::int64_t, 3>;
    Cell cell(const Vec3& at) const {
        Cell cell;
        for (std::size_t axis = 0; axis < 3; ++axis)
            cell[axis] = static_cast<std::int64_t>(std::floor(at[axis] / within_));
        return cell;
    }

    const std::vector<Vec3>& points_;
    double within_;
    std::map<Cell, std::vector<std::uint32_t>> cells_;
};

/// Makes vertices of open edges one that lie within the tolerance of each other.
void weld_open(Surface& surface, Mending& done, std::vector<std::uint32_t>& places) {
    std::set<std::uint32_t> open;
    SurfaceEdges(surface.triangles).each([&](std::span<const SurfaceEdges::Use> uses) {
        if (uses.size() % 2 != 0) open.insert({uses[0].edge.first, uses[0].edge.second});
    });
    std::vector<std::uint32_t> one(surface.vertices.size());
    std::iota(one.begin(), one.end(), 0u);
    NearPoints near(surface.vertices, done.tolerance);
    for (const std::uint32_t vertex : open) {
        one[vertex] = near.first_near(vertex);
        done.welded += one[vertex] != vertex;
    }
    if (done.welded == 0) return;
    std::vector<std::uint32_t> number(one.size(), nowhere);
    std::vector<Vec3> kept;
    for (std::uint32_t k = 0; k < one.size(); ++k)
        if (one[k] == k) {
            number[k] = static_cast<std::uint32_t>(kept.size());
            kept.push_back(surface.vertices[k]);
        }
    for (std::uint32_t& each : one) each = number[each];
    surface.vertices = std::move(kept);
    for (Triangle& triangle : surface.triangles)
        for (std::uint32_t& corner : triangle) corner = one[corner];
    for (std::uint32_t& place : places) place = one[place];
    std::erase_if(surface.triangles, has_corner_twice);
}

/// Leaves one of the triangles that have the same corners; returns whether there were others.
bool leave_single(std::vector<Triangle>& triangles, Mending& done) {
    std::set<Triangle> seen;
    const std::size_t left = std::erase_if(triangles, [&](Triangle triangle) {
        std::ranges::sort(triangle);
        return !seen.insert(triangle).second;
    });
    done.doubled += left;
    return left > 0;
}

/// Welds where edges are open, and where some still are leaves single triangles.
void join_edges(Surface& surface, Mending& done, std::vector<std::uint32_t>& places) {
    if (open_edges(surface.triangles) == 0) return;
    if (done.tolerance > 0) weld_open(surface, done, places);
    if (open_edges(surface.triangles) > 0) leave_single(surface.triangles, done);
}

/// How a surface's parts were turned.
struct Turning {
    std::vector<std::uint32_t> part_of;  ///< each triangle's part
    bool closed;                         ///< no edge is open then
};

Turning turn_parts(Surface& surface, const Vec3& origin, Mending& done) {
    SurfaceParts parts(surface, origin);
    parts.expect_one_way();
    if (parts.volume() < 0) parts.turn_all();
    parts.turn_outwards();
    done.turned += parts.turned_triangles();
    done.parts = parts.count();
    done.turned_parts = parts.turned_parts();
    const bool closed = parts.is_closed();
    parts.apply();
    return {parts.part_of(), closed};
}

/// Cuts the chain of open edges into rings, none of which comes through a vertex twice.
std::vector<Hole> rings_of(const std::vector<Triangle>& triangles) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> ways;
    SurfaceEdges(triangles).each([&](std::span<const SurfaceEdges::Use> uses) {
        auto [from, to] = uses[0].edge;
        const int net = SurfaceEdges::net(uses);
        if (net < 0) std::swap(from, to);
        ways[from].insert(ways[from].end(), static_cast<std::size_t>(std::abs(net)), to);
    });
    std::vector<Hole> holes;
    for (auto& start : ways)
        while (!start.second.empty()) {
            // As many edges lead to a vertex as away from it, so the way ends where it began.
            std::vector<std::uint32_t> path{start.first};
            std::map<std::uint32_t, std::size_t> on_path{{start.first, 0}};
            do {
                std::vector<std::uint32_t>& next = ways.at(path.back());
                const std::uint32_t vertex = next.back();
                next.pop_back();
                if (const auto met = on_path.find(vertex); met != on_path.end()) {
                    const auto first = path.begin() + static_cast<std::ptrdiff_t>(met->second);
                    holes.push_back({{first, path.end()}});
                    for (auto each = first + 1; each != path.end(); ++each) on_path.erase(*each);
                    path.erase(first + 1, path.end());
                } else {
                    on_path[vertex] = path.size();
                    path.push_back(vertex);
                }
            } while (path.size() > 1);
        }
    return holes;
}

/// Closes the holes that are small, or all of them; the edges of the others stay open.
void close_holes(Surface& surface, Solid solid, Mending& done) {
    const double most = small_hole * area(surface);
    for (Hole& hole : rings_of(surface.triangles)) {
        const bool closes = hole.ring.size() <= most_hole_edges;
        const std::vector<Triangle> lid = closes ? closing(hole, surface.vertices) : std::vector<Triangle>{};
        if (closes && (solid == Solid::filled || hole.area <= most)) {
            surface.triangles.insert(surface.triangles.end(), lid.begin(), lid.end());
            done.closed.push_back(std::move(hole));
        } else {
            for (std::size_t k = 0; k < hole.ring.size(); ++k)
                done.rim.push_back({hole.ring[k], hole.ring[(k + 1) % hole.ring.size()]});
        }
    }
    std::ranges::stable_sort(done.closed, std::ranges::greater(), &Hole::area);
}

/// Returns the part of a triangle that has an edge, for each of the edges.
std::map<std::array<std::uint32_t, 2>, std::uint32_t> parts_of_edges(
    const Surface& surface, const std::vector<std::uint32_t>& part_of,
    const std::vector<std::array<std::uint32_t, 2>>& edges) {
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> parts;
    for (const auto& edge : edges) parts[edge] = nowhere;
    for (std::size_t k = 0; k < part_of.size(); ++k)
        for (std::size_t corner = 0; corner < 3; ++corner)
            if (const auto found = parts.find({surface.triangles[k][corner], surface.triangles[k][(corner + 1) % 3]});
                found != parts.end() && found->second == nowhere)
                found->second = part_of[k];
    return parts;
}

/// Throws MeshError where an open edge is far from all parts but its own.
void expect_gaps(const Surface& surface, const Vec3& origin, double gap, const std::vector<std::uint32_t>& part_of,
                 const std::vector<std::array<std::uint32_t, 2>>& rim) {
    constexpr std::size_t most_work = 50'000'000;
    const auto middle = [&](const auto& edge) {
        return times(0.5, plus(surface.vertices[edge[0]], surface.vertices[edge[1]]));
    };
    std::map<std::uint32_t, std::vector<Vec3>> open;  // by part, the middles of its open edges
    const std::map<std::array<std::uint32_t, 2>, std::uint32_t> parts = parts_of_edges(surface, part_of, rim);
    for (const auto& edge : rim) open[parts.at(edge)].push_back(middle(edge));
    if (open.size() * surface.triangles.size() > most_work) throw too_open(rim.size(), plus(origin, middle(rim[0])));
    for (const auto& [part, places] : open) {
        std::vector<Triangle> others;
        for (std::size_t k = 0; k < surface.triangles.size(); ++k)
            if (k >= part_of.size() || part_of[k] != part) others.push_back(surface.triangles[k]);
        const TriangleTree tree(surface.vertices, others);
        std::uint32_t nearest = 0;
        for (const Vec3& at : places)
            if (others.empty() || !(tree.distance(at, gap, nearest) <= gap))
                throw too_open(rim.size(), plus(origin, at));
    }
}

void expect_closed(const std::vector<Triangle>& triangles) {
    if (const std::size_t open = open_edges(triangles); open > 0)
        throw MeshError(
            fmt::format("expected a closed surface, got one with {} edges of one triangle alone: give "
                        "\"shell\", its thickness in metres, if it is to be a thin wall",
                        open));
}

/// Throws MeshError where more than two triangles meet and not as many go one way as the other.
void expect_balance(const Surface& surface, const Vec3& origin) {
    SurfaceEdges(surface.triangles).each([&](std::span<const SurfaceEdges::Use> uses) {
        if (SurfaceEdges::net(uses) == 0) return;
        const auto [from, to] = uses[0].edge;
        const Vec3 at = plus(origin, times(0.5, plus(surface.vertices[from], surface.vertices[to])));
        throw MeshError(
            fmt::format("expected triangles that all turn one way seen from outside, got {} that cannot at an edge at "
                        "({:.6g}, {:.6g}, {:.6g}) m: more than two triangles meet there",
                        uses.size(), at[0], at[1], at[2]));
    });
}

/// A surface as a strict body's: parts go one way, and the whole is turned over where it is inside out.
Mending turn_strictly(Surface& surface, const Vec3& origin) {
    expect_closed(surface.triangles);
    SurfaceParts parts(surface, origin);
    parts.expect_one_way();
    if (parts.volume() < 0) parts.turn_all();
    parts.apply();
    expect_balance(surface, origin);
    return {};
}

std::string counted(std::size_t count, std::string_view one, std::string_view more) {
    return fmt::format("{} {}", count, count == 1 ? one : more);
}

std::string holes_text(const std::vector<Hole>& holes) {
    constexpr std::size_t told = 3;
    std::string text = counted(holes.size(), "hole closed (", "holes closed (");
    for (std::size_t k = 0; k < std::min(told, holes.size()); ++k)
        text += fmt::format("{}{} edges, {:.3g} m^2", k > 0 ? "; " : "", holes[k].ring.size(), holes[k].area);
    if (holes.size() <= told) return text + ")";
    double area = 0;
    for (std::size_t k = told; k < holes.size(); ++k) area += holes[k].area;
    return text + fmt::format("; the others {:.3g} m^2)", area);
}

}  // namespace

MeshError too_open(std::size_t edges, const Vec3& at) {
    return MeshError(fmt::format(
        "expected a closed surface, got one with {} edges of one triangle alone, one at ({:.6g}, {:.6g}, "
        "{:.6g}) m, around holes of more than {:.0f} % of its area or {} edges: give \"shell\", its thickness in "
        "metres, if it is to be a thin wall, or \"solid\": \"filled\" for a body whose holes are all closed",
        edges, at[0], at[1], at[2], 100 * small_hole, most_hole_edges));
}

std::string Mending::text() const {
    std::vector<std::string> said;
    if (welded > 0)
        said.push_back(counted(welded, "vertex", "vertices") +
                       fmt::format(" within {:.2g} m of another welded", tolerance));
    if (doubled > 0) said.push_back(counted(doubled, "triangle", "triangles") + " in the place of another left out");
    if (turned > 0) said.push_back(counted(turned, "triangle", "triangles") + " turned as the others of the part");
    if (turned_parts > 0)
        said.push_back(fmt::format("{} of {} turned over", turned_parts, counted(parts, "part", "parts")));
    if (!closed.empty()) said.push_back(holes_text(closed));
    if (!rim.empty())
        said.push_back(counted(rim.size(), "edge stays", "edges stay") +
                       " open: inside is what the surface winds around by more than a half");
    return fmt::format("{}", fmt::join(said, ", "));
}

Mending mend(Surface& surface, Solid solid, const Vec3& origin, std::vector<std::uint32_t>& places) {
    if (solid == Solid::strict) return turn_strictly(surface, origin);
    Mending done;
    done.tolerance = weld_share * bounding_diagonal(surface);
    join_edges(surface, done, places);
    Turning turning = turn_parts(surface, origin, done);
    // Where each triangle has one on its back, no two are a part, and no edge seems open.
    if ((bounds_nothing(surface) || !turning.closed) && leave_single(surface.triangles, done)) {
        join_edges(surface, done, places);
        turning = turn_parts(surface, origin, done);
    }
    if (turning.closed) return done;
    close_holes(surface, solid, done);
    if (!done.rim.empty())
        expect_gaps(surface, origin, gap_share / weld_share * done.tolerance, turning.part_of, done.rim);
    return done;
}

}  // namespace drape
