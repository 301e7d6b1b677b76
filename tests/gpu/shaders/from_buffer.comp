// Copies rows of texels into an image.
#version 460
layout(local_size_x = 64) in;
struct RowsPush {
    ivec2 size;
    int row_pitch;
};
layout(push_constant) uniform Push { RowsPush push; };
layout(set = 0, binding = 0, std430) readonly buffer Source { vec4 source[]; };
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D target;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, push.size))) return;
    imageStore(target, texel, source[texel.y * push.row_pitch + texel.x]);
}
