#include "world/panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "world/rim.h"
#include "world/start.h"

namespace drape {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double distance(const PanelPoint& a, const PanelPoint& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

double signed_area(std::span<const PanelPoint> loop) {
    double doubled = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const PanelPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
        doubled += a[0] * b[1] - a[1] * b[0];
    }
    return doubled / 2;
}

/// A curve by the way along it.
class Track {
  public:
    explicit Track(const OutlineCurve& curve) : points_(curve.points), begin_{0} {
        for (std::size_t i = 0; i < points_.size(); ++i) begin_.push_back(begin_[i] + distance(points_[i], after(i)));
    }
    double length() const { return begin_.back(); }
    double at(std::size_t point) const { return begin_[point]; }
    std::span<const PanelPoint> points() const { return points_; }

    struct Nearest {
        double way, distance;
    };
    Nearest nearest(const PanelPoint& point) const {
        Nearest best{0, infinity};
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const PanelPoint &a = points_[i], &b = after(i);
            const double along[2] = {b[0] - a[0], b[1] - a[1]}, piece = begin_[i + 1] - begin_[i];
            if (piece == 0) continue;
            const double dot = (point[0] - a[0]) * along[0] + (point[1] - a[1]) * along[1];
            const double share = std::clamp(dot / (piece * piece), 0.0, 1.0);
            const double off = distance(point, {a[0] + share * along[0], a[1] + share * along[1]});
            if (off < best.distance) best = {begin_[i] + share * piece, off};
        }
        return best;
    }
    PanelPoint place(double way) const {
        way -= length() * std::floor(way / length());
        const auto next = std::upper_bound(begin_.begin() + 1, begin_.end() - 1, way);
        const auto i = static_cast<std::size_t>(next - begin_.begin()) - 1;
        const PanelPoint &a = points_[i], &b = after(i);
        const double piece = begin_[i + 1] - begin_[i], share = piece > 0 ? (way - begin_[i]) / piece : 0;
        return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
    }

  private:
    const PanelPoint& after(std::size_t i) const { return points_[(i + 1) % points_.size()]; }
    std::span<const PanelPoint> points_;
    std::vector<double> begin_;  ///< the way to each point, and at last to the first one again
};

class Fit {
  public:
    Fit(std::span<const OutlineCurve> curves, double spacing, std::uint64_t most_particles);
    FittedPanel take() &&;

  private:
    void find_cells();
    void part_cells_that_share_a_corner();
    void follow_curves();
    void lay(const std::vector<std::uint32_t>& rim, const Track& track, const OutlineCurve& curve);

    std::uint32_t columns() const { return panel_.grid[0]; }
    std::uint32_t rows() const { return panel_.grid[1]; }
    /// Returns the share of a cell that is cloth, 0 outside the grid.
    double& share(std::uint32_t column, std::uint32_t row) {
        return shares_[std::size_t{row} * (columns() - 1) + column];
    }
    bool is_cloth(std::int64_t column, std::int64_t row) const {
        if (column < 0 || row < 0 || column + 1 >= columns() || row + 1 >= rows()) return false;
        return !panel_.missing[static_cast<std::size_t>(row) * (columns() - 1) + static_cast<std::size_t>(column)];
    }

    std::span<const OutlineCurve> curves_;
    double cell_[2];
    std::vector<double> shares_;
    FittedPanel panel_;
};

