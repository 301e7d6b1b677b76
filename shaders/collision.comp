// This pass moves every particle out of every collider, with friction. It is specialised to the kinds of colliders that
// the scene has. A particle that is touched has the velocity of the displacement that it is left with. In
// `second_order` the cloth continues in backward Euler substeps (include/bdf2.h). With `after_edges`, the pass starts
// from what collider_edges.comp left. Where `supporting`, it stores the surfaces on which particles lie, for contact
// between cloths. With `after_impulses` it does that too, starts from the displacements that contact between cloths
// left on their sheet, and writes the result there as well. Where it `books`, it sums what each collider gives, and where
// it `keeps_contact`, what all of them give to each particle.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/line_types.h"
#include "shared/self_contact_types.h"
#include "shared/simulation_types.h"
layout(constant_id = 28) const bool books = false;
#define ON_CONTACT(number, contact, before) \
    if (books && contact.depth > 0.0f) take(number, given_by_collider(contact.displacement, contact.led, before));
void take(int number, vec3 given);
#include "include/impulses.h"
#include "include/contacts.h"
#include "include/push.h"

layout(local_size_x = workgroup_width) in;
layout(constant_id = 16) const int round_count = 1;  // 1 if the scene has one collider, which overlaps no other
layout(constant_id = 17) const int strip_rows = 1;   // particles of a column that an invocation processes, 32 at most
CLOTH_CONSTANTS(CollisionPush)
#define TOGETHER
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position_in;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
VECTOR_OUT(2, displacement_out);
VECTOR_KEPT(3, displacement_before);
VECTOR_KEPT(18, displacement_remainder);
layout(constant_id = 22) const bool second_order = false;
layout(set = 0, binding = 4, r32ui) uniform uimage2D line_control;
layout(constant_id = 24) const bool after_edges = false;
layout(set = 0, binding = 6, rgba32f) uniform readonly image2D lifted;
layout(constant_id = 25) const bool supporting = false;
layout(set = 0, binding = 8, rgba32f) uniform writeonly image2D support;
layout(set = 0, binding = 9, rgba32f) uniform writeonly image2D support_grip;
layout(constant_id = 26) const bool after_impulses = false;
layout(set = 0, binding = 11, rgba32f) uniform readonly image2D displacements_in;  // w: bits (self_sheet.h)
VECTOR_OUT(12, displacements_out);
layout(set = 0, binding = 13, std430) buffer Before { vec4 before[]; };  // w: self_pushed and those beside it
layout(set = 0, binding = 14, std430) writeonly buffer LedWays { vec4 led_ways[]; };
TRIPLE_OUT(10, position_out);  // not with `after_impulses`
#define IMPULSES_SLOT 17  // the skin has 16
#include "include/book_impulses.h"
layout(constant_id = 33) const bool keeps_contact = false;
layout(set = 0, binding = 19, rgba32f) uniform image2D contact_impulses;

vec2 skin_at(ivec2 texel) { return skin_of(placed(texel).y * push.grid.x + texel.x, push.contact.xy); }

vec4 moved_at(ivec2 texel) {
    if (after_impulses) return imageLoad(displacements_in, push.laid + texel);
    return LOAD(displacement_in, texel);
}

/// Stores a displacement in the place where `moved_at` found `moved`.
void leave(ivec2 texel, vec3 displacement, vec4 moved) {
    if (after_impulses) {
        STORE_IN_COLUMNS(displacements_out, push.laid + texel, push.sheet_columns, vec4(displacement, moved.w));
        moved = LOAD(displacement_in, texel);
    }
    STORE_VECTOR(displacement_out, texel, vec4(displacement, moved.w));
}

