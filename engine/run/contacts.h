#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "drape/scene.h"

namespace drape {

/// A particle touches a collider when it is nearer than this beyond the distance that contact keeps, the cloth's
/// thickness included. It is a share of the shorter edge of the cloth's cells at rest.
inline constexpr double contact_reach = 1e-3;

/// Returns for every particle of a cloth the number of the nearest collider that it touches at a time (s), of these in
/// the scene's order (planes, spheres, boxes, ellipsoids, capsules), or -1; held particles touch nothing. `xyzw` is
/// laid out as in FinishedFrame. Distances are those that the solver's contact computes (shaders/include/colliders.h).
std::vector<std::int16_t> touched_colliders(const Cloth& shape, const std::vector<Collider>& colliders, double time,
                                            std::span<const float> xyzw);

}  // namespace drape
