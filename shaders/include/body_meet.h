// Contact of bodies with each other and with colliders that have no mass: the places where they may touch in a substep,
// then impulses at all of them in sequence (Guendelman and others 2003; Catto 2005), as body_contact.h has them with
// planes. Surfaces are taken where they are when the substep begins. The includer, a shader or the twin, has
// `body_constants`, `colliders`, `push`, the fields of meshes, `met_bodies`, `body_meetings`, and constants that say
// what the scene has. What is large is called from one place: drivers put a copy wherever a function is called.

#if COLLIDER_KINDS != 6
#error "surface_of_shape and find_meetings take the new kind for an ellipsoid"
#endif

/// Returns a number of rounds that compilers do not know.
int unknown_rounds(int count) { return push.body_count > 0 ? count : 0; }

MetBody without_motion() {
    vec4 zero = vec4(0.0f, 0.0f, 0.0f, 0.0f);
    return MetBody(zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero);
}

/// Returns an obstacle where it is when the substep begins.
MetBody met_obstacle(BodyConstants own) {
    ColliderRecord record = colliders[push.first + own.what.y];
    if (obstacles_move) record = at_start(record);
    MetBody met = without_motion();
    met.pose_x = record.pose_x;
    met.pose_y = record.pose_y;
    met.pose_z = record.pose_z;
    met.middle.w = record.way_out.w;
    if (has_hulls) met.field = vec4(record.way_out.x, 0.0f, record.way_out.z, 0.0f);
    return met;
}

/// Returns a body that has its velocity for the substep.
MetBody met_body(RigidBody body, BodyConstants own) {
    MetBody met = without_motion();
    vec3 off = turned_by_quaternion(body.turn, vector_of(own.center));
    precise vec3 middle = body.position - off;
    vec3 x = turned_by_quaternion(body.turn, vec3(1.0f, 0.0f, 0.0f));
    vec3 y = turned_by_quaternion(body.turn, vec3(0.0f, 1.0f, 0.0f));
    vec3 z = turned_by_quaternion(body.turn, vec3(0.0f, 0.0f, 1.0f));
    precise vec3 of_x = x * own.inverse.x;
    precise vec3 of_y = y * own.inverse.y;
    precise vec3 of_z = z * own.inverse.z;
    precise vec3 row_x = of_x * x.x + of_y * y.x + of_z * z.x;
    precise vec3 row_y = of_x * x.y + of_y * y.y + of_z * z.y;
    precise vec3 row_z = of_x * x.z + of_y * y.z + of_z * z.z;
    met.inertia = vec4(row_x.x, row_x.y, row_x.z, row_y.y);
    met.inertia_z = vec4(row_y.z, row_z.z, 0.0f, own.inverse.w);
    if (has_hulls) {
        met.field = vec4(colliders[push.first + own.what.y].way_out.x, 0.0f, 0.0f, 0.0f);
        x = turned_by_quaternion(body.turn, shape_axis(own, vec3(1.0f, 0.0f, 0.0f)));
        y = turned_by_quaternion(body.turn, shape_axis(own, vec3(0.0f, 1.0f, 0.0f)));
        z = turned_by_quaternion(body.turn, shape_axis(own, vec3(0.0f, 0.0f, 1.0f)));
    }
    met.pose_x = vec4(x.x, y.x, z.x, middle.x);
    met.pose_y = vec4(x.y, y.y, z.y, middle.y);
    met.pose_z = vec4(x.z, y.z, z.z, middle.z);
    met.velocity = with_w(body.velocity, 0.0f);
    met.slower = with_w(body.slower, 0.0f);
    met.spin = with_w(body.spin, 0.0f);
    vec3 turning = tensor_product(met.inertia, met.inertia_z, body.spin);
    precise float way = (length_of(body.velocity) + length_of(turning) * own.size.w) * push.gravity.w;
    met.middle = with_w(body.position, way);
    return met;
}

