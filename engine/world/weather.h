// Evaluates what keys may change: gravity, the wind's steady velocity (gust.h adds the gusts) and a cloth's stiffness.
#pragma once

#include <cstdint>
#include <vector>

#include "drape/scene.h"

namespace drape {

/// Returns a keyed vector at `time` (s): linear between two keys, component by component, so that it never leaves their
/// range; before the first and after the last key that key holds. Without keys it is `steady`.
Vec3 value_at(const std::vector<VectorKey>& keys, const Vec3& steady, double time);
/// Returns whether it keeps one value from a time to another, s.
bool is_steady(const std::vector<VectorKey>& keys, double from, double to);

/// Returns gravity at `time` (s), m/s^2.
Vec3 gravity_at(const SceneDescription& scene, double time);
/// Returns whether gravity is not the same all the time.
bool gravity_changes(const SceneDescription& scene);
/// Returns whether wind blows or gravity changes: the substeps then hear of both.
bool has_weather(const SceneDescription& scene);
/// Returns the factor of a cloth's stiffness in a frame: linear between two keys, at the frame's middle; in frame 0,
/// which has no length, at its time.
double stiffness_factor(const SceneDescription& scene, const Cloth& cloth, std::uint32_t frame);
/// Return gravity, m/s^2, and the wind's velocity without gusts, m/s, when they are largest.
Vec3 strongest_gravity(const SceneDescription& scene);
Vec3 strongest_wind(const Wind& wind);

}  // namespace drape
