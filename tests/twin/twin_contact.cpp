// These passes of the twin are contact with colliders.
#include <algorithm>

#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/mesh_twin.h"
#include "twin/triangles_around.h"
#include "twin/twin.h"
#include "twin/twin_impulses.h"

namespace drape {

using namespace glsl;

namespace {

/// Finds the displacement by which the triangles around a particle ask it to leave a box or a mesh.
struct ColliderEdges {
    const ClothModel& model;
    const TwinCloth& state;
    Field from;  ///< field of the displacements to start from
    CollisionPush push;
    const vec4* fields;

    bool near(int kind, vec3 local, const ColliderRecord& collider) const {
        if (kind == kind_mesh)
            return near_mesh(local, touching_plane(local, true_mesh(collider), fields), collider, push.contact.x);
        return kind == kind_box && near_box_edge(local, xyz(collider.shape), push.contact.x);
    }

    std::size_t place(ivec2 texel) const {
        return model.grid.particle(static_cast<std::uint32_t>(texel.x), static_cast<std::uint32_t>(texel.y));
    }

    CutCorner corner_at(ivec2 texel, const ColliderRecord& collider) const {
        const vec4 start = state[Field::position][place(texel)];
        const vec3 moved = xyz(state[from][place(texel)]);
        return {local_point(collider, moved_position(xyz(start), moved)), moved, start.w};
    }

    /// Returns the place of a particle, or where the line from `far` through `end` goes on if there is none.
    vec3 place_of(ivec2 texel, vec3 far, vec3 end, const ColliderRecord& collider) const {
        const bool is_there = texel.x >= 0 && texel.y >= 0 && texel.x < push.grid.x && texel.y < push.grid.y;
        return is_there ? corner_at(texel, collider).local : mirrored(far, end);
    }

    EdgeLine line_of(ivec2 first, ivec2 last, vec3 a, vec3 b, const ColliderRecord& collider) const {
        return {place_of({2 * first.x - last.x, 2 * first.y - last.y}, b, a, collider),
                place_of({2 * last.x - first.x, 2 * last.y - first.y}, a, b, collider)};
    }

    /// Returns the cloth's direction through a particle along an axis.
    vec3 direction_at(ivec2 texel, ivec2 axis, vec3 local, const ColliderRecord& collider) const {
        const ivec2 back{texel.x - axis.x, texel.y - axis.y}, on{texel.x + axis.x, texel.y + axis.y};
        const vec3 before = place_of(back, place_of(on, local, local, collider), local, collider);
        return direction_between(before, local, local, place_of(on, before, local, collider));
    }

    vec3 normal_across(ivec2 texel, vec3 local, const ColliderRecord& collider) const {
        return unit_of(
            ordered_cross(direction_at(texel, {1, 0}, local, collider), direction_at(texel, {0, 1}, local, collider)));
    }

