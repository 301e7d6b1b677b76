// Where a held particle goes.
#ifndef DRAPE_PIN_H
#define DRAPE_PIN_H

#include "include/vector.h"

/// Displacement that takes a held particle from `position` to its pin's motion of its rest position.
SHARED vec3 pin_displacement(PinMotion motion, vec3 rest, vec3 position) {
    vec3 row_x = vec3(motion.row_x.x, motion.row_x.y, motion.row_x.z);
    vec3 row_y = vec3(motion.row_y.x, motion.row_y.y, motion.row_y.z);
    vec3 row_z = vec3(motion.row_z.x, motion.row_z.y, motion.row_z.z);
    precise vec3 target = vec3(ordered_dot(row_x, rest) + motion.row_x.w, ordered_dot(row_y, rest) + motion.row_y.w,
                               ordered_dot(row_z, rest) + motion.row_z.w);
    precise vec3 moved = target - position;
    return moved;
}

#endif
