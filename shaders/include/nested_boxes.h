// Iterations over boxes around lone pins, with a workgroup per pin. The pins of a dispatch have boxes that share no
// particle. A pin that has let go is skipped. `masked` is as in line.comp; where `sheared`, there are diagonal springs.
// The includer defines how the lines of a direction are solved (sweep_direction).
#include "include/push.h"
CLOTH_CONSTANTS(NestedPush)
#define TOGETHER
#include "include/state_store.h"
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform coherent readonly image2D displacement_in;
COHERENT_TRIPLE_OUT(2, displacement_out);
layout(set = 0, binding = 3, std430) readonly buffer NestedBoxes { ivec4 nested_boxes[]; };
layout(set = 0, binding = 6, r32f) uniform coherent readonly image2D tension_row_in;
COHERENT_SCALAR_OUT(7, tension_row_out);
layout(set = 0, binding = 8, r32f) uniform coherent readonly image2D tension_column_in;
COHERENT_SCALAR_OUT(9, tension_column_out);
layout(constant_id = 24) const bool sheared = false;
layout(set = 0, binding = 10, r32f) uniform coherent readonly image2D tension_shear_down_right_in;
COHERENT_SCALAR_OUT(11, tension_shear_down_right_out);
layout(set = 0, binding = 12, r32f) uniform coherent readonly image2D tension_shear_down_left_in;
COHERENT_SCALAR_OUT(13, tension_shear_down_left_out);
layout(constant_id = 21) const bool masked = false;
layout(set = 0, binding = 14, rgba32f) uniform readonly image2D spring_shares;
layout(set = 0, binding = 15, r32ui) uniform readonly uimage2D line_control;
#include "include/rest_length.h"

/// A line of a direction within a box.
struct NestedLine {
    ivec2 box_first, step;
    int columns;                       // columns of the box
    int index, direction, seam, last;  // last: index of its last particle
    float share;                       // share of all its springs, unless an image has their shares
    float rest_length, compliance, followed, per_followed, compression;
    float shared_compliance;  // for springs with the share `share`
};

struct NestedParticle {
    ivec2 in_box, at;  // at: texel in the sheet
    vec4 position;     // w: inverse mass on which its springs act, with the wind's drag
    vec4 displacement;
};

float load_tension(int direction, ivec2 at) {
    float tension = 0.0f;
    if (direction == 0) tension = LOAD(tension_row_in, at).x;
    if (direction == 1) tension = LOAD(tension_column_in, at).x;
    if (!sheared) return tension;
    if (direction == 2) tension = LOAD(tension_shear_down_right_in, at).x;
    if (direction == 3) tension = LOAD(tension_shear_down_left_in, at).x;
    return tension;
}

void store_tension(int direction, ivec2 at, float tension) {
    if (direction == 0) STORE_SCALAR(tension_row_out, at, tension);
    if (direction == 1) STORE_SCALAR(tension_column_out, at, tension);
    if (!sheared) return;
    if (direction == 2) STORE_SCALAR(tension_shear_down_right_out, at, tension);
    if (direction == 3) STORE_SCALAR(tension_shear_down_left_out, at, tension);
}

float share_of(NestedLine line, NestedParticle first) {
    float share = line.share;
    if (masked) share = LOAD(spring_shares, first.at)[line.direction];
    return first.in_box.x == line.seam ? 0.0f : share;
}

NestedParticle load_particle(NestedLine line, ivec2 in_box) {
    ivec2 at = line.box_first + in_box;
    vec4 start = LOAD(position, at), moved = LOAD(displacement_in, at);
    return NestedParticle(in_box, at, vec4(start.xyz, dragged_weight(start.w, moved.w)), moved);
}

NestedParticle next_particle(NestedLine line, NestedParticle particle, ivec2 step) {
    return load_particle(line, next_on_line(particle.in_box, step, line.columns));
}

LineSpring spring_between(NestedLine line, NestedParticle first, NestedParticle second) {
    return line_spring(
        spring_edge(first.position.xyz, second.position.xyz, first.displacement.xyz, second.displacement.xyz),
        length_at_rest(line.rest_length, first.at, line.direction));
}

/// Returns a line of a direction without its index and its share.
NestedLine line_of(NestedBox box, int direction, bool second_order) {
    ivec2 step = nested_step(direction);
    float followed = second_order ? push.followed_bdf2[direction] : push.followed[direction];
    return NestedLine(box.first, step, box.size.x, 0, direction, nested_seam(step, box.size.x),
                      (step.y == 0 ? box.size.x : box.size.y) - 1, 0.0f, push.rest_length[direction],
                      second_order ? push.compliance_bdf2[direction] : push.compliance[direction], followed,
                      reciprocal(followed), push.compression, 0.0f);
}

int line_count(NestedBox box, NestedLine line) { return line.step.y == 0 ? box.size.y : box.size.x; }

/// Sets the share of the springs of line `line.index`.
void find_share(inout NestedLine line) {
    line.share = border_share(line.box_first + line_start(line.index, line.step), line.step, push.grid);
    line.shared_compliance = shared_compliance(line.compliance, line.share);
}

/// Solves all lines of a direction. Every invocation of the workgroup must call it.
void sweep_direction(NestedBox box, NestedLine line);

void sweep_order(NestedBox box, int order, bool second_order) {
    int direction = nested_direction(order);
    if (push.rest_length[direction] > 0.0f) sweep_direction(box, line_of(box, direction, second_order));
    memoryBarrier();
    barrier();
}

void main() {
    // Each cloth of the dispatch has its own table; all tables have the same length.
    int first = nested_boxes.length() / cloths_together() * int(cloth_place());
    ivec2 pin = nested_boxes[first + given.first_pin + int(gl_WorkGroupID.x)].xy;
    if (LOAD(position, pin).w != 0.0f) return;
    bool second_order = imageLoad(line_control, ivec2(control_order, cloth_place())).x == 2u;
    int block = 0;
    do {
        NestedBox box = nested_box(pin, nested_boxes[block].xy, push.grid);
        int sweep = 0;
        do {
            // This is not a loop: compiled for one direction at a time, the code reads the tension of that direction
            // alone.
            sweep_order(box, 0, second_order);
            sweep_order(box, 1, second_order);
            sweep_order(box, 2, second_order);
            sweep_order(box, 3, second_order);
            ++sweep;
        } while (sweep < nested_boxes[block].z);
        ++block;
    } while (block < push.block_count);
}