    Taken taken(ivec2 texel, const CutCorner& own, const ColliderRecord& collider, bool is_mesh) const {
        Taken taken{};
        const vec4 plane = is_mesh ? touching_plane(own.local, true_mesh(collider), fields) : vec4{};
        for_triangles_around(state.topology.grid(), texel, [&](ivec2 cell, int which) {
            const int corner = corner_of_triangle(which, {texel.x - cell.x, texel.y - cell.y});
            const auto other = [&](int step) {
                const ivec2 offset = triangle_corner(which, (corner + step) % 3);
                return ivec2{cell.x + offset.x, cell.y + offset.y};
            };
            const CutCorner b = corner_at(other(1), collider), c = corner_at(other(2), collider);
            taken = is_mesh ? with_mesh_triangle(taken, own, b, c, plane, collider, push.contact.w, fields)
                            : with_triangle(taken, own, b, c, line_of(texel, other(1), own.local, b.local, collider),
                                            line_of(texel, other(2), own.local, c.local, collider), collider,
                                            push.contact.w);
        });
        return taken;
    }
};

void run_collider_edges(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const std::shared_ptr<const std::vector<vec4>> moving = twin_fields(scene, inputs);
    const ColliderEdges edges{model, state, step.after_edges ? Field::lifted_once : Field::displacement,
                              model.collider_edges(), moving ? moving->data() : scene.mesh_fields.data()};
    const std::vector<drape::Collider>& colliders = scene.scene.colliders;
    const auto first = static_cast<std::size_t>(first_collider(scene, model, step.substep));
    for (int y = 0; y < edges.push.grid.y; ++y)
        for (int x = 0; x < edges.push.grid.x; ++x) {
            const std::size_t i = edges.place({x, y});
            const vec4 start = state[Field::position][i];
            vec3 moved = xyz(state[edges.from][i]);
            float by = step.after_edges && state[edges.from][i].w > 0.0f ? state[edges.from][i].w : 0.0f;
            for (std::size_t k = 0; k < colliders.size(); ++k) {
                const ColliderRecord& collider = inputs.colliders[first + k];
                const int kind = colliders[k].kind();
                const vec3 local = local_point(collider, moved_position(xyz(start), moved));
                if (start.w == 0.0f || !edges.near(kind, local, collider)) continue;
                const Taken taken = edges.taken({x, y}, {local, moved, start.w}, collider, kind == kind_mesh);
                const vec3 surface = kind == kind_mesh ? mesh_displacement(collider, local, edges.fields)
                                                       : surface_displacement(collider, local);
                moved = taken_displacement(moved, taken, surface, collider, model.skin_of(i).y);
                if (ordered_dot(taken.by, taken.by) > 0.0f) by = static_cast<float>(k + 1);
                if (!step.after_edges || kind == kind_mesh) continue;
                const vec3 bent =
                    bent_contact(collider, xyz(start), moved, edges.normal_across({x, y}, local, collider),
                                 edges.push.contact.x, model.skin_of(i).x, model.skin_of(i).y, edges.fields);
                if (bent.x != moved.x || bent.y != moved.y || bent.z != moved.z) by = static_cast<float>(k + 1);
                moved = bent;
            }
            state[step.after_edges ? Field::lifted : Field::lifted_once][i] = texel(moved, by);
        }
}

/// Returns the displacement with which a particle comes to the colliders, after impulses that which contact between
/// cloths has left on the sheet.
vec3 displacement_before_colliders(const TwinPlace& where, std::size_t particle) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    if (step.after_impulses) return xyz(meeting->displacements[place_on_sheet(step.push<SelfClothPush>(), particle)]);
    return xyz(state[step.after_edges ? Field::lifted : Field::displacement][particle]);
}

/// Leaves a displacement where it came from.
void leave(const TwinPlace& where, std::size_t particle, vec3 displacement) {
    where.state.move_to(particle, displacement);
    if (!where.step.after_impulses) return;
    vec4& laid = where.contact->displacements[place_on_sheet(where.step.push<SelfClothPush>(), particle)];
    laid = texel(displacement, laid.w);
}

/// Takes a way out of an overlap out of `displacement`, and returns the displacement to leave.
vec3 led_out(const TwinPlace& where, std::size_t particle, vec3& displacement, vec3 way_out) {
    vec4& position = where.state[Field::position][particle];
    const vec3 whole = displacement, start = xyz(position), led = led_sum(start, way_out);
    displacement = displacement_of_own(displacement, way_out);
    if (!where.step.after_impulses) {
        position = texel(led, position.w);
        return displacement;
    }
    const vec3 way = way_between(start, led);
    if (is_rounding(start, way)) return displacement;
    const std::size_t place = place_on_sheet(where.step.push<SelfClothPush>(), particle);
    where.contact->led_ways[place] = texel(way);
    float& by = where.contact->before[place].w;
    by = by != 0.0f ? self_pushed_and_led : self_led_out;
    return whole;
}

void run_collide(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const CollisionPush& push = model.collision;
    const auto first = static_cast<std::size_t>(first_collider(scene, model, step.substep));
    const float recovery = step.leading ? push.contact.w : 0.0f;
    TwinImpulses impulses(state);
    const std::shared_ptr<const std::vector<vec4>> moving = twin_fields(scene, inputs);
    const vec4* const fields = moving ? moving->data() : scene.mesh_fields.data();
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        if (state[Field::position][i].w == 0.0f) continue;
        const vec3 start = xyz(state[Field::position][i]);
        const vec2 skin = model.skin_of(i);
        vec3 displacement = displacement_before_colliders(where, i), way_out{};
        bool touched = step.after_edges && state[Field::lifted][i].w > 0.0f;
        TwinGivers givers;
        if (touched && impulses.are_wanted())
            givers.take(static_cast<int>(state[Field::lifted][i].w) - 1,
                        given_by_collider(displacement, {0, 0, 0}, xyz(state[Field::displacement][i])));
        Contact last{};  // the deepest of the last round in which something is touched
        for (std::uint32_t round = 0; round < scene.collision_rounds(); ++round) {
            Contact deepest{};
            vec3 led{};
            for (std::size_t k = 0; k < scene.scene.colliders.size(); ++k) {
                const Contact contact = collider_contact(scene.scene.colliders[k].kind(), inputs.colliders[first + k],
                                                         start, displacement, skin.x, skin.y, recovery, true, fields);
                if (contact.depth > 0.0f)
                    givers.take(static_cast<int>(k),
                                given_by_collider(contact.displacement, contact.led, displacement));
                displacement = contact.displacement;
                if (contact.depth > deepest.depth) deepest = contact;
                led = led_sum(led, contact.led);
            }
            if (round == 0) way_out = led;
            touched = touched || deepest.depth > 0.0f;
            if (deepest.depth > 0.0f) last = deepest;
            if (!(deepest.depth > push.contact.z)) break;
        }
        if (!touched) continue;
        if (impulses.are_wanted())
            givers.book(impulses, &inputs.colliders[first], state[Field::position][i], displacement);
        if (!state[Field::contact_impulses].empty())
            givers.keep(state[Field::contact_impulses][i], state[Field::position][i].w);
        const bool is_led = way_out.x != 0.0f || way_out.y != 0.0f || way_out.z != 0.0f;
        const vec3 made = is_led ? led_out(where, i, displacement, way_out) : displacement;
        const bool lies = step.supporting && (last.normal.x != 0.0f || last.normal.y != 0.0f || last.normal.z != 0.0f);
        if (lies) {
            const vec3 touches = step.after_impulses ? xyz(last.grip) : displacement;
            state[Field::support][i] = texel(last.normal, ordered_dot(last.normal, touches));
            state[Field::support_grip][i] = last.grip;
        }
        if (step.after_impulses || !lies) where.before()[i] = texel(displacement);
        if (model.scheme.second_order) {
            uint& hold = state.integers(Field::line_control)[control_hold];
            hold = std::max(hold, line_hold_contact);
        }
        leave(where, i, made);
        vec4& remainder = state[Field::displacement_remainder][i];
        remainder = texel(led_sum(xyz(remainder), last.lost), 1.0f);
    }
}

}  // namespace

std::vector<TwinRow> twin_contact_rows() {
    return {{StepKind::collider_edges, run_collider_edges}, {StepKind::collide, run_collide}};
}

}  // namespace drape
