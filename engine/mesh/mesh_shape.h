// A triangle mesh as a body that cloth stays outside of, in its own frame.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh_mending.h"
#include "mesh/triangle_tree.h"

namespace drape {

/// A surface bounds a solid body, or is a shell: everything within half its thickness.
class MeshShape {
  public:
    /// Corners in the same place become one, triangles without an area go. `vertices` are in metres. Without `shell`,
    /// a thickness in m, the surface is made a body's (mesh_mending.h). Throws MeshError where that is impossible,
    /// where nothing is left, and where what stays open leaves it unclear what is inside: where the winding number is
    /// between 1/4 and 3/4 at more than a twentieth as many points as are inside. `places`: becomes the number of the
    /// shape's vertex at each one given.
    MeshShape(const std::vector<Vec3>& vertices, std::vector<Triangle> triangles, std::optional<double> shell,
              std::vector<std::uint32_t>* places = nullptr, Solid solid = Solid::mended);
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
    double shell() const { return shell_; }  ///< m; 0: the surface bounds a body
    /// Returns what was done to make it a body's.
    const Mending& mending() const { return mending_; }
    /// Returns how far the surface is from the innermost of some 10,000 points, m: half of what the body is thick.
    double inner_radius() const { return inner_radius_; }

    /// Returns the distance to the surface, negative inside, m, computed from the triangles themselves.
    double distance(const Vec3& local) const;
    /// Returns the distance at points on a line along x, from `first` on by `step`, m. Beyond `exact_within` it may be
    /// up to 2 % too large.
    void distances(const Vec3& first, double step, double exact_within, std::vector<double>& row) const;
    /// Returns which of so many points of a line along x are inside: the surface winds around them, by more than a half
    /// if edges stayed open. None of a shell's are.
    std::vector<bool> inside(const Vec3& first, double step, std::size_t count) const;
    const TriangleTree& tree() const { return *tree_; }
    /// Returns how often the surface winds around so many points of a line along x: the generalised winding number.
    std::vector<double> winding(const Vec3& first, double step, std::size_t count) const;
    /// Returns the volume within the surface, m^3; negative if it is inside out.
    double volume() const;

  private:
    void weld(const std::vector<Vec3>& given, std::vector<std::uint32_t>* places);
    void center();
    void make_body(Solid solid, std::vector<std::uint32_t>& places);
    void expect_an_inside() const;
    void find_inner_radius();
    template <class See>
    void at_inner_points(const See& see) const;

    std::vector<Vec3> vertices_;
    std::vector<Triangle> triangles_;
    Vec3 middle_{}, half_extents_{};
    double shell_ = 0, inner_radius_ = 0;
    Mending mending_;
    std::optional<TriangleTree> tree_;
};

}  // namespace drape
