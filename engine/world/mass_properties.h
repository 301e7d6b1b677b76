// What a collider's shape weighs, and how it turns, if it is solid and of one density.
#pragma once

#include <array>
#include <optional>

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

/// Returns the area of a shape's surface, m^2: of a capsule, one with the larger radius; 0 of a plane and of a mesh,
/// which are no bodies.
double surface_area(const ColliderShape& shape);
/// A body weighs at least so many times what cloth weighs that covers it: it learns of what touches it a substep late
/// (docs/physics.md 11).
inline constexpr double least_mass_ratio = 2;

}  // namespace drape
