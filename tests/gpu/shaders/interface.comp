// Has one descriptor of every kind that Drape uses, one that is declared and never used, and push constants.
#version 460
layout(local_size_x = 8, local_size_y = 4) in;

struct Element {
    vec4 position;
    float mass;
    float age;
    ivec2 cell;
};
struct Push {
    ivec2 grid;
    float scale;
};

layout(push_constant) uniform Block { Push push; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D source;
layout(set = 0, binding = 1, r32f) uniform writeonly image2D target;
layout(set = 0, binding = 2, std430) readonly buffer Elements { Element elements[]; };
layout(set = 0, binding = 3, std430) buffer Sums { vec2 sums[]; };
layout(set = 0, binding = 4, std430) writeonly buffer Flags { uint flags[]; };
layout(set = 0, binding = 5, rgba32f) uniform readonly imageBuffer boxes;
layout(set = 0, binding = 7, rgba32f) uniform readonly image2D never_used;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, push.grid))) return;
    int i = texel.y * push.grid.x + texel.x;
    imageStore(target, texel, imageLoad(source, texel) * push.scale);
    sums[i] += vec2(elements[i].mass, elements[i].position.x);
    flags[i] = uint(elements[i].cell.x) + uint(imageLoad(boxes, i).x);
}
