// How far a body is from where another run has it.
#ifndef DRAPE_BODY_DIFFERENCE_H
#define DRAPE_BODY_DIFFERENCE_H

#include "include/vector.h"

/// Returns the squared distance, m^2, of two places, each with what rounding lost of it.
SHARED float body_distance(vec3 place, vec3 remainder, vec3 other_place, vec3 other_remainder) {
    precise vec3 apart = (place - other_place) + (remainder - other_remainder);
    return ordered_dot(apart, apart);
}

#endif