Fit::Fit(std::span<const OutlineCurve> curves, double spacing, std::uint64_t most_particles) : curves_(curves) {
    PanelPoint low{infinity, infinity}, high{-infinity, -infinity};
    for (const OutlineCurve& curve : curves)
        for (const PanelPoint& point : curve.points)
            for (std::size_t k = 0; k < 2; ++k) {
                low[k] = std::min(low[k], point[k]);
                high[k] = std::max(high[k], point[k]);
            }
    panel_.low = low;
    double count = 1;
    for (std::size_t k = 0; k < 2; ++k) {
        panel_.size[k] = high[k] - low[k];
        const double cells = std::max(1.0, std::round(panel_.size[k] / spacing));
        count *= cells + 1;
        if (!(panel_.size[k] > 0)) throw std::invalid_argument("an outline that goes around something");
        if (!(count <= static_cast<double>(most_particles)))
            throw std::invalid_argument(
                fmt::format("a spacing with which at most {} particles fill the outline's box", most_particles));
        panel_.grid[k] = static_cast<std::uint32_t>(cells) + 1;
        cell_[k] = panel_.size[k] / cells;
    }
    find_cells();
    part_cells_that_share_a_corner();
    if (std::ranges::find(panel_.missing, false) == panel_.missing.end())
        throw std::invalid_argument("a spacing with which half of a cell at least is inside the outline");
    for (std::uint32_t row = 0; row < rows(); ++row)
        for (std::uint32_t column = 0; column < columns(); ++column)
            panel_.places.push_back({column * cell_[0], row * cell_[1]});
    follow_curves();
}

/// Measures along lines across the cells which share of each is inside, exactly along a line.
void Fit::find_cells() {
    constexpr std::uint32_t lines = 16;
    shares_.assign(std::size_t{columns() - 1} * (rows() - 1), 0);
    std::vector<double> crossings;
    for (std::uint32_t line = 0; line < lines * (rows() - 1); ++line) {
        const double y = panel_.low[1] + (line + 0.5) * cell_[1] / lines;
        crossings.clear();
        for (const OutlineCurve& curve : curves_)
            for (std::size_t i = 0; i < curve.points.size(); ++i) {
                const PanelPoint &a = curve.points[i], &b = curve.points[(i + 1) % curve.points.size()];
                if ((a[1] > y) != (b[1] > y)) crossings.push_back(a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
            }
        std::ranges::sort(crossings);
        for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
            const double from = (crossings[i] - panel_.low[0]) / cell_[0],
                         to = (crossings[i + 1] - panel_.low[0]) / cell_[0];
            const auto first = static_cast<std::uint32_t>(std::clamp(from, 0.0, columns() - 2.0));
            for (std::uint32_t column = first; column + 1 < columns() && column < to; ++column)
                share(column, line / lines) +=
                    std::max(0.0, std::min(to, column + 1.0) - std::max<double>(from, column)) / lines;
        }
    }
    for (const double inside : shares_) panel_.missing.push_back(inside < 0.5);
}

/// Takes away the smaller of two cells that meet in a particle alone, which would be a hinge.
void Fit::part_cells_that_share_a_corner() {
    for (bool again = true; again;) {
        again = false;
        for (std::uint32_t row = 1; row + 1 < rows(); ++row)
            for (std::uint32_t column = 1; column + 1 < columns(); ++column) {
                const bool down = is_cloth(column - 1, row - 1) && is_cloth(column, row),
                           up = is_cloth(column, row - 1) && is_cloth(column - 1, row);
                const int count = is_cloth(column - 1, row - 1) + is_cloth(column, row) + is_cloth(column, row - 1) +
                                  is_cloth(column - 1, row);
                if (count != 2 || !(down || up)) continue;
                const std::uint32_t above = down ? column - 1 : column, below = down ? column : column - 1;
                const bool first = share(above, row - 1) < share(below, row);
                const std::size_t cell =
                    first ? std::size_t{row - 1} * (columns() - 1) + above : std::size_t{row} * (columns() - 1) + below;
                panel_.missing[cell] = again = true;
            }
    }
}

/// Lays each rim along the curve that its particles are nearest to.
void Fit::follow_curves() {
    std::vector<OutlineCurve> moved(curves_.begin(), curves_.end());
    for (OutlineCurve& curve : moved)
        for (PanelPoint& point : curve.points) point = {point[0] - panel_.low[0], point[1] - panel_.low[1]};
    std::vector<Track> tracks;
    for (const OutlineCurve& curve : moved) tracks.emplace_back(curve);
    for (const std::vector<std::uint32_t>& rim : rims_of(panel_.grid, panel_.missing)) {
        std::size_t chosen = 0;
        double least = infinity;
        for (std::size_t i = 0; i < tracks.size(); ++i) {
            double farthest = 0;
            for (const std::uint32_t particle : rim)
                farthest = std::max(farthest, tracks[i].nearest(panel_.places[particle]).distance);
            if (farthest < least) least = farthest, chosen = i;
        }
        lay(rim, tracks[chosen], moved[chosen]);
    }
}