MetShape met_shape(int number) {
    MetBody met = met_bodies[number];
    BodyConstants own = body_constants[number];
    return MetShape(own.what.x, ivec2(own.what.z, own.what.w), vector_of(own.size), vector_of(met.pose_x),
                    vector_of(met.pose_y), vector_of(met.pose_z), vec3(met.pose_x.w, met.pose_y.w, met.pose_z.w),
                    met.field);
}

/// Returns the distance of a place from a surface, and the normal there, in the shape's frame.
SurfacePoint surface_of_shape(MetShape shape, vec3 local) {
    SurfacePoint found = SurfacePoint(shape.size, ordered_dot(local, shape.size));  // a plane's size is its normal
    if (has_balls)
        if (shape.kind == kind_sphere) found = sphere_surface(local, shape.size.x);
    if (has_boxes)
        if (shape.kind == kind_box) found = box_surface(local, shape.size);
    if (has_ellipsoids)
        if (shape.kind == kind_ellipsoid) found = ellipsoid_surface(local, shape.size);
    if (has_capsules)
        if (shape.kind == kind_capsule) found = capsule_surface(local, shape.size);
    if (has_hulls) {
        if (shape.kind == kind_mesh) {
            ColliderRecord record = colliders[0];
            record.way_out = shape.field;
            found = mesh_surface(record, local, 0.0f FIELDS);
        }
    }
    return found;
}

/// Returns the velocity of an obstacle's surface, m/s.
vec3 ground_velocity(int number, vec3 place) {
    vec3 velocity = vec3(0.0f, 0.0f, 0.0f);
    if (obstacles_move) {
        ColliderRecord record = colliders[push.first + body_constants[number].what.y];
        vec3 local = local_at_start(record, place);
        precise vec3 way = surface_displacement(record, local);
        if (has_hulls) {
            if (is_deforming(body_constants[number].what.x, record FIELDS)) {
                precise vec3 more = way + deformation(record, local FIELDS);
                way = more;
            }
        }
        precise vec3 moves = way / push.gravity.w;
        velocity = moves;
    }
    return velocity;
}

void store_place(int next, vec3 place, vec3 normal, float gap) {
    body_meetings[next].arm = with_w(place, 0.0f);
    body_meetings[next].normal = with_w(normal, gap);
}

/// Returns the middle and the radius of the ball of a round, in the frame of the shape whose points are tried.
vec4 point_of(MetShape own, MetShape on, int round, CapsuleWalk walk, int hull_number) {
    vec4 ball = vec4(0.0f, 0.0f, 0.0f, own.size.x);
    if (has_boxes)
        if (own.kind == kind_box)
            ball = vec4((round & 1) == 0 ? -own.size.x : own.size.x, (round & 2) == 0 ? -own.size.y : own.size.y,
                        (round & 4) == 0 ? -own.size.z : own.size.z, 0.0f);
    if (has_ellipsoids) {
        if (own.kind == kind_ellipsoid) {
            precise vec3 scaled = direction_in_shape(own, direction_in_world(on, on.size)) * own.size;
            precise vec3 lowest = scaled * own.size / -length_of(scaled);
            ball = with_w(lowest, 0.0f);
        }
    }
    if (has_capsules)
        if (own.kind == kind_capsule) ball = capsule_ball(own.size, capsule_share(walk, round));
    if (has_hulls)
        if (own.kind == kind_mesh) ball = with_w(hull_point(own.hull.x + (hull_number > 0 ? hull_number : 0)), 0.0f);
    return ball;
}

