// What a collider's shape weighs, and how it turns, if it is solid and of one density.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "drape/scene.h"

namespace drape {

/// Of a body with a density of 1 kg/m^3.
struct MassProperties {
    double volume = 0;                ///< m^3, and kg
    Vec3 center{};                    ///< m: the centre of mass in the shape's frame, as `ShapeGeometry` has it
    std::array<double, 9> inertia{};  ///< kg m^2: the tensor about that, along the frame's axes, row major
};

/// Returns the properties of a shape; nothing for a plane, which has no end, and a shell, which is not solid.
std::optional<MassProperties> mass_properties(const ColliderShape& shape);

/// Principal moments of inertia, and the axes that they are about as columns, row major, right-handed.
struct PrincipalAxes {
    Vec3 moments{};
    std::array<double, 9> axes{1, 0, 0, 0, 1, 0, 0, 0, 1};
};
/// Returns those of a symmetric tensor, by Jacobi's rotations; the axes of a diagonal one are its own.
PrincipalAxes principal_axes(const std::array<double, 9>& tensor);

/// Returns the vertices of a body's surface that are farthest in some of 2048 directions, evenly spread, m: at most
/// 512. All else of its convex hull is within a thousandth of its reach of their hull.
std::vector<Vec3> hull_points(const MeshShape& shape);

/// Returns the area of a shape's surface, m^2: of a capsule, one with the larger radius; 0 of a plane, which has no
/// end.
double surface_area(const ColliderShape& shape);
/// Returns the mass of a scene's heaviest cloth that covers a shape once, kg.
double covering_mass(const SceneDescription& scene, const ColliderShape& shape);
/// A body that weighs less than so many times what covers it is light: what cloth gives it is owed to it first, because
/// it learns of what touches it a substep late (docs/physics.md 11). It weighs at least the smaller share.
inline constexpr double light_mass_ratio = 2, least_mass_ratio = 0.1;
/// Returns the mass of what covers a light body, kg, and 0 for others.
double light_cover(const SceneDescription& scene, const Collider& body);

}  // namespace drape
