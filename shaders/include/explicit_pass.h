// Body of the explicit micro-steps: finishes the last substep (X += d, after the first substep of a frame), gathers
// the springs around each particle and takes the next step. It reads neighbours, so it writes the other image of each
// pair, every texel of it. WINDY: adds the wind's force. MASKED: the stiffness comes from an image (holes, cuts).
// Particles with w = 0 feel no force; the pin pass moves those that the user moves.
layout(local_size_x = workgroup_width) in;
layout(constant_id = 0) const bool advance = false;
layout(constant_id = 1) const bool has_shear = false;
layout(push_constant) uniform Push { ExplicitPush push; };
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
#ifdef MASKED
layout(set = 0, binding = 9, rgba32f) uniform readonly image2D stiffness_image;
#endif

/// What the gathers share: this particle, and its springs' shares where it is their first particle.
struct Center {
    ivec2 texel;
    vec3 position;
    vec3 displacement;
    vec4 shares;
};

bool inside(ivec2 texel) {
    return texel.x >= 0 && texel.y >= 0 && texel.x < push.grid.x && texel.y < push.grid.y;
}

vec3 edge_to(Center center, vec3 position, vec3 displacement) {
    if (advance) return spring_edge(center.position, position, center.displacement, displacement);
    precise vec3 edge = position - center.position;
    return edge;
}

float share_of(Center center, ivec2 there, ivec4 around) {
#ifdef MASKED
    if (around.w == 1) return center.shares[around.z];
    return imageLoad(stiffness_image, there)[around.z];
#else
    return border_stiffness(around.w == 1 ? center.texel : there, around.xy, push.grid);
#endif
}

vec3 gather(vec3 sum, Center center, ivec4 around) {
    if (around.z >= 2 && !has_shear) return sum;
    ivec2 there = center.texel + around.xy;
    if (!inside(there)) return sum;
    vec3 displacement = imageLoad(displacement_in, there).xyz;
    vec3 edge = edge_to(center, imageLoad(position_in, there).xyz, displacement);
    precise vec3 closing = displacement - center.displacement;
    precise float stiffness = push.stiffness[around.z] * share_of(center, there, around);
    return add_pull(sum, edge, closing, push.rest_length[around.z], stiffness, push.strain_damping);
}

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    vec4 position = imageLoad(position_in, texel);
    vec3 displacement = imageLoad(displacement_in, texel).xyz;
    if (advance) {
        CompensatedSum advanced =
            compensated_add(position.xyz, displacement, imageLoad(position_rest_in, texel).xyz);
        imageStore(position_out, texel, vec4(advanced.value, position.w));
        imageStore(position_rest_out, texel, vec4(advanced.rest, 0.0f));
    } else {
        imageStore(position_out, texel, position);
    }
    if (position.w == 0.0f) {
        imageStore(displacement_out, texel, vec4(displacement, 0.0f));
        return;
    }
    Center center = Center(texel, position.xyz, displacement, vec4(0.0f));
#ifdef MASKED
    center.shares = imageLoad(stiffness_image, texel);
#endif
    vec3 pull = empty_sum();
    pull = gather(pull, center, neighbour(0));
    pull = gather(pull, center, neighbour(1));
    pull = gather(pull, center, neighbour(2));
    pull = gather(pull, center, neighbour(3));
    pull = gather(pull, center, neighbour(4));
    pull = gather(pull, center, neighbour(5));
    pull = gather(pull, center, neighbour(6));
    pull = gather(pull, center, neighbour(7));
    vec3 force = vec3(0.0f, 0.0f, 0.0f);
#ifdef WINDY
    force = imageLoad(wind_force, texel).xyz;
#endif
    vec3 increment = explicit_increment(displacement, push.gravity_step.xyz, force, pull, position.w, push.force_step,
                                        push.damping_loss);
    CompensatedSum stepped = compensated_add(displacement, increment, imageLoad(displacement_rest_in, texel).xyz);
    imageStore(displacement_out, texel, vec4(stepped.value, 0.0f));
    imageStore(displacement_rest_out, texel, vec4(stepped.rest, 0.0f));
}
