// Evaluates what keys can change: gravity, loads, the wind's steady velocity (gust.h adds the gusts) and a cloth's
// stiffness.
#pragma once

#include <cstdint>
#include <vector>

#include "drape/scene.h"

namespace drape {

/// Returns a keyed vector at `time` (s): linear between two keys, component by component, so that it never leaves their
/// range. Before the first key and after the last, that key holds. Without keys it is `steady`.
Vec3 value_at(const std::vector<VectorKey>& keys, const Vec3& steady, double time);
double value_at(const std::vector<NumberKey>& keys, double steady, double time);
/// Returns whether the value is constant between two times, s.
bool is_steady(const std::vector<VectorKey>& keys, double from, double to);
bool is_steady(const std::vector<NumberKey>& keys, double from, double to);

/// Returns gravity at `time` (s), m/s^2.
Vec3 gravity_at(const SceneDescription& scene, double time);
/// Returns whether gravity changes during the scene.
bool gravity_changes(const SceneDescription& scene);
/// Returns the force (N) and the pressure (Pa) of a load at `time`, s.
Vec3 force_at(const Load& load, double time);
double pressure_at(const Load& load, double time);
/// Returns the largest that a load has, without its direction: N, or Pa.
double strongest(const Load& load);
/// Returns whether wind blows, gravity changes, or loads or gas act on a cloth; then every substep receives all of it.
bool has_weather(const SceneDescription& scene);
/// Returns the factor of a cloth's stiffness in a frame: linear between two keys, at the frame's middle; in frame 0,
/// which has no length, at its time.
double stiffness_factor(const SceneDescription& scene, const Cloth& cloth, std::uint32_t frame);
/// Returns gravity, m/s^2, at its strongest.
Vec3 strongest_gravity(const SceneDescription& scene);
/// Returns the speed, m/s, of the wind at its fastest; with gusts and without.
double fastest_wind(const Wind& wind);
double fastest_steady_wind(const Wind& wind);
/// Returns whether all of the weather is constant between two times, s.
bool weather_stays(const SceneDescription& scene, double from, double to);

}  // namespace drape
