// Cloths that start through each other, or through themselves.
#pragma once

#include <string>
#include <vector>

#include "drape/scene.h"

namespace drape {

/// Whether any cloth of a scene meets itself: then all of them meet each other.
bool cloths_meet(const SceneDescription& scene);

struct StartCrossing {
    std::size_t first = 0, second = 0;  ///< indices of the scene's cloths; the same: it starts through itself
    std::size_t triangles = 0;          ///< pairs of them that cross; 0: the two only touch, as along a line of both
    double depth = 0;  ///< m: the least by which one of the two, moved along a normal of either, would be off the other
    Vec3 way{};        ///< unit: moved by the depth along it, the second would be off the first; zero: none known
    bool gathered = false;  ///< on a line or in a point: contact would hold it there for good
};

/// Every two cloths that at time 0 cross, or are somewhere nearer to each other than single precision can tell, and
/// every cloth that meets itself and crosses itself then, by its jitter or gathered on a line. Exact in double
/// precision; holes count as such.
std::vector<StartCrossing> start_crossings(const SceneDescription& scene);

/// Whether a scene with it is none.
bool is_refused(const SceneDescription& scene, const StartCrossing& crossing);

/// Whether the two meet once they are apart: they cross, and a way off is known. Those that only touch never meet.
bool is_worked_apart(const StartCrossing& crossing);
/// Whether they are led apart until then: one of them at least is nowhere held.
bool is_led_apart(const SceneDescription& scene, const StartCrossing& crossing);
inline constexpr double parting_speed = 1;  ///< m/s, at which they then part where they cross

/// `cloths "a" and "b" start through each other (37 pairs of triangles cross; moved by 0.2 m one would be off the
/// other)`.
std::string crossing_text(const SceneDescription& scene, const StartCrossing& crossing);

}  // namespace drape
