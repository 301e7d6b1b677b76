#include "cloth/flat_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <span>
#include <vector>

namespace drape {

namespace {

using Point = std::array<double, 2>;
using Corners = std::span<const std::uint32_t>;

constexpr std::uint32_t reach = 4;  ///< columns and rows within which contact keeps less than the thickness

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
    const double x = b[0] - a[0], y = b[1] - a[1];
    const double along = ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / (x * x + y * y);
    const double part = std::clamp(along, 0.0, 1.0);
    return std::hypot(a[0] + part * x - p[0], a[1] + part * y - p[1]);
}

/// Returns how near the corners of one primitive come to the edges of another. Of flat ones that do not overlap, the
/// nearest points are such a corner and a point of such an edge.
double corners_to_edges(const std::vector<Point>& places, Corners one, Corners other) {
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t corner : one)
        for (std::size_t k = 0; k < other.size(); ++k)
            least = std::min(
                least, distance_to_segment(places[corner], places[other[k]], places[other[(k + 1) % other.size()]]));
    return least;
}

class Flat {
  public:
    explicit Flat(const ClothModel& model) : columns_(model.grid.columns()), rows_(model.grid.rows()) {
        for (std::uint32_t particle = 0; particle < model.grid.particle_count(); ++particle) {
            const Point usual{(particle % columns_) * model.spacing[0], (particle / columns_) * model.spacing[1]};
            const glsl::vec4& at = model.panel[particle];
            places_.push_back({at.x, at.y});
            usual_.push_back(usual);
            const double off = std::hypot(at.x - usual[0], at.y - usual[1]);
            moved_.push_back(off > 1e-5 * std::min(model.spacing[0], model.spacing[1]));
        }
        is_corner_.resize(places_.size());
        triangles_.resize(places_.size());
        edges_.resize(places_.size());
        const std::vector<std::uint32_t> corners = model.grid.triangle_indices();
        for (std::size_t first = 0; first < corners.size(); first += 3) add({&corners[first], 3});
    }

    double least_share() const {
        double least = 1;
        for (std::uint32_t particle = 0; particle < places_.size(); ++particle) {
            if (!has_moved(particle)) continue;
            visit_near(particle, [&](std::uint32_t other) {
                least = std::min({least, share_between(particle, other), share_between(other, particle)});
            });
        }
        return least;
    }

  private:
    struct Primitive {
        std::array<std::uint32_t, 3> corners;
        std::size_t count;
        operator Corners() const { return {corners.data(), count}; }
    };

    void add(Corners triangle) {
        triangles_[triangle[0]].push_back({{triangle[0], triangle[1], triangle[2]}, 3});
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [first, last] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
            std::vector<Primitive>& own = edges_[first];
            const std::uint32_t end = last;
            is_corner_[first] = is_corner_[last] = true;
            if (std::ranges::none_of(own, [end](const Primitive& edge) { return edge.corners[1] == end; }))
                own.push_back({{first, last}, 2});
        }
    }

    /// Visits the particles whose primitives may be at most `reach` from those of a particle, itself included.
    template <class Visit>
    void visit_near(std::uint32_t particle, Visit visit) const {
        const std::uint32_t column = particle % columns_, row = particle / columns_, far = reach + 1;
        for (std::uint32_t y = row > far ? row - far : 0; y <= std::min(row + far, rows_ - 1); ++y)
            for (std::uint32_t x = column > far ? column - far : 0; x <= std::min(column + far, columns_ - 1); ++x)
                visit(y * columns_ + x);
    }

    /// Returns whether a particle, or a corner of a primitive that begins with it, is not where the full grid has it.
    bool has_moved(std::uint32_t particle) const {
        const auto moved = [this](const Primitive& primitive) { return any_moved(primitive); };
        return moved_[particle] || std::ranges::any_of(triangles_[particle], moved) ||
               std::ranges::any_of(edges_[particle], moved);
    }
    bool any_moved(Corners corners) const {
        return std::ranges::any_of(corners, [this](std::uint32_t corner) { return moved_[corner]; });
    }

    /// Returns the least share of the pairs that a particle, or the edges that begin with it, have with the triangles
    /// or edges of another.
    double share_between(std::uint32_t one, std::uint32_t other) const {
        double least = 1;
        const std::uint32_t alone[] = {one};
        if (is_corner_[one])
            for (const Primitive& triangle : triangles_[other]) least = std::min(least, share(alone, triangle));
        for (const Primitive& edge : edges_[one])
            for (const Primitive& beside : edges_[other]) least = std::min(least, share(edge, beside));
        return least;
    }

    double share(Corners one, Corners other) const {
        const auto is_shared = [other](std::uint32_t corner) { return std::ranges::count(other, corner) > 0; };
        if (std::ranges::any_of(one, is_shared)) return 1;
        if (!any_moved(one) && !any_moved(other)) return 1;
        return distance(places_, one, other) / distance(usual_, one, other);
    }

    static double distance(const std::vector<Point>& places, Corners one, Corners other) {
        const double there = corners_to_edges(places, one, other);
        return one.size() == 1 ? there : std::min(there, corners_to_edges(places, other, one));
    }

    std::uint32_t columns_, rows_;
    std::vector<Point> places_, usual_;
    std::vector<bool> moved_;                                ///< the particle is not where the full grid has it
    std::vector<bool> is_corner_;                            ///< of a triangle that exists
    std::vector<std::vector<Primitive>> triangles_, edges_;  ///< by the first of their corners
};

}  // namespace

double least_flat_share(const ClothModel& model) { return model.panel.empty() ? 1 : Flat(model).least_share(); }

}  // namespace drape
