// What moves a body before it meets anything: what cloth owes it, actions and gravity. The includer has the image
// `bodies`, the constants `push`, `weighs`, `acted` and `has_light`, and the buffers that these need.
RigidBody driven_body(int number) {
    RigidBody body = body_at(number);
    if (has_light) {
        if (is_light(body_constants[number])) {
            vec4 given = imageLoad(bodies, ivec2(body_owed, number));
            BodyStrike owed = BodyStrike(given.xyz, imageLoad(bodies, ivec2(body_owed_spin, number)).xyz);
            BodyStrike paid = paid_part(owed, body_constants[number], body.turn, given.w > 0.0f);
            BodyStrike rest = unpaid_part(owed, paid);
            imageStore(bodies, ivec2(body_owed, number), vec4(rest.impulse, 0.0f));
            imageStore(bodies, ivec2(body_owed_spin, number), vec4(rest.moment, 0.0f));
            body = struck_body(body, body_constants[number].inverse.w, paid.impulse, paid.moment);
        }
    }
    vec3 gravity = push.gravity.xyz;
    if (weighs) {
        precise vec3 changed = gravity + wind[push.weather].xyz;
        gravity = changed;
    }
    float last_step = imageLoad(bodies, ivec2(body_last_spin, number)).w;
    if (acted)
        body = acted_body(body, body_constants[number], body_actions[push.first_action + number], push.begins == 1,
                          gravity, last_step, push.gravity.w);
    return fallen_body(body, gravity, fall_time(last_step, push.gravity.w));
}
