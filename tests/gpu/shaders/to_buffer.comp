// Copies an image into rows of texels.
#version 460
layout(local_size_x = 64) in;
struct RowsPush {
    ivec2 size;
    int row_pitch;
};
layout(push_constant) uniform Push { RowsPush push; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D source;
layout(set = 0, binding = 1, std430) writeonly buffer Target { vec4 target[]; };

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, push.size))) return;
    target[texel.y * push.row_pitch + texel.x] = imageLoad(source, texel) + 1.0;
}
