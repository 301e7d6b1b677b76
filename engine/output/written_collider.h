// The colliders of a run as files describe them: triangle meshes, placed at every time, some of which deform.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "drape/vec3.h"

namespace drape {

/// Rows of a matrix: x_world = the first three columns times x_local, plus the last one, m.
using Placement3x4 = std::array<std::array<double, 4>, 3>;

struct WrittenCollider {
    std::string name;                                    ///< "collider_2_sphere"
    std::int32_t number = 0;                             ///< the collider's number in WrittenFrame::contacts
    std::vector<Vec3> vertices;                          ///< m, in its own frame
    std::vector<std::uint32_t> faces;                    ///< three vertices per triangle
    bool flat = false;                                   ///< its faces are flat and large, as those of a plane or a box
    bool moves = false;                                  ///< its placement or its form changes with time
    Vec3 color{0.5, 0.5, 0.5};                           ///< sRGB, 0..1
    std::function<Placement3x4(double time)> placement;  ///< at a time, s
    /// Returns the same number of vertices at a time, s, in its own frame, m; null if its form does not change.
    std::function<std::vector<Vec3>(double time)> form = {};
};

/// Returns the vertices at a time, s, in its own frame, m.
std::vector<Vec3> formed_vertices(const WrittenCollider& collider, double time);

/// Returns the vertices at a time, s: x y z each, m.
std::vector<float> placed_vertices(const WrittenCollider& collider, double time);

/// Returns the collider with additional nodes on flat faces, eight along an edge.
WrittenCollider with_nodes(WrittenCollider collider);

/// Returns "colliders.obj", the file of colliders that stand still.
std::string still_colliders_name(std::string_view extension);
/// Returns "colliders_0031.obj", the file of colliders that move.
std::string moving_colliders_name(std::uint64_t frame, int digits, std::string_view extension);
bool is_colliders_name(std::string_view name, std::string_view extension);

}  // namespace drape
