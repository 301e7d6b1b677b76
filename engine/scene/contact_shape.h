// The shape that keeps a cloth's triangles out of a round collider when its particles are kept out of that shape. Pure.
#pragma once

#include "drape/scene.h"

namespace drape {

/// By how much the edges of a cloth's triangles may be longer than at rest before these reach into what contact keeps
/// them from: the diagonals of square cells that are sheared by 30 degrees.
inline constexpr double contact_stretch = 0.2247;

/// m: half the longest edge that is allowed for, a diagonal. No point of an edge is farther from its nearer end, and
/// none of a triangle from its nearest corner: that is the most where two sides are perpendicular, and there half the
/// third one.
double covering_radius(const Cloth& cloth);

/// Whether edges of boxes may cut a cloth between its particles: one collider is a box, and the thickness does not keep
/// it clear.
bool meets_box_edges(const Cloth& cloth, const std::vector<Collider>& colliders);

/// The collider as contact keeps the cloth's particles from it, its thickness on top. Of `ContactOf::particles`, of
/// planes and of boxes: itself. A triangle is outside a ball of radius R if its corners are at sqrt(R^2 + c^2) or
/// farther from its centre, c being the covering radius, and a round collider is made of balls: a capsule's radii grow
/// by that law each. An ellipsoid grows in proportion to how its smallest radius does: the map that makes a unit ball
/// of it makes nothing longer than in the ball of that radius. What the thickness keeps clear already is taken off:
/// where that is enough, it is the collider itself.
Collider contact_shape(const Cloth& cloth, const Collider& collider);

}  // namespace drape
