// Shaders and C++ share these structs of nested boxes around lone pins.
#ifndef DRAPE_NESTED_TYPES_H
#define DRAPE_NESTED_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

/// A workgroup goes along the lines of one box; most boxes have 33 or fewer.
const int nested_group_width = 32;

/// Push constants of a dispatch, whose pins have boxes that share no particle. Vectors are over the spring directions
/// (row, column, shear down-right, shear down-left), with the members' meaning in LinePush.
struct NestedPush {
    ivec2 grid;  // columns, rows
    int block_count;
    int first_pin;     // first pin of this dispatch in the table (NestedBoxes::table)
    vec4 rest_length;  // m; 0: no springs
    vec4 compliance;
    vec4 compliance_bdf2;
    vec4 followed;
    vec4 followed_bdf2;
    float compression;
    float unused_x, unused_y, unused_z;
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