/// Stores the places where points of each of two may touch the other, from `begin` on; returns the place after the
/// last.
int meet_points(int begin, MetShape first, MetShape second) {
    int own_rounds = point_rounds(first, second.kind);
    int back_rounds = first.kind == kind_sphere && second.kind == kind_sphere ? 0 : point_rounds(second, first.kind);
    int next = begin;
    CapsuleWalk capsule = CapsuleWalk(0.0f, 1.0f, vec2(1.0f, 0.0f));
    HullWalk hull = hull_walk();
    for (int k = 0; k < own_rounds + back_rounds; ++k) {
        bool back = k >= own_rounds;
        int round = back ? k - own_rounds : k;
        MetShape own = first, on = second;
        if (back) {
            own = second;
            on = first;
        }
        if (round == 0) capsule = CapsuleWalk(0.0f, 1.0f, vec2(1.0f, 0.0f));
        int number = 0;
        if (has_hulls) {
            if (round == 0) hull = hull_walk();
            number = own.kind == kind_mesh ? hull_point_number(hull, round, own.hull.y) : 0;
        }
        vec4 ball = point_of(own, on, round, capsule, number);
        vec3 place = place_in_world(own, vector_of(ball));
        SurfacePoint found = surface_of_shape(on, place_in_shape(on, place));
        vec3 normal = direction_in_world(on, found.normal);
        precise float gap = found.distance - ball.w;
        bool touches = true;
        if (has_capsules) {
            if (own.kind == kind_capsule) {
                float share = capsule_share(capsule, round);
                if (round >= 2 && round < halvings + 2) capsule = capsule_halved(capsule, own, share, normal);
                if (has_boxes)
                    if (round == halvings + 2 && on.kind == kind_box)
                        capsule.over = shares_over_face(own, on, found.normal);
                touches = capsule_touches(capsule, round, share);
            }
        }
        if (has_hulls) {
            if (own.kind == kind_mesh) {
                precise float slack = length_of(own.size) * 0.01f;
                touches = number >= 0 && round >= 2 * own.hull.y;
                if (round < 2 * own.hull.y) hull = hull_walked(hull, round, own.hull.y, place, normal, gap, slack);
            }
        }
        precise vec3 between = place - normal * (ball.w + gap * 0.5f);
        if (touches) store_place(next, between, back ? -normal : normal, gap);
        next = touches ? next + 1 : next;
    }
    return next;
}

PlacedBox placed_box(MetShape shape) {
    return PlacedBox(shape.middle, vec3(shape.x.x, shape.y.x, shape.z.x), vec3(shape.x.y, shape.y.y, shape.z.y),
                     vec3(shape.x.z, shape.y.z, shape.z.z), shape.size);
}

/// The same of two boxes.
int meet_boxes(int begin, MetShape first, MetShape second) {
    PlacedBox a = placed_box(first), b = placed_box(second);
    BoxAxis axis = separating_axis(a, b, unknown_rounds(box_axis_count));
    bool edges = axis.first >= 0 && axis.second >= 0, own = axis.first >= 0;
    PlacedBox box = a, other = b;
    if (!own) {
        box = b;
        other = a;
    }
    int across = own ? axis.first : axis.second, next = begin;
    vec3 outward = own ? -axis.normal : axis.normal;
    vec3 nearest = between_edges(a, b, axis);
    FacingFace face = facing_face(box, across, outward, other);
    for (int k = 0; k < unknown_rounds(face_corner_count); ++k) {
        FaceCorner corner = face_corner(face, k);
        bool touches = edges ? k == 0 : corner.is_one && next < begin + pair_meetings;
        vec3 place = edges ? nearest : beside_face(box, across, outward, corner.place);
        if (touches) store_place(next, place, axis.normal, edges ? axis.gap : corner.place.z);
        next = touches ? next + 1 : next;
    }
    return next;
}

/// What an impulse at a point of a body finds there.
struct PointMotion {
    vec3 velocity;                   // m/s
    vec3 yield_x, yield_y, yield_z;  // columns of the change of that by an impulse, 1/kg
};

