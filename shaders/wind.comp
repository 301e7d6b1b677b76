// Force of the wind: each particle gathers a third of the force, and of the drag, on each of its up to six triangles.
// MASKED: the cell image says which triangles exist (holes, cuts).
#version 460
#extension GL_GOOGLE_include_directive : require
#pragma variants MASKED BUFFERED
#include "shared/simulation_types.h"
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

#include "include/neighbourhood.h"

vec3 positions[neighbourhood_count], displacements[neighbourhood_count];

void load_member(int place, ivec2 at) {
    displacements[place] = LOAD(displacement, at).xyz;
    precise vec3 now = LOAD(position, at).xyz;
    if (advance) now = now + displacements[place];
    positions[place] = now;
}

vec3 wind_velocity;
ivec2 texel;
WindForce sum = WindForce(empty_sum(), 0.0f);

void add_triangle(int k) {
    ivec4 around = triangle_around(k);
    int a = corner_in_neighbourhood(around, 0), b = corner_in_neighbourhood(around, 1),
        c = corner_in_neighbourhood(around, 2);
    WindForce more = add_wind_share(sum, positions[a], positions[b], positions[c], displacements[a], displacements[b],
                                    displacements[c], push.inverse_step, wind_velocity, push.drag_coefficient,
                                    push.lift_coefficient, push.area_limit);
    if (triangle_exists(texel, around)) sum = more;
}

void main() {
    wind_velocity = wind[push.substep].xyz;  // before anything branches (docs/devices.md)
    texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    FOR_NEIGHBOURHOOD(texel, load_member)
    FOR_TRIANGLES(add_triangle)
    STORE_VECTOR(wind_force, texel, vec4(sum.force, sum.drag));
}
