// This pass copies one image into another, and is the smallest one with a real hazard. The canary test removes the
// barrier before it and requires that synchronization validation reports the hazard.
#version 460
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D source;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D target;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, imageSize(target)))) return;
    imageStore(target, texel, imageLoad(source, texel));
}