/// Leads a particle out of an overlap and returns the displacement to store. The way out is no velocity, so it is
/// removed from `displacement` and moves the particle's start instead; or, after impulses, contact between cloths
/// treats it as a motion, of which it allows the part that crosses nothing (self_return.comp).
vec3 led_out(ivec2 texel, vec4 start, inout vec3 displacement, vec3 way_out) {
    vec3 whole = displacement, led = led_sum(start.xyz, way_out);
    displacement = displacement_of_own(displacement, way_out);
    if (!after_impulses) {
        STORE_TRIPLE(position_out, texel, led, start.w);
        return displacement;
    }
    vec3 way = way_between(start.xyz, led);
    if (is_rounding(start.xyz, way)) return displacement;
    ivec2 laid = push.laid + texel;
    int place = laid.y * push.sheet_columns + laid.x;
    led_ways[place] = vec4(way, 0.0f);
    before[place].w = before[place].w != 0.0f ? self_pushed_and_led : self_led_out;
    return whole;
}

/// Adds to what the substep lost of a particle's displacement, with the mark that a collider touched it (gas_sum.comp).
void keep_lost(ivec2 texel, vec3 lost) {
    vec4 remainder;
    LOAD_VECTOR(remainder, displacement_remainder, texel)
    STORE_VECTOR(displacement_remainder, texel, vec4(led_sum(remainder.xyz, lost), 1.0f));
}

/// Returns the displacement with which a particle comes to the colliders; w is above 0 if an edge of a collider moved
/// it: 1 and the collider's number.
vec4 led_displacement(ivec2 texel, vec4 moved) {
    if (after_edges) return LOAD(lifted, texel);
    return vec4(moved.xyz, 0.0f);
}

/// A part of a column.
struct Strip {
    int column, first, count;
    vec3 lower, upper;  // corners of the box that holds its particles at their next positions, m
    float way;          // the largest motion of one of them, m
    uint rows;          // rows whose particles may meet a collider, or have touched an edge: bit k is row k
};

Strip strip_at(int column, int first, int count) {
    Strip strip = Strip(column, first, count, vec3(1.0e30f), vec3(-1.0e30f), 0.0f, 0u);
    int k = 0;
    do {  // loops have their tests at the bottom (include/every.h)
        ivec2 texel = ivec2(column, first + k);
        vec4 start = LOAD(position_in, texel), led = led_displacement(texel, moved_at(texel));
        vec3 now = moved_position(start.xyz, led.xyz);
        float way = length_of(led.xyz);
        bool near = !leaves_out || led.w > 0.0f || near_early(now, way, skin_at(texel).x);
        strip.way = way > strip.way ? way : strip.way;
        strip.rows |= near && start.w != 0.0f ? 1u << k : 0u;
        strip.lower = least_of_each(strip.lower, now);
        strip.upper = largest_of_each(strip.upper, now);
        ++k;
    } while (k < count);
    return strip;
}

/// Returns those of at most 32 colliders from the `begin`-th on that are near a strip: bit k is the k-th of these.
uint near_colliders(Strip strip, int begin, int count) {
    uint near = 0u;
    for (int k = 0; k < count; ++k) {
        vec4 ball = collider_ball(push.first, begin + k, strip.way, push.contact.x);
        near |= near_ball(ball, strip.lower, strip.upper, push.contact.x) ? 1u << k : 0u;
    }
    return near;
}

/// Returns the rows of a strip that may touch a collider after the early ones.
uint late_rows(Strip strip) {
    uint rows = 0u;
    for (int begin = early_collider_count; begin < meshes_end; begin += 32)
        for (uint near = near_colliders(strip, begin, min(32, meshes_end - begin)); near != 0u; near &= near - 1u) {
            vec4 ball = collider_ball(push.first, begin + findLSB(near), strip.way, push.contact.x);
            for (int k = 0; k < strip.count; ++k) {
                ivec2 texel = ivec2(strip.column, strip.first + k);
                vec4 start = LOAD(position_in, texel), moved = moved_at(texel);
                vec3 now = moved_position(start.xyz, led_displacement(texel, moved).xyz);
                bool meets = near_ball(ball, now, now, push.contact.x) && start.w != 0.0f;
                rows |= meets ? 1u << k : 0u;
            }
        }
    return rows;
}