void Fit::lay(const std::vector<std::uint32_t>& rim, const Track& track, const OutlineCurve& curve) {
    const auto fault = [&](std::uint32_t particle) {
        const PanelPoint& at = panel_.places[particle];
        return std::invalid_argument(fmt::format(
            "an outline that a grid of this spacing can follow, got one that turns or narrows within a cell near "
            "({:.4g}, {:.4g}) m: a smaller spacing may help",
            at[0] + panel_.low[0], at[1] + panel_.low[1]));
    };
    const std::size_t count = rim.size();
    std::vector<PanelPoint> loop;
    for (const std::uint32_t particle : rim) loop.push_back(panel_.places[particle]);
    const double way_round = signed_area(loop) * signed_area(track.points()) > 0 ? 1 : -1;
    std::vector<double> ways;
    for (const PanelPoint& point : loop) ways.push_back(way_round * track.nearest(point).way);
    std::vector<bool> fixed(count);
    for (const std::size_t corner : curve.corners) {
        std::optional<std::size_t> nearest;
        for (std::size_t i = 0; i < count; ++i)
            if (!fixed[i] &&
                (!nearest || distance(loop[i], curve.points[corner]) < distance(loop[*nearest], curve.points[corner])))
                nearest = i;
        if (!nearest) throw fault(rim.front());
        fixed[*nearest] = true;
        ways[*nearest] = way_round * track.at(corner);
    }
    // Along the rim the way grows by a whole round, and no step goes back beyond what sliding mends.
    double whole = 0;
    std::vector<double> steps(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double step = ways[(i + 1) % count] - ways[i];
        steps[i] = step - track.length() * std::round(step / track.length());
        whole += steps[i];
    }
    if (std::abs(whole - track.length()) > 1e-6 * track.length()) throw fault(rim.front());
    for (std::size_t i = 1; i < count; ++i) ways[i] = ways[i - 1] + steps[i - 1];
    constexpr int rounds = 4;  // more make the cells beside the rim no evener
    for (int i = 0; i < rounds; ++i) {
        const std::vector<double> before = ways;
        for (std::size_t k = 0; k < count; ++k)
            if (!fixed[k])
                ways[k] = ((k > 0 ? before[k - 1] : before[count - 1] - track.length()) +
                           (k + 1 < count ? before[k + 1] : before[0] + track.length())) /
                          2;
    }
    for (std::size_t k = 0; k < count; ++k) {
        if (ways[k] >= (k + 1 < count ? ways[k + 1] : ways[0] + track.length())) throw fault(rim[k]);
        panel_.places[rim[k]] = track.place(way_round * ways[k]);
    }
}

FittedPanel Fit::take() && { return std::move(panel_); }

/// Returns the bit of the triangle of a cell that is too flat over the diagonal, the flatter one of two; 0: there is
/// none.
std::uint32_t sliver_of(const Cloth& cloth, std::size_t cell) {
    constexpr double sliver = 0.1;
    const std::size_t columns = cloth.grid[0], first = cell / (columns - 1) * columns + cell % (columns - 1);
    const PanelPoint &right = cloth.panel[first + 1], &below = cloth.panel[first + columns];
    const PanelPoint upper[] = {cloth.panel[first], right, below},
                     lower[] = {right, cloth.panel[first + columns + 1], below};
    const double diagonal = std::hypot(right[0] - below[0], right[1] - below[1]);
    const double heights[] = {2 * signed_area(upper) / diagonal, 2 * signed_area(lower) / diagonal};
    const auto [dx, dy] = grid_spacing(cloth);
    if (std::min(heights[0], heights[1]) >= sliver * dx * dy / std::hypot(dx, dy)) return 0;
    return heights[0] < heights[1] ? upper_triangle : lower_triangle;
}

}  // namespace

