// Finds cloths that start through each other, or through themselves.
#pragma once

#include <string>
#include <vector>

#include "drape/scene.h"

namespace drape {

/// Returns whether any cloth of a scene has self-contact; then all cloths can touch each other.
bool cloths_meet(const SceneDescription& scene);

struct StartCrossing {
    /// All triangles of one cloth may cross all of the other, too many to look for.
    static constexpr std::size_t most_counted = 10'000;

    std::size_t first = 0, second = 0;  ///< indices of the scene's cloths; equal: the cloth starts through itself
    std::size_t triangles = 0;  ///< pairs of triangles that cross, counted up to most_counted; 0: the two only touch
    double depth = 0;   ///< m: the shortest distance along a normal of either cloth by which one would clear the other
    Vec3 way{};         ///< unit: moved by the depth along it, the second cloth would clear the first; zero: unknown
    double untied = 0;  ///< m: how far particles were moved where jitter would have made the cloth cross itself
    bool gathered = false;  ///< the cloth lies on a line or in a point, where contact would hold it for good
};

/// Finds all pairs of cloths that cross at time 0 or are nearer to each other than single precision can tell, and all
/// cloths with self-contact that would cross themselves, since jitter was reduced or they are gathered on a line.
/// Positions are exact in double precision; holes count as holes.
std::vector<StartCrossing> start_crossings(const SceneDescription& scene);

/// Returns whether a scene with this crossing is an error.
bool is_refused(const SceneDescription& scene, const StartCrossing& crossing);

/// Returns whether the two can touch after they have come apart: they cross, and a way off is known. Cloths that only
/// touch at the start never touch later.
bool is_worked_apart(const StartCrossing& crossing);
/// Returns whether contact leads the two apart until then: at least one of them is nowhere held.
bool is_led_apart(const SceneDescription& scene, const StartCrossing& crossing);
inline constexpr double parting_speed = 1;  ///< m/s, at which cloths that are led apart separate where they cross

/// Returns a text like `cloths "a" and "b" start through each other (37 pairs of triangles cross; moved by 0.2 m one
/// would be off the other)`.
std::string crossing_text(const SceneDescription& scene, const StartCrossing& crossing);

}  // namespace drape
