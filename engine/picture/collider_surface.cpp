#include "picture/collider_surface.h"

#include <algorithm>
#include <map>

#include "base/vectors.h"
#include "include/collider_shapes.h"
#include "mesh/mesh_shape.h"
#include "picture/collider_mesh.h"
#include "picture/framing.h"

namespace drape {
namespace {

/// Merges all corners with the same key into one vertex.
template <class Key>
class Joined {
  public:
    void add(const Key& key, const glsl::vec3& place) {
        const auto [found, is_new] = numbers_.try_emplace(key, static_cast<std::uint32_t>(surface_.vertices.size()));
        if (is_new) surface_.vertices.push_back({place.x, place.y, place.z});
        triangle_[corners_++ % 3] = found->second;
        const auto& [a, b, c] = triangle_;
        if (corners_ % 3 == 0 && a != b && b != c && c != a) surface_.triangles.push_back(triangle_);
    }
    ColliderSurface take() { return std::move(surface_); }

  private:
    std::map<Key, std::uint32_t> numbers_;
    ColliderSurface surface_;
    std::array<std::uint32_t, 3> triangle_{};
    std::size_t corners_ = 0;
};

/// Merges the vertices that `vertex_of` makes of corners and columns. The last column is the first one, and a pole is a
/// single vertex.
template <class VertexOf>
ColliderSurface round_surface(int kind, int columns, const VertexOf& vertex_of) {
    Joined<std::array<int, 2>> joined;
    for (int vertex = 0; vertex < glsl::mesh_vertex_count(kind, columns); ++vertex) {
        glsl::ivec2 corner = glsl::round_corner(columns, vertex);
        const bool is_pole = corner.y == 0 || corner.y == columns / 2;
        corner.x = is_pole ? 0 : corner.x % columns;
        glsl::vec3 place = vertex_of(corner, columns).position;
        if (is_pole) place.x = place.z = 0;  // the sine of the float next to pi is not 0
        joined.add({corner.x, corner.y}, place);
    }
    return joined.take();
}

ColliderSurface box_surface(const glsl::vec3& half_extents) {
    Joined<std::array<bool, 3>> joined;
    for (int vertex = 0; vertex < glsl::mesh_vertex_count(glsl::kind_box, 0); ++vertex) {
        const glsl::vec3 place = glsl::box_vertex(half_extents, vertex).position;
        joined.add({place.x > 0, place.y > 0, place.z > 0}, place);
    }
    return joined.take();
}

/// The quad's triangles, which pictures draw from both sides, turn clockwise seen along the normal.
ColliderSurface square_surface(const Collider& plane, const PlaneSquare& square) {
    const ColliderPose pose = plane_pose(plane, 0);
    const auto& r = pose.rotation;
    const Vec3 to_center = minus(square.center, pose.center);
    const glsl::vec2 center{static_cast<float>(dot({r[0], r[3], r[6]}, to_center)),
                            static_cast<float>(dot({r[2], r[5], r[8]}, to_center))};
    Joined<std::array<int, 2>> joined;
    for (int vertex = glsl::mesh_vertex_count(glsl::kind_plane, 0); vertex-- > 0;) {
        const glsl::ivec2 corner = glsl::quad_corner(vertex);
        const auto half_side = static_cast<float>(square.half_side);
        joined.add({corner.x, corner.y}, glsl::plane_vertex(half_side, center, vertex).position);
    }
    return joined.take();
}

}  // namespace

PlaneSquare plane_square(const SceneDescription& scene) {
    const BoundingSphere extent = scene_extent(scene);
    return {extent.center, 2 * extent.radius};
}

ColliderSurface collider_surface(const Collider& collider, int columns, const PlaneSquare& square) {
    const Vec3 extents = shape_geometry(collider.shape).size;
    const glsl::vec3 size{static_cast<float>(extents[0]), static_cast<float>(extents[1]),
                          static_cast<float>(extents[2])};
    const auto ellipsoid = [&](const glsl::vec3& radii) {
        return round_surface(collider.kind(), columns, [&](const glsl::ivec2& corner, int around) {
            return glsl::ellipsoid_vertex(radii, corner, around);
        });
    };
    return std::visit(
        ForEachKind{[&](const Plane&) { return square_surface(collider, square); },
                    [&](const Sphere&) {
                        return ellipsoid({size.x, size.x, size.x});
                    },
                    [&](const Box&) { return box_surface(size); }, [&](const Ellipsoid&) { return ellipsoid(size); },
                    [&](const Capsule&) {
                        return round_surface(collider.kind(), columns, [&](const glsl::ivec2& corner, int around) {
                            return glsl::capsule_vertex(size, corner, around);
                        });
                    },
                    [](const Mesh& mesh) {
                        return ColliderSurface{mesh.shape->vertices(), mesh.shape->triangles()};
                    }},
        collider.shape);
}

ColliderPose surface_pose(const Collider& collider, double time) {
    return special(collider.shape).plane ? plane_pose(collider, time) : collider_pose(collider, time);
}

}  // namespace drape