FittedPanel fit_panel(std::span<const OutlineCurve> curves, double spacing, std::uint64_t most_particles) {
    return Fit(curves, spacing, most_particles).take();
}

std::string panel_fault(const Cloth& cloth) {
    constexpr double most = 4;
    const std::size_t columns = cloth.grid[0], count = columns * cloth.grid[1];
    if (cloth.panel.size() != count)
        return fmt::format("a place for each of the {} particles, got {}", count, cloth.panel.size());
    for (const PanelPoint& at : cloth.panel)
        if (!std::isfinite(at[0]) || !std::isfinite(at[1])) return "finite places on the panel";
    const auto unfit = [&](const char* what, std::size_t at, std::size_t in_a_row) {
        return fmt::format("an outline that leaves each cell room, got {} at [{}, {}]: a smaller spacing may help",
                           what, at % in_a_row, at / in_a_row);
    };
    const std::vector<double> areas = cell_areas(cloth);
    for (std::size_t cell = 0; cell < areas.size(); ++cell)
        if (!(areas[cell] > 1 / (most * most))) return unfit("a thin cell", cell, columns - 1);
    const std::vector<std::array<double, 4>> ratios = rest_ratios(cloth);
    for (std::size_t i = 0; i < ratios.size(); ++i)
        for (const double ratio : ratios[i])
            if (!(ratio >= 1 / most && ratio <= most)) return unfit("a short or long edge", i, columns);
    return {};
}

std::vector<double> cell_areas(const Cloth& cloth) {
    if (cloth.panel.empty()) return {};
    const std::vector<bool> missing = missing_cells(cloth);
    const std::size_t columns = cloth.grid[0], cells = columns - 1;
    const auto [dx, dy] = grid_spacing(cloth);
    std::vector<double> areas(missing.size(), 1);
    for (std::size_t cell = 0; cell < missing.size(); ++cell) {
        if (missing[cell]) continue;
        const std::size_t first = cell / cells * columns + cell % cells;
        const PanelPoint corners[] = {cloth.panel[first], cloth.panel[first + 1], cloth.panel[first + columns + 1],
                                      cloth.panel[first + columns]};
        areas[cell] = signed_area(corners) / (dx * dy);
    }
    return areas;
}

std::vector<std::uint32_t> cell_triangles(const Cloth& cloth) {
    const std::vector<bool> missing = missing_cells(cloth);
    std::vector<std::uint32_t> triangles(missing.size());
    for (std::size_t cell = 0; cell < missing.size(); ++cell)
        if (!missing[cell])
            triangles[cell] = (upper_triangle | lower_triangle) & ~(cloth.panel.empty() ? 0 : sliver_of(cloth, cell));
    return triangles;
}

std::vector<std::array<double, 4>> shape_factors(const Cloth& cloth) {
    std::vector<std::array<double, 4>> factors = rest_ratios(cloth);
    for (std::array<double, 4>& each : factors)
        for (double& factor : each) factor = 1 / (factor * factor);
    return factors;
}

double stiffest_shape(const Cloth& cloth) {
    const std::vector<double> areas = cell_areas(cloth);
    const std::vector<bool> missing = missing_cells(cloth);
    const std::vector<std::array<double, 4>> factors = shape_factors(cloth);
    const std::size_t columns = cloth.grid[0], cells = columns - 1;
    double stiffest = 0;
    for (std::size_t cell = 0; cell < areas.size(); ++cell) {
        if (missing[cell]) continue;
        const std::size_t first = cell / cells * columns + cell % cells, below = first + columns;
        for (const double factor : {factors[first][0], factors[below][0], factors[first][1], factors[first + 1][1],
                                    factors[first][2], factors[first + 1][3]})
            stiffest = std::max(stiffest, areas[cell] * factor);
    }
    return stiffest;
}

}  // namespace drape
