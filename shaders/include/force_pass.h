// Body of the force passes: finishes the last substep (X += d, after the first substep of a frame) and
// predicts the next displacement. WINDY: adds the wind's force. Particles with w = 0 feel no force; the pin
// pass moves those that the user moves.
layout(local_size_x = workgroup_width) in;
layout(constant_id = 0) const bool advance = false;
layout(push_constant) uniform Push { ForcePush push; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position_in;
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D position_out;
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D displacement_in;
layout(set = 0, binding = 3, rgba32f) uniform writeonly image2D displacement_out;
layout(set = 0, binding = 4, rgba32f) uniform readonly image2D position_rest_in;
layout(set = 0, binding = 5, rgba32f) uniform writeonly image2D position_rest_out;
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D displacement_rest_in;
layout(set = 0, binding = 7, rgba32f) uniform writeonly image2D displacement_rest_out;
#ifdef WINDY
layout(set = 0, binding = 8, rgba32f) uniform readonly image2D wind_force;
#endif

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    vec4 position = imageLoad(position_in, texel);
    vec3 displacement = imageLoad(displacement_in, texel).xyz;
    if (advance) {
        CompensatedSum advanced = compensated_add(position.xyz, displacement, imageLoad(position_rest_in, texel).xyz);
        imageStore(position_out, texel, vec4(advanced.value, position.w));
        imageStore(position_rest_out, texel, vec4(advanced.rest, 0.0f));
    }
    if (position.w == 0.0f) return;
    vec3 force = vec3(0.0f, 0.0f, 0.0f);
#ifdef WINDY
    force = imageLoad(wind_force, texel).xyz;
#endif
    vec3 increment =
        verlet_increment(displacement, push.gravity_step.xyz, force, position.w, push.force_step, push.damping_loss);
    CompensatedSum predicted = compensated_add(displacement, increment, imageLoad(displacement_rest_in, texel).xyz);
    imageStore(displacement_out, texel, vec4(predicted.value, 0.0f));
    imageStore(displacement_rest_out, texel, vec4(predicted.rest, 0.0f));
}
