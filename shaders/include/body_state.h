// Loads and stores the state of a body. The includer has the image `bodies`, whose texels body_last_spin have in w the
// length of the last substep, s.
RigidBody body_at(int number) {
    return RigidBody(
        imageLoad(bodies, ivec2(body_position, number)).xyz, imageLoad(bodies, ivec2(body_remainder, number)).xyz,
        imageLoad(bodies, ivec2(body_turn, number)), imageLoad(bodies, ivec2(body_velocity, number)).xyz,
        imageLoad(bodies, ivec2(body_slower, number)).xyz, imageLoad(bodies, ivec2(body_spin, number)).xyz);
}

/// Stores all but position and turn.
void store_motion(int number, RigidBody body) {
    imageStore(bodies, ivec2(body_remainder, number), vec4(body.remainder, 0.0f));
    imageStore(bodies, ivec2(body_velocity, number), vec4(body.velocity, 0.0f));
    imageStore(bodies, ivec2(body_slower, number), vec4(body.slower, 0.0f));
    imageStore(bodies, ivec2(body_spin, number), vec4(body.spin, 0.0f));
}

void store_body(int number, RigidBody body) {
    imageStore(bodies, ivec2(body_position, number), vec4(body.position, 0.0f));
    imageStore(bodies, ivec2(body_turn, number), body.turn);
    store_motion(number, body);
}
