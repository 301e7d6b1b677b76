// Computes the wind as a function of time; the formula is part of the scene format (scene.schema.json).
#pragma once

#include <array>

#include "drape/scene.h"

namespace drape {

/// Returns the three phases of a gust's sine waves, radians in [0, 2 pi): the top 53 bits of splitmix64(seed + k), k =
/// 1, 2, 3, times 2 pi / 2^53.
std::array<double, 3> gust_phases(std::uint32_t seed);

/// Returns the extra wind speed at `time` (s), m/s along the wind's direction, within +-amplitude: amplitude
/// (sin(2 pi t/period + p1) + 0.5 sin(2 pi 2.3 t/period + p2) + 0.25 sin(2 pi 5.1 t/period + p3)) / 1.75.
double gust_speed(const Gust& gust, double time);

/// Returns the wind velocity at `time` (s), m/s: the velocity that the scene gives (world/weather.h) plus the gust
/// along it. It is zero where that velocity is zero, since a gust then has no direction.
Vec3 wind_velocity(const Wind& wind, double time);

}  // namespace drape
