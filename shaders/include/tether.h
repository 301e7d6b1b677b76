// Tethers are long-range attachments (Kim, Chentanez and Mueller-Fischer 2012): a particle farther from where the cloth
// is held than the cloth reaches comes back along the straight line.
#ifndef DRAPE_TETHER_H
#define DRAPE_TETHER_H

#include "include/vector.h"

SHARED bool is_beyond(vec3 edge, float length) {
    precise float reach_squared = length * length;
    return ordered_dot(edge, edge) > reach_squared;
}

/// Returns the correction (m) of a particle at the end of `edge`, which starts at its anchor; zero within `length`.
SHARED vec3 tether_correction(vec3 edge, float length) {
    if (!is_beyond(edge, length)) return vec3(0.0f, 0.0f, 0.0f);
    precise float current = sqrt(ordered_dot(edge, edge));
    precise vec3 correction = edge * ((length - current) / current);
    return correction;
}

#endif
