// Finds the shape that keeps a cloth's triangles out of a round collider by keeping its particles out of that shape.
#pragma once

#include "drape/scene.h"

namespace drape {

/// Contact keeps triangles out whose edges are longer than at rest by at most this share: the diagonals of square cells
/// that are sheared by 30 degrees are.
inline constexpr double contact_stretch = 0.2247;

/// Returns half the longest edge that is allowed for, a diagonal, in m. No point of an edge is farther from its nearer
/// end, and no point of a triangle from its nearest corner: the farthest is where two sides are perpendicular, half the
/// third side from it.
double covering_radius(const Cloth& cloth);

/// Returns whether particles have thickness or friction of their own.
inline bool has_skin(const Cloth& cloth) {
    return !cloth.particle_friction.empty() || !cloth.particle_thickness.empty();
}

/// Returns by what maps scale a particle's thickness and its friction.
inline float thickness_factor(const Cloth& cloth, std::size_t particle) {
    return cloth.particle_thickness.empty() ? 1 : cloth.particle_thickness[particle];
}
inline float friction_factor(const Cloth& cloth, std::size_t particle) {
    return cloth.particle_friction.empty() ? 1 : cloth.particle_friction[particle];
}

/// Returns the thickness that all particles of the cloth keep from colliders, m.
double least_thickness(const Cloth& cloth);

/// Returns how long an edge of the cloth is that is allowed for, m.
double edge_reach(const Cloth& cloth);

/// Returns whether edges of boxes or meshes may cut a cloth between its particles: one collider is a box or a closed
/// mesh, and the least thickness does not keep it clear.
bool meets_edges(const Cloth& cloth, const std::vector<Collider>& colliders);

/// Returns the collider from which contact keeps the cloth's particles, its thickness on top. It is the collider itself
/// for `ContactOf::particles`, planes and boxes. A triangle is outside a ball of radius R if its corners are at least
/// sqrt(R^2 + c^2) from its centre, c being the covering radius, and a round collider is made of balls: each radius of
/// a capsule grows by that law. An ellipsoid grows in proportion to how its smallest radius does, because the map that
/// makes a unit ball of it makes nothing longer than in the ball of that radius. A mesh grows as a ball of its inner
/// radius does, so that a ball, rod or torus of triangles is met as its round original; sharper edges of it are met as
/// those of boxes are. What the least thickness keeps clear already is taken off; where that is enough, it is the
/// collider itself.
Collider contact_shape(const Cloth& cloth, const Collider& collider);

}  // namespace drape
