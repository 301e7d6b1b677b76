// Disturbs a particle by next to nothing: where a run that began so parts from its like, the motion is sensitive
// (engine/cloth/sensitivity.h).
#ifndef DRAPE_DISTURB_H
#define DRAPE_DISTURB_H

#include "include/vector.h"

/// Returns a number in [-1, 1), another for every seed (the PCG hash of Jarzynski and Olano, "Hash Functions for GPU
/// Rendering", 2020).
SHARED float scattered(uint seed) {
    uint state = seed * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    word = (word >> 22u) ^ word;
    return float(word >> 8u) * (1.0f / 8388608.0f) - 1.0f;
}

/// Returns where particle `index` is after it; one that is held, with `weight` 0, stays.
SHARED vec3 disturbed(vec3 position, float weight, uint index, float amplitude) {
    if (!(weight > 0.0f)) return position;
    precise vec3 moved = amplitude * vec3(scattered(3u * index), scattered(3u * index + 1u), scattered(3u * index + 2u));
    precise vec3 there = position + moved;
    return there;
}

#endif