PointMotion motion_at(MetBody body, vec3 arm) {
    vec4 inertia = body.inertia, inertia_z = body.inertia_z;
    precise vec3 velocity =
        vector_of(body.velocity) + ordered_cross(tensor_product(inertia, inertia_z, vector_of(body.spin)), arm);
    float mass = inertia_z.w;
    precise vec3 x =
        vec3(mass, 0.0f, 0.0f) + ordered_cross(tensor_product(inertia, inertia_z, vec3(0.0f, arm.z, -arm.y)), arm);
    precise vec3 y =
        vec3(0.0f, mass, 0.0f) + ordered_cross(tensor_product(inertia, inertia_z, vec3(-arm.z, 0.0f, arm.x)), arm);
    precise vec3 z =
        vec3(0.0f, 0.0f, mass) + ordered_cross(tensor_product(inertia, inertia_z, vec3(arm.y, -arm.x, 0.0f)), arm);
    return PointMotion(velocity, x, y, z);
}

/// Returns the meeting of a pair, its first a body, at a place where they are `gap` apart.
BodyMeeting new_meeting(ivec2 pair, vec3 place, vec3 normal, float gap) {
    bool both = pair.y < push.body_count;
    vec3 zero = vec3(0.0f, 0.0f, 0.0f), ground = ground_velocity(pair.y, place), arm = zero, beside = zero;
    if (both) ground = zero;
    PointMotion sum = PointMotion(-ground, zero, zero, zero);
    for (int k = 0; k < unknown_rounds(2); ++k) {
        MetBody body = met_bodies[k == 0 || !both ? pair.x : pair.y];
        precise vec3 own_arm = place - vector_of(body.middle);
        PointMotion own = motion_at(body, own_arm);
        precise vec3 velocity = k == 0 ? sum.velocity + own.velocity : sum.velocity - own.velocity;
        precise vec3 x = sum.yield_x + own.yield_x;
        precise vec3 y = sum.yield_y + own.yield_y;
        precise vec3 z = sum.yield_z + own.yield_z;
        if (k == 0) arm = own_arm;
        if (k == 1 && both) beside = own_arm;
        if (k == 0 || both) sum = PointMotion(velocity, x, y, z);
    }
    precise float friction = body_constants[pair.x].center.w * body_constants[pair.y].center.w;
    precise float least = gap > 0.0f ? -gap / push.gravity.w : 0.0f;
    precise vec3 yields = sum.yield_x * normal.x + sum.yield_y * normal.y + sum.yield_z * normal.z;
    precise float mass = 1.0f / ordered_dot(normal, yields);
    return BodyMeeting(
        with_w(arm, friction), with_w(beside, gap < 0.0f ? -gap : 0.0f), with_w(normal, least), with_w(ground, 0.0f),
        vec4(0.0f, 0.0f, 0.0f, mass), vec4(sum.yield_x.x, sum.yield_x.y, sum.yield_x.z, sum.yield_y.y),
        vec4(sum.yield_y.z, sum.yield_z.z, length_of(sum.velocity), 0.0f), ivec4(pair.x, both ? pair.y : -1, 0, 0));
}

/// Makes meetings of the places of a pair, but for those too far apart to touch in the substep; the deepest alone has
/// a depth. Returns the place after the last.
int make_meetings(int begin, int end, ivec2 pair) {
    float reach = body_constants[pair.x].size.w, others = body_constants[pair.y].size.w, depth = 0.0f;
    reach = others < reach ? others : reach;
    int next = begin, deepest = -1;
    for (int k = begin; k < end; ++k) {
        vec4 place = body_meetings[k].arm, normal = body_meetings[k].normal;
        BodyMeeting made = new_meeting(pair, vector_of(place), vector_of(normal), normal.w);
        precise float way = made.yields_z.z * push.gravity.w * 2.0f + reach * 0.02f;
        bool touches = !(normal.w > way);
        bool deeper = touches && made.beside.w > depth;
        depth = deeper ? made.beside.w : depth;
        deepest = deeper ? next : deepest;
        made.beside.w = 0.0f;
        if (touches) body_meetings[next] = made;
        next = touches ? next + 1 : next;
    }
    if (deepest >= 0) body_meetings[deepest].beside.w = depth;
    return next;
}

