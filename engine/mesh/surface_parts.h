// The parts of a surface, and which way each of them turns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/mesh_mending.h"
#include "mesh/surface_edges.h"

namespace drape {

/// Returns the lower and the upper corner of a box about the triangles' corners, m.
std::pair<Vec3, Vec3> bounds(const Surface& surface, const std::vector<Triangle>& triangles);
/// Returns the surface's area, m^2.
double area(const Surface& surface);
/// Returns the volume that triangles bound, seen from the middle of their bounding box, m^3; negative inside out.
double volume(const Surface& surface, const std::vector<Triangle>& triangles);
/// Returns whether that is less than 1e-9 of the bounding box.
bool bounds_nothing(const Surface& surface);
/// Returns how often triangles wind around a point: the sum of their solid angles over 4 pi (Jacobson, Kavan,
/// Sorkine-Hornung, "Robust Inside-Outside Segmentation using Generalized Winding Numbers", 2013, equations 5 and 6).
double winding_number(const Surface& surface, const std::vector<Triangle>& triangles, const Vec3& at);

/// Triangles that hang together by edges of two triangles are a part. Within one each triangle is turned the way that
/// most are given. Nothing changes before `apply`.
class SurfaceParts {
  public:
    /// The surface must outlive it. `origin`: is added to places in messages, m.
    SurfaceParts(Surface& surface, const Vec3& origin);

    /// Throws MeshError, with the place, where a part has one side.
    void expect_one_way() const;
    /// Returns the sum of what the parts bound, m^3.
    double volume() const;
    void turn_all();
    /// Turns parts over that are inside out, unless an odd number of others is around them: those bound cavities.
    void turn_outwards();
    /// Returns whether, so turned, as many triangles go along each edge one way as the other.
    bool is_closed() const;
    void apply();

    std::size_t count() const { return parts_.size(); }
    /// Returns the number of each triangle's part.
    const std::vector<std::uint32_t>& part_of() const { return part_of_; }
    /// Returns how many triangles are turned against their part.
    std::size_t turned_triangles() const;
    std::size_t turned_parts() const;

  private:
    struct Part {
        std::vector<std::uint32_t> triangles;
        bool turned = false;
        double volume = 0;    ///< m^3, as it is turned
        double least = 0;     ///< m^3: volumes below that are none
        bool bounds = false;  ///< whether its volume says which way it is turned
        Vec3 lower{}, upper{};
    };
    std::vector<Triangle> triangles_of(const Part& part) const;
    bool is_turned(std::uint32_t triangle) const { return turned_[triangle] != 0; }
    void gather();
    bool is_in_cavity(const Part& part, const TriangleTree& tree) const;

    Surface& surface_;
    Vec3 origin_;
    SurfaceEdges edges_;  ///< of the triangles as they are given
    std::vector<Part> parts_;
    std::vector<signed char> turned_;  ///< of each triangle: 1 if it is turned against how it is given
    std::vector<std::uint32_t> part_of_;
};

}  // namespace drape
