// Enlarges a round collider so that particles kept out of the larger shape keep the cloth's triangles out of the
// collider.
#pragma once

#include "drape/scene.h"

namespace drape {

/// Contact keeps out triangles whose edges are longer than at rest by at most this share, as diagonals of square cells
/// are that are sheared by 30 degrees.
inline constexpr double contact_stretch = 0.2247;

/// Returns half of the longest edge that contact allows for, a diagonal, in m. No point of an edge is farther than this
/// from its nearer end, and no point of a triangle from its nearest corner: the largest distance, half of the third
/// side, occurs where two sides are perpendicular.
double covering_radius(const Cloth& cloth);

/// Returns whether particles have thickness or friction of their own.
inline bool has_skin(const Cloth& cloth) {
    return !cloth.particle_friction.empty() || !cloth.particle_thickness.empty();
}

/// Returns the factor by which maps scale a particle's thickness, and the one for its friction.
inline float thickness_factor(const Cloth& cloth, std::size_t particle) {
    return cloth.particle_thickness.empty() ? 1 : cloth.particle_thickness[particle];
}
inline float friction_factor(const Cloth& cloth, std::size_t particle) {
    return cloth.particle_friction.empty() ? 1 : cloth.particle_friction[particle];
}

/// Returns the thickness that every particle of the cloth keeps from colliders at least, m.
double least_thickness(const Cloth& cloth);

/// Returns the length of the longest edge that contact allows for, m.
double edge_reach(const Cloth& cloth);

/// Returns whether edges of boxes or meshes may cut into a cloth between its particles: a collider is a box or a closed
/// mesh, and the least thickness does not keep it clear.
bool meets_edges(const Cloth& cloth, const std::vector<Collider>& colliders);

/// Returns the collider from which contact keeps the cloth's particles, its thickness on top. It is the collider itself
/// for `ContactOf::particles`, planes and boxes. A triangle is outside a ball of radius R if its corners are at least
/// sqrt(R^2 + c^2) from its centre, c being the covering radius, and a round collider is made of balls: each radius of
/// a capsule grows by that law. An ellipsoid grows in proportion to how its smallest radius does, because the map that
/// makes a unit ball of it makes nothing longer than in the ball of that radius. A mesh grows as a ball of its inner
/// radius does, so that a ball, rod or torus of triangles acts as its round original; sharper edges are handled like
/// those of boxes. The growth is reduced by what the least thickness keeps clear already; where that is enough, the
/// result is the collider itself.
Collider contact_shape(const Cloth& cloth, const Collider& collider);

}  // namespace drape