/// Returns whether a body may come to another, or to an obstacle, in the substep.
bool may_meet(ivec2 pair, vec3 one, vec3 other) {
    precise vec3 apart = one - other;
    precise float way = (met_bodies[pair.x].middle.w + met_bodies[pair.y].middle.w) * 2.0f;
    precise float most = way + (body_constants[pair.x].size.w + body_constants[pair.y].size.w) * 1.05f;
    return body_constants[pair.y].what.x == kind_plane || length_of(apart) < most;
}

/// Finds the meetings of a pair, after which a place says that there are no more.
void find_meetings(int number, int all) {
    ivec2 pair = ivec2(number / all, number - number / all * all);
    if (pair.y <= pair.x) return;
    int begin = number * pair_meetings, end = begin;
    MetShape first = met_shape(pair.x), second = met_shape(pair.y);
    if (may_meet(pair, first.middle, second.middle)) {
        bool boxes = boxes_meet && first.kind == kind_box && second.kind == kind_box;
        if (boxes_meet)
            if (boxes) end = meet_boxes(begin, first, second);
        if (!boxes) end = meet_points(begin, first, second);
    }
    end = make_meetings(begin, end, pair);
    if (end < begin + pair_meetings) body_meetings[end].who.x = -1;
}

/// Lists the meetings of all pairs, each by its place, in who.w of the first places, and returns their number.
int listed_meetings(int all) {
    int count = 0;
    for (int pair = 0; pair < push.body_count * all; ++pair) {
        if (pair - pair / all * all <= pair / all) continue;
        for (int k = 0; k < pair_meetings; ++k) {
            int place = pair * pair_meetings + k;
            if (body_meetings[place].who.x < 0) break;
            body_meetings[count].who.w = place;
            ++count;
        }
    }
    return count;
}

vec3 point_velocity(int number, vec3 arm) {
    vec3 turning =
        tensor_product(met_bodies[number].inertia, met_bodies[number].inertia_z, vector_of(met_bodies[number].spin));
    precise vec3 velocity = vector_of(met_bodies[number].velocity) + ordered_cross(turning, arm);
    return velocity;
}

void push_body(int number, vec3 arm, vec3 impulse) {
    vec3 before = vector_of(met_bodies[number].velocity);
    precise vec3 gain = impulse * met_bodies[number].inertia_z.w + vector_of(met_bodies[number].slower);
    precise vec3 velocity = before + gain;
    precise vec3 slower = gain - (velocity - before);
    precise vec3 spin = vector_of(met_bodies[number].spin) + ordered_cross(arm, impulse);
    met_bodies[number].velocity = with_w(velocity, 0.0f);
    met_bodies[number].slower = with_w(slower, 0.0f);
    met_bodies[number].spin = with_w(spin, 0.0f);
}

/// Returns the friction's impulse, N s, at most `most`, of a meeting that had another, with a velocity along the
/// surfaces, m/s.
vec3 meeting_grip(BodyMeeting meeting, vec3 along, float most) {
    vec3 grip = vector_of(meeting.grip);
    float speed = length_of(along);
    if (speed > 0.0f) {
        precise vec3 direction = along / speed;
        float yielding = ordered_dot(direction, tensor_product(meeting.yields, meeting.yields_z, direction));
        precise vec3 held = grip - direction * (speed / yielding);
        grip = held;
    }
    float size = length_of(grip);
    if (!(size > most)) return grip;
    precise vec3 limited = grip * (most / size);
    return limited;
}

