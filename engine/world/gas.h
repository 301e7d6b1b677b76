// Finds out what closes gas in.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "drape/scene.h"

namespace drape {

/// A cloth that closes gas in.
struct GasWall {
    std::size_t cloth;
    double sign;  ///< 1: its front is outside; -1: its back
    bool operator==(const GasWall&) const = default;
};

/// Returns the volume, m^3, that a cloth closes in with the origin, above 0 where that is behind it. Cells are bilinear
/// between these places of its particles, row by row; those of cells share out the mean of both ways to halve it.
double volume_behind(const Cloth& cloth, std::span<const Vec3> at);
/// Returns its derivative by the particles' places, m^2, which is the area vector of what each of them bears of a
/// pressure, towards the front. Of a closed surface the sum is nothing.
std::vector<Vec3> areas_borne(const Cloth& cloth, std::span<const Vec3> at);

/// Tells what is wrong with a scene's gas.
struct GasFault {
    std::string below;  ///< JSON pointer of the culprit, from /gas on
    std::string text;   ///< "expected ..."
};
/// Finds out whether the gases of a scene whose seams have no faults are closed in, each by cloths that nothing else
/// takes apart and that close in no other gas.
std::vector<GasFault> gas_faults(const SceneDescription& scene);
/// Returns what closes a gas in, in the order of its cloths. The scene must have no faults.
std::vector<GasWall> gas_walls(const SceneDescription& scene, const Gas& gas);

/// Returns the volume at ambient pressure, m^3, at a time, s; and the largest.
double gas_at(const Gas& gas, double time);
double most_gas(const Gas& gas);
/// Returns the volume, m^3, that is closed in at the start.
double start_volume(const SceneDescription& scene, std::span<const GasWall> walls);
/// Returns whether cloths of an area, m^2, that close a volume in, m^3, close nothing in but the rounding of places.
bool closes_nothing_in(double volume, double area);
/// Returns the gauge pressure p, Pa, of a gas at a time, s, in a volume, m^3, that grows by `yielding` p, m^3/Pa; 0
/// where it is not above 0.
double gas_pressure(const Gas& gas, double time, double volume, double yielding = 0);

}  // namespace drape
