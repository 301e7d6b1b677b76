// A triangle mesh as a body that cloth stays outside of, in its own frame.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mesh/triangle_tree.h"

namespace drape {

/// A closed surface bounds a solid body. An open surface is a shell: everything within half its thickness.
class MeshShape {
  public:
    /// Corners in the same place become one, triangles without an area go. `vertices` are in metres. A closed surface
    /// whose triangles do not turn one way is turned so, and one that is inside out is turned over. Throws MeshError
    /// where that is impossible, where nothing is left, and for an open surface without `shell`, its thickness in m.
    /// `places`: becomes the number of the shape's vertex at each one given.
    MeshShape(const std::vector<Vec3>& vertices, std::vector<Triangle> triangles, std::optional<double> shell,
              std::vector<std::uint32_t>* places = nullptr);
    /// The same surface with its vertices elsewhere, in the frame of those that `form` was made of, m. `lower` and
    /// `upper`: corners of a box that takes the place of its bounding box.
    MeshShape(const MeshShape& form, std::vector<Vec3> vertices, const Vec3& lower, const Vec3& upper);
    /// The same in the middle and with the bounding box that `form` has.
    MeshShape(const MeshShape& form, std::vector<Vec3> vertices);
    MeshShape(const MeshShape&) = delete;

    /// The origin is the middle of the bounding box, m.
    const std::vector<Vec3>& vertices() const { return vertices_; }
    const std::vector<Triangle>& triangles() const { return triangles_; }
    /// Returns where the middle is in the frame of the vertices that it was made of, m.
    const Vec3& middle() const { return middle_; }
    /// Returns half of the bounding box's edges, m, with half of a shell's thickness.
    const Vec3& half_extents() const { return half_extents_; }
    double shell() const { return shell_; }  ///< m; 0: the surface is closed
    /// Returns how far the surface is from the innermost of some 10,000 points, m: half of what the body is thick.
    double inner_radius() const { return inner_radius_; }

    /// Returns the distance to the surface, negative inside, m, computed from the triangles themselves.
    double distance(const Vec3& local) const;
    /// Returns the distance at points on a line along x, from `first` on by `step`, m. Beyond `exact_within` it may be
    /// up to 2 % too large.
    void distances(const Vec3& first, double step, double exact_within, std::vector<double>& row) const;
    /// Returns which of so many points of a line along x are inside a closed surface; none of a shell.
    std::vector<bool> inside(const Vec3& first, double step, std::size_t count) const;
    const TriangleTree& tree() const { return *tree_; }
    /// Returns the volume within a closed surface, m^3; negative if the surface is inside out.
    double volume() const;

  private:
    void weld(const std::vector<Vec3>& given, std::vector<std::uint32_t>* places);
    void center();
    void close_or_thicken(std::optional<double> shell);
    void find_inner_radius();

    std::vector<Vec3> vertices_;
    std::vector<Triangle> triangles_;
    Vec3 middle_{}, half_extents_{};
    double shell_ = 0, inner_radius_ = 0;
    std::optional<TriangleTree> tree_;
};

}  // namespace drape