/// Gives two that meet what another round finds, which never pulls and has Coulomb's friction. Returns the impulse
/// along the normal and the larger of both impulses' changes, N s.
vec2 solve_meeting(int place) {
    BodyMeeting meeting = body_meetings[place];
    vec3 normal = vector_of(meeting.normal), arm = vector_of(meeting.arm), beside = vector_of(meeting.beside);
    vec3 others = vector_of(meeting.ground);
    if (meeting.who.y >= 0) others = point_velocity(meeting.who.y, beside);
    precise vec3 velocity = point_velocity(meeting.who.x, arm) - others;
    precise float wanted = meeting.ground.w + (meeting.normal.w - ordered_dot(velocity, normal)) * meeting.grip.w;
    float pressed = wanted > 0.0f ? wanted : 0.0f;
    precise float change = pressed - meeting.ground.w;
    precise vec3 out_of = normal * change;
    precise vec3 after = velocity + tensor_product(meeting.yields, meeting.yields_z, out_of);
    precise vec3 along = after - normal * ordered_dot(after, normal);
    precise float most = meeting.arm.w * pressed;
    vec3 grip = meeting_grip(meeting, along, most);
    precise vec3 more = grip - vector_of(meeting.grip);
    precise vec3 impulse = out_of + more;
    push_body(meeting.who.x, arm, impulse);
    if (meeting.who.y >= 0) push_body(meeting.who.y, beside, -impulse);
    body_meetings[place].ground.w = pressed;
    body_meetings[place].grip = with_w(grip, meeting.grip.w);
    float gripped = length_of(more);
    return vec2(pressed, abs(change) > gripped ? abs(change) : gripped);
}

/// Marks two that touch, and leads them apart where they overlap, each by the other's share of their masses, by what a
/// substep resolves of a depth. That moves them, and is no velocity. What it does to the angular momentum of two that
/// slide goes off their own.
void end_meeting(int place) {
    ivec4 who = body_meetings[place].who;
    vec3 normal = vector_of(body_meetings[place].normal);
    bool both = who.y >= 0, touched = body_meetings[place].ground.w > 0.0f;
    float depth = body_meetings[place].beside.w;
    depth = depth < push.recovery ? depth : push.recovery;
    for (int k = 0; k < (both ? 2 : 1); ++k) {
        int own = k == 0 ? who.x : who.y, other = k == 0 && both ? who.y : who.x;
        float mass = met_bodies[own].inertia_z.w, others = both ? met_bodies[other].inertia_z.w : 0.0f;
        precise vec3 way = normal * ((k == 0 ? depth : -depth) / (mass + others));
        precise vec3 slides =
            (vector_of(met_bodies[own].velocity) - vector_of(met_bodies[other].velocity)) / (mass + others);
        precise vec3 led = vector_of(met_bodies[own].led) + way * mass;
        precise vec3 spin = vector_of(met_bodies[own].spin) - ordered_cross(way, slides) * mass;
        met_bodies[own].led = with_w(led, touched ? 1.0f : met_bodies[own].led.w);
        met_bodies[own].spin = with_w(spin, 0.0f);
    }
}

const int meeting_rounds = 128;        // over all meetings, at most
const int all_meeting_rounds = 40000;  // one invocation may not have more (most_loop_rounds)

/// Finds the impulses at all meetings, round by round until none changes by more than a millionth of the largest.
void meet_all(int all) {
    int count = listed_meetings(all), most = count > 0 ? all_meeting_rounds / count : 0;
    if (most == 0 && count > 0) most = 1;
    for (int round = 0; round < most && round < meeting_rounds; ++round) {
        float largest = 0.0f, changed = 0.0f;
        for (int k = 0; k < count; ++k) {
            vec2 found = solve_meeting(body_meetings[k].who.w);
            largest = found.x > largest ? found.x : largest;
            changed = found.y > changed ? found.y : changed;
        }
        precise float allowed = largest * 1.0e-6f;
        if (!(changed > allowed)) break;
    }
    for (int k = 0; k < count; ++k) end_meeting(body_meetings[k].who.w);
}

/// Returns a body after its meetings.
RigidBody body_after_meetings(int number, RigidBody body) {
    precise vec3 remainder = body.remainder + vector_of(met_bodies[number].led);
    body.remainder = remainder;
    body.velocity = vector_of(met_bodies[number].velocity);
    body.slower = vector_of(met_bodies[number].slower);
    body.spin = vector_of(met_bodies[number].spin);
    return body;
}
