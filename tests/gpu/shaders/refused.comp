// Declares what Drape does not use: a uniform buffer, another set, an array of descriptors, a block that is no array.
#version 460
layout(local_size_x = 1) in;
layout(set = 0, binding = 0) uniform Settings { vec4 settings; };
layout(set = 1, binding = 1, std430) buffer Elsewhere { float elsewhere[]; };
layout(set = 0, binding = 2, rgba32f) uniform writeonly image2D several[2];
layout(set = 0, binding = 3, std430) buffer Mixed { float first; float rest[]; };

void main() {
    imageStore(several[0], ivec2(0), settings);
    imageStore(several[1], ivec2(0), vec4(elsewhere[0]));
    rest[0] = first;
}
