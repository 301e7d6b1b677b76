// This pass makes the map of the floor's shade, of twice as many texels a side, by quadratic B-splines, so that it
// shows no columns. Each entry holds the share of the sky's light at a texel, at the next along x, and at those below
// both: a pixel reads what is between four with one load (include/floor.h). Towards its border shade fades out.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "shared/simulation_types.h"

layout(local_size_x = workgroup_width) in;
layout(set = 0, binding = 0, std430) readonly buffer Open { float open[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Shade { vec4 ground_shade[]; };

float open_at(int x, int y) {
    ivec2 inside = clamp(ivec2(x, y), ivec2(0), ivec2(ground_side - 1));
    return open[inside.y * ground_side + inside.x];
}

float row_at(ivec2 middle, int y, vec3 weights) {
    return dot(weights, vec3(open_at(middle.x - 1, y), open_at(middle.x, y), open_at(middle.x + 1, y)));
}

float value_at(ivec2 texel) {
    ivec2 middle = texel >> 1;
    bvec2 later = equal(texel & 1, ivec2(1));
    const vec3 before = vec3(0.28125, 0.6875, 0.03125), after = before.zyx;
    vec3 across = later.x ? after : before, down = later.y ? after : before;
    float value = dot(down, vec3(row_at(middle, middle.y - 1, across), row_at(middle, middle.y, across),
                                 row_at(middle, middle.y + 1, across)));
    ivec2 to_border = min(texel, ground_shade_side - 1 - texel);
    float kept = smoothstep(0.0, 16.0, float(min(to_border.x, to_border.y)));
    return 1.0 - kept * (1.0 - value);
}

void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= ground_shade_side * ground_shade_side) return;
    ivec2 texel = ivec2(index % ground_shade_side, index / ground_shade_side);
    ground_shade[index] = vec4(value_at(texel), value_at(texel + ivec2(1, 0)), value_at(texel + ivec2(0, 1)),
                               value_at(texel + ivec2(1, 1)));
}
