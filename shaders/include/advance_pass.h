// Body of the passes that end a frame: X += d, so that the position image holds the state that is drawn and read back.
// HOME: the state is in the spare images; it returns from there.
layout(local_size_x = workgroup_width) in;
layout(push_constant) uniform Push { GridPush push; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position_in;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D position_out;
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D displacement;
layout(set = 0, binding = 3, rgba32f) uniform readonly image2D position_rest_in;
layout(set = 0, binding = 4, rgba32f) uniform writeonly image2D position_rest_out;
#ifdef HOME
layout(set = 0, binding = 5, rgba32f) uniform writeonly image2D displacement_out;
#endif

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    vec4 position = imageLoad(position_in, texel);
    vec4 moved = imageLoad(displacement, texel);
    CompensatedSum advanced = compensated_add(position.xyz, moved.xyz, imageLoad(position_rest_in, texel).xyz);
    imageStore(position_out, texel, vec4(advanced.value, position.w));
    imageStore(position_rest_out, texel, vec4(advanced.rest, 0.0f));
#ifdef HOME
    imageStore(displacement_out, texel, moved);
#endif
}