/// What a collider gives to the motion of a particle, m, and the sums of what it gave to particles of the strip. Where
/// there are no more colliders, each has a place; else places go to those that a particle touches, and the last of
/// these has what those beyond give, too.
const int most_givers = 3, giver_count = meshes_end < most_givers ? meshes_end : most_givers;
const bool all_have_places = meshes_end <= most_givers;
struct Giver {
    int number;  // of what is given to the particle; -1: nothing is
    vec3 motion;
    int summed;  // of what is in the sums; -1: nothing is
    ImpulseSum impulse, moment;
} givers[most_givers];

void begin_sums(int k) {
    givers[k].summed = -1;
    givers[k].impulse = no_impulse();
    givers[k].moment = no_impulse();
}

bool take_as(int k, int number, vec3 given) {
    bool here = givers[k].number == number || givers[k].number < 0 || k == giver_count - 1;
    if (all_have_places) here = k == number;
    if (here) givers[k].number = givers[k].number < 0 ? number : givers[k].number;
    if (here) givers[k].motion = moved_position(givers[k].motion, given);
    return here;
}

vec3 given_by_all;  // what all colliders give to the motion of a particle, m

// A loop that is unrolled would lose that its sums are not to be contracted.
void take(int number, vec3 given) {
    if (keeps_contact) given_by_all = moved_position(given_by_all, given);
    if (take_as(0, number, given)) return;
    if (giver_count > 1)
        if (take_as(1, number, given)) return;
    if (giver_count > 2) take_as(2, number, given);
}

void take_from_nobody() {
    given_by_all = vec3(0.0f);
    [[unroll]] for (int k = 0; k < most_givers; ++k) {
        givers[k].number = -1;
        givers[k].motion = vec3(0.0f);
    }
}

/// Adds the sums of a place to those of the frame.
void book_giver(int k) {
    if (givers[k].summed < 0) return;
    book(impulse_first + givers[k].summed, 0, givers[k].impulse);
    book(impulse_first + givers[k].summed, 3, givers[k].moment);
    begin_sums(k);
}

float units;

/// Adds what a collider gave to a particle, whose displacement was `displacement` then, to the sums.
void add_motion_of(int k, vec4 start, vec3 displacement, float mass) {
    if (givers[k].number < 0) return;
    // On the default device a branch that nobody takes costs as much, so there is none where places do not change.
    if (!all_have_places)
        if (givers[k].number != givers[k].summed) book_giver(k);
    givers[k].summed = givers[k].number;
    ColliderRecord collider = early_colliders[k];
    if (!all_have_places) collider = colliders[push.first + givers[k].number];
    vec3 centre = vec3(collider.pose_x.w, collider.pose_y.w, collider.pose_z.w);
    givers[k].impulse = with_impulse(givers[k].impulse, impulse_of_motion(givers[k].motion, mass), units);
    vec3 moment = moment_about(start.xyz, displacement, centre, givers[k].motion);
    givers[k].moment = with_impulse(givers[k].moment, impulse_of_motion(moment, mass), units);
}

void add_given(ivec2 texel, vec4 start, vec3 displacement) {
    float mass = reciprocal(start.w);
    if (keeps_contact) {
        vec3 sum = moved_position(LOAD(contact_impulses, texel).xyz, impulse_of_motion(given_by_all, mass));
        imageStore(contact_impulses, placed(texel), vec4(sum, 0.0f));
    }
    add_motion_of(0, start, displacement, mass);
    if (giver_count > 1) add_motion_of(1, start, displacement, mass);
    if (giver_count > 2) add_motion_of(2, start, displacement, mass);
}

void book_givers() {
    book_giver(0);
    if (giver_count > 1) book_giver(1);
    if (giver_count > 2) book_giver(2);
}

/// Makes the cloth continue in backward Euler substeps. Reading first avoids an atomic, since most particles that come
/// here find the hold set.
void hold_order() {
    if (imageLoad(line_control, ivec2(control_hold, cloth_place())).x < line_hold_contact)
        imageAtomicMax(line_control, ivec2(control_hold, cloth_place()), line_hold_contact);
}

