// Force of the wind: each particle gathers a third of the force, and of the drag, on each of its up to six triangles.
// MASKED: the cell image says which triangles exist (holes, cuts).
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants MASKED BUFFERED
#include "shared/simulation_types.h"
#include "include/triangles.h"
#include "include/wind.h"

layout(local_size_x = workgroup_width) in;
layout(constant_id = 0) const bool advance = false;  // the positions still lack the last substep's displacement
layout(push_constant) uniform Push { WindPush push; };
#define TOGETHER
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement;
VECTOR_OUT(2, WindForceOut, wind_force);
layout(set = 0, binding = 3, std430) readonly buffer Wind { vec4 wind[]; };
#ifdef MASKED
layout(set = 0, binding = 4, r32ui) uniform readonly uimage2D cells;
#endif

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    vec3 wind_velocity = wind[push.substep].xyz;
    WindForce sum = WindForce(empty_sum(), 0.0f);
    for (int k = 0; k < triangles_around_particle; ++k) {
        ivec4 around = triangle_around(k);
        ivec2 cell = texel + around.xy;
        if (!cell_inside(cell, push.grid)) continue;
#ifdef MASKED
        if ((imageLoad(cells, placed_cell(cell)).x & uint(around.z)) == 0u) continue;
#endif
        vec3 corners[3];
        vec3 moved[3];
        for (int corner = 0; corner < 3; ++corner) {
            ivec2 at = cell + triangle_corner(around.z, corner);
            moved[corner] = LOAD(displacement, at).xyz;
            precise vec3 now = LOAD(position, at).xyz;
            if (advance) now = now + moved[corner];
            corners[corner] = now;
        }
        sum = add_wind_share(sum, corners[0], corners[1], corners[2], moved[0], moved[1], moved[2], push.inverse_step,
                             wind_velocity, push.drag_coefficient, push.lift_coefficient, push.area_limit);
    }
    STORE_VECTOR(wind_force, texel, vec4(sum.force, sum.drag));
}
