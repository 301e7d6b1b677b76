// Contact of a body with the planes of its scene. The includer, a shader or a function of the twin, has the records
// `colliders` and the constants `push`.
RigidBody body_on_planes(RigidBody start, BodyConstants constants) {
    int planes[body_planes];
    float pressed[body_planes * body_points];
    vec3 gripped[body_planes * body_points];
    int count = 0, points = body_point_count(constants.what.x);
    float step = push.gravity.w;
    for (int plane = 0; plane < push.plane_count; ++plane) {
        if (count == body_planes || !near_plane(start, constants, colliders[push.first + plane], step)) continue;
        for (int k = 0; k < body_points; ++k) {
            pressed[count * body_points + k] = 0.0f;
            gripped[count * body_points + k] = vec3(0.0f, 0.0f, 0.0f);
        }
        planes[count] = plane;
        ++count;
    }
    RigidBody body = start;
    vec3 way_out = vec3(0.0f, 0.0f, 0.0f);
    for (int round = 0; round < body_rounds; ++round) {
        for (int plane = 0; plane < count; ++plane) {
            ColliderRecord record = colliders[push.first + planes[plane]];
            precise float friction = constants.center.w * record.shape.w;
            float depth = 0.0f;
            for (int k = 0; k < points; ++k) {
                int at = plane * body_points + k;
                BodyTouch touch = body_touch(start, constants, k, record, step);
                float normal = normal_impulse(body, constants, touch, pressed[at]);
                precise vec3 push_out = touch.normal * (normal - pressed[at]);
                pressed[at] = normal;
                body = pushed_body(body, constants, touch.arm, push_out);
                precise float most = friction * normal;
                vec3 grip = grip_impulse(body, constants, touch, gripped[at], most);
                precise vec3 held = grip - gripped[at];
                gripped[at] = grip;
                body = pushed_body(body, constants, touch.arm, held);
                depth = touch.depth > depth ? touch.depth : depth;
            }
            precise vec3 led = way_out + vec3(record.shape.x, record.shape.y, record.shape.z) *
                                             (depth < push.recovery ? depth : push.recovery);
            if (round == 0) way_out = led;
        }
    }
    precise vec3 remainder = body.remainder + way_out;
    body.remainder = remainder;  // it moves the body, and is no velocity
    return body;
}
