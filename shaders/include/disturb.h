// Disturbs a particle by a tiny displacement. If a run that begins with it diverges from one without, the motion is
// sensitive (engine/control/sensitivity.h).
#ifndef DRAPE_DISTURB_H
#define DRAPE_DISTURB_H

#include "include/vector.h"

/// Returns a number in [-1, 1), a different one for each seed (the PCG hash of Jarzynski and Olano, "Hash Functions for
/// GPU Rendering", 2020).
SHARED float scattered_by(uint seed) {
    uint state = seed * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    word = (word >> 22u) ^ word;
    precise float scattered = float(word >> 8u) * (1.0f / 8388608.0f) - 1.0f;
    return scattered;
}

/// Returns where particle `index` is after the disturbance; a held one, with `weight` 0, stays. The displacement is
/// perpendicular to the cloth, whose lines through the particle have the directions `along` and `down`. A strain e
/// within the cloth would be no small disturbance, since cloth that does not stretch buckles by the square root of e.
SHARED vec3 disturbed(vec3 position, float weight, vec3 along, vec3 down, uint index, float amplitude) {
    precise vec3 across = ordered_cross(along, down);
    precise float size = abs(across.x) + abs(across.y) + abs(across.z);
    if (!(weight > 0.0f) || !(size > 0.0f)) return position;
    precise float way = amplitude * scattered_by(index) / size;
    precise vec3 there = position + way * across;
    return there;
}

#endif