/// Applies contact to a particle. Returns false, without doing so, if the particle goes so far that its path must be
/// followed, unless this call `follows` it, which takes several times as long.
bool meet_all(ivec2 texel, bool follows) {
    vec4 start = LOAD(position_in, texel), moved = moved_at(texel), led = led_displacement(texel, moved);
    vec3 displacement = led.xyz;
    vec2 own = skin_at(texel);
    bool touched = led.w > 0.0f, went_far = false;
    if (books) take_from_nobody();
    if (books && touched) take(int(led.w) - 1, given_by_collider(led.xyz, vec3(0.0f), moved.xyz));
    // The way out of one collider may lead into another, so this repeats until nothing is touched any more.
    int round = 0;
    vec3 normal = vec3(0.0f);
    vec4 grip = vec4(0.0f);
    vec3 way_out = vec3(0.0f), lost = vec3(0.0f);
    do {
        Contact contact = contact_with_all(push.first, start.xyz, displacement, own.x, own.y, push.contact.w, true, follows,
                                           went_far);
        displacement = contact.displacement;
        touched = touched || contact.depth > 0.0f;
        normal = contact.depth > 0.0f ? contact.normal : normal;
        grip = contact.depth > 0.0f ? contact.grip : grip;
        way_out = round == 0 ? contact.led : way_out;
        lost = contact.depth > 0.0f ? contact.lost : lost;
        if (!(contact.depth > push.contact.z)) break;
        ++round;
    } while (round < round_count);
    if (went_far && !follows) return false;
    if (!touched) return true;
    if (books) add_given(texel, start, displacement);
    vec3 made = way_out.x != 0.0f || way_out.y != 0.0f || way_out.z != 0.0f
                    ? led_out(texel, start, displacement, way_out)
                    : displacement;
    leave(texel, made, moved);
    keep_lost(texel, lost);
    bool lies = supporting && (normal.x != 0.0f || normal.y != 0.0f || normal.z != 0.0f);
    if (supporting) {
        vec3 touches = displacement;
        if (after_impulses) touches = grip.xyz;  // the next substep starts where this one leaves the particle
        if (lies) {  // otherwise an edge of a collider moved it
            imageStore(support, placed(texel), vec4(normal, ordered_dot(normal, touches)));
            imageStore(support_grip, placed(texel), grip);
        }
    }
    // No rebound is derived from a touch: the previous substep's displacement becomes the particle's own. Contact
    // between cloths still needs it, and self_return.comp replaces it after that.
    if (after_impulses || !lies) STORE_VECTOR(displacement_before, texel, vec4(displacement, 0.0f));
    if (second_order) hold_order();
    return true;
}

void main() {
    push.first = given.first + push.list;
    read_colliders(push.first);
    if (books) {
        units = impulse_units();
        [[unroll]] for (int k = 0; k < most_givers; ++k) begin_sums(k);
    }
    int column = int(gl_GlobalInvocationID.x), first = int(gl_GlobalInvocationID.y) * strip_rows;
    if (column >= push.grid.x || first >= push.grid.y) return;
    Strip strip = strip_at(column, first, min(strip_rows, push.grid.y - first));
    if (meshes_end > early_collider_count) strip.rows |= late_rows(strip);
    // The default device runs a loop's body at least once for all lanes: here once for a strip instead of once for a
    // particle. For the same reason particles that go far have a loop of their own.
    uint rows = strip.rows, far = 0u;
    do {
        if (rows != 0u && !meet_all(ivec2(column, first + findLSB(rows)), false)) far |= 1u << findLSB(rows);
        rows &= max(rows, 1u) - 1u;
    } while (rows != 0u);
    do {
        if (far != 0u) meet_all(ivec2(column, first + findLSB(far)), true);
        far &= max(far, 1u) - 1u;
    } while (far != 0u);
    if (books) book_givers();
}
