#include "world/seam_sides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "world/rim.h"
#include "world/start.h"

namespace drape {

namespace {

using FlatPoint = std::array<double, 2>;

FlatPoint flat_place(const Cloth& cloth, std::uint32_t particle) {
    if (!cloth.panel.empty()) return cloth.panel[particle];
    const auto [dx, dy] = grid_spacing(cloth);
    const std::uint32_t column = particle % cloth.grid[0], row = particle / cloth.grid[0];
    return {column * dx, row * dy};
}

double way_between(const FlatPoint& a, const FlatPoint& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

std::vector<std::uint32_t> border_particles(const Cloth& cloth, SeamEdge edge) {
    const auto [columns, rows] = cloth.grid;
    const bool upright = edge == SeamEdge::left || edge == SeamEdge::right;
    std::vector<std::uint32_t> particles;
    for (std::uint32_t k = 0; k < (upright ? rows : columns); ++k) switch (edge) {
            case SeamEdge::left:
                particles.push_back(k * columns);
                break;
            case SeamEdge::right:
                particles.push_back(k * columns + columns - 1);
                break;
            case SeamEdge::top:
                particles.push_back(k);
                break;
            case SeamEdge::bottom:
                particles.push_back((rows - 1) * columns + k);
                break;
        }
    return particles;
}

/// A particle on a rim, found near a point.
struct OnRim {
    std::size_t rim, index;
    std::uint32_t particle;
    double away;  ///< m
};

OnRim nearest_on(const std::vector<std::vector<std::uint32_t>>& rims, const Cloth& cloth, const FlatPoint& point) {
    OnRim best{0, 0, 0, std::numeric_limits<double>::infinity()};
    for (std::size_t rim = 0; rim < rims.size(); ++rim)
        for (std::size_t index = 0; index < rims[rim].size(); ++index) {
            const std::uint32_t particle = rims[rim][index];
            const double away = way_between(point, flat_place(cloth, particle));
            if (away < best.away) best = {rim, index, particle, away};
        }
    return best;
}

/// The ends of a piece.
struct Ends {
    std::vector<std::vector<std::uint32_t>> rims;
    OnRim from, to;
};

Ends ends_of(const Cloth& cloth, const SeamSide& side) {
    Ends ends{rims_of(cloth.grid, missing_cells(cloth)), {}, {}};
    const auto find = [&](const FlatPoint& point) {
        return nearest_on(ends.rims, cloth, {point[0] - side.corner[0], point[1] - side.corner[1]});
    };
    ends.from = find(*side.from);
    ends.to = find(*side.to);
    return ends;
}

/// Sets the ways along a side by the lengths between its particles.
SeamRun measured(const Cloth& cloth, std::vector<std::uint32_t> particles) {
    SeamRun run{std::move(particles), {0}};
    for (std::size_t k = 1; k < run.particles.size(); ++k)
        run.ways.push_back(run.ways.back() +
                           way_between(flat_place(cloth, run.particles[k - 1]), flat_place(cloth, run.particles[k])));
    const double whole = run.ways.back();
    for (double& way : run.ways) way /= whole;
    run.length = whole;
    run.ways.back() = 1;
    return run;
}

double length_of(const Cloth& cloth, const std::vector<std::uint32_t>& particles) {
    double whole = 0;
    for (std::size_t k = 1; k < particles.size(); ++k)
        whole += way_between(flat_place(cloth, particles[k - 1]), flat_place(cloth, particles[k]));
    return whole;
}

std::vector<std::uint32_t> piece_between(const Cloth& cloth, const SeamSide& side) {
    const auto [rims, from, to] = ends_of(cloth, side);
    const std::vector<std::uint32_t>& rim = rims[from.rim];
    std::vector<std::uint32_t> onward, back;
    for (std::size_t k = from.index; k != to.index; k = (k + 1) % rim.size()) onward.push_back(rim[k]);
    for (std::size_t k = from.index; k != to.index; k = (k + rim.size() - 1) % rim.size()) back.push_back(rim[k]);
    onward.push_back(to.particle), back.push_back(to.particle);
    const bool onward_is_longer = length_of(cloth, onward) > length_of(cloth, back);
    return onward_is_longer == (side.way == SeamWay::longer) ? onward : back;
}

}  // namespace

SeamRun reversed(SeamRun run) {
    std::ranges::reverse(run.particles);
    std::ranges::reverse(run.ways);
    for (double& way : run.ways) way = 1 - way;
    return run;
}

std::optional<SideFault> side_fault(const Cloth& cloth, const SeamSide& side) {
    if (side.edge.has_value() == (side.from || side.to) || side.from.has_value() != side.to.has_value())
        return SideFault{"", "expected an edge, or two points from and to"};
    if (side.edge) return std::nullopt;
    const Ends ends = ends_of(cloth, side);
    const double most = 0.5 * std::ranges::max(grid_spacing(cloth));
    for (const auto& [end, key] : {std::pair{&ends.from, "/from"}, std::pair{&ends.to, "/to"}})
        if (!(end->away <= most)) {
            const FlatPoint nearest = flat_place(cloth, end->particle);
            return SideFault{
                key, fmt::format("expected a point on the rim of \"{}\", within half a cell of a particle, "
                                 "got one at {:.3g} m from it: the nearest is [{:.6g}, {:.6g}]",
                                 cloth.name, end->away, nearest[0] + side.corner[0], nearest[1] + side.corner[1])};
        }
    if (ends.from.rim != ends.to.rim) return SideFault{"/to", "expected a point on the same rim as from"};
    if (ends.from.index == ends.to.index)
        return SideFault{"/to", "expected a point nearest to another particle than from"};
    return std::nullopt;
}

SeamRun particles_of(const Cloth& cloth, const SeamSide& side) {
    return measured(cloth, side.edge ? border_particles(cloth, *side.edge) : piece_between(cloth, side));
}

}  // namespace drape
