// Finds cloths that start through each other, or through themselves.
#pragma once

#include <string>
#include <vector>

#include "drape/scene.h"

namespace drape {

/// Returns whether any cloth of a scene meets itself: then all of them meet each other.
bool cloths_meet(const SceneDescription& scene);

struct StartCrossing {
    std::size_t first = 0, second = 0;  ///< indices of the scene's cloths; equal: it starts through itself
    std::size_t triangles = 0;  ///< pairs of triangles that cross; 0: the two only touch, as along a line of both
    double depth = 0;  ///< m: the least by which one of the two, moved along a normal of either, would be off the other
    Vec3 way{};        ///< unit: moved by the depth along it, the second would be off the first; zero: unknown
    double untied = 0;      ///< m: how far particles start from where jitter would have had the cloth go through itself
    bool gathered = false;  ///< the cloth is on a line or in a point, where contact would hold it for good
};

/// Finds every two cloths that at time 0 cross, or are somewhere nearer to each other than single precision can tell,
/// and every cloth that meets itself and is untied or gathered on a line, which would cross itself. Positions are exact
/// in double precision; holes count as such.
std::vector<StartCrossing> start_crossings(const SceneDescription& scene);

/// Returns whether a scene with this crossing is an error.
bool is_refused(const SceneDescription& scene, const StartCrossing& crossing);

/// Returns whether the two meet once apart: they cross, and a way off is known. Two that only touch never meet.
bool is_worked_apart(const StartCrossing& crossing);
/// Returns whether they are led apart until then: one of them at least is nowhere held.
bool is_led_apart(const SceneDescription& scene, const StartCrossing& crossing);
inline constexpr double parting_speed = 1;  ///< m/s, at which those led apart part where they cross

/// Returns a text like `cloths "a" and "b" start through each other (37 pairs of triangles cross; moved by 0.2 m one
/// would be off the other)`.
std::string crossing_text(const SceneDescription& scene, const StartCrossing& crossing);

}  // namespace drape
