// The twin of contact between cloths finds pairs by trying all boxes against all others, so it shows any pair that the
// device's tree misses.
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "cloth/texels.h"
#include "twin/contact_step.h"
#include "twin/kernels.h"

namespace drape {

using namespace glsl;

namespace {

float corner_side(bool edges, int k) { return k == 0 || (edges && k == 1) ? 1.0f : -1.0f; }

}  // namespace

SelfBox ContactStep::cell_box(ivec2 own) const {
    const auto box_of = [&](int columns, int rows) { return point_box(place(ivec2{own.x + columns, own.y + rows})); };
    const SelfCloth& cloth = cloth_at(place(own));
    const bool right = inside(cloth, {own.x + 1, own.y}), below = inside(cloth, {own.x, own.y + 1});
    SelfBox box = box_of(0, 0);
    if (right) box = self_joined(box, box_of(1, 0));
    if (below) box = self_joined(box, box_of(0, 1));
    if (right && below) box = self_joined(box, box_of(1, 1));
    return box;
}

void ContactStep::boxes() {
    const std::size_t count = contact_.positions.size();
    contact_.sums.assign(count, {});
    contact_.velocities.assign(count, {});
    contact_.made_good.assign(count, {});
    contact_.led_ways.assign(count, {});
    contact_.pairs.clear();
    contact_.touching.clear();
    contact_.boxes.assign(count, {});
    contact_.cloth_shares.assign(model_.cloths.size(), {});
    for (std::size_t own = 0; own < count; ++own)
        if (owned(own)) {
            contact_.boxes[own] = cell_box(texel_of(own));
            contact_.before[own] = texel(xyz(contact_.displacements[own]));
        }
}

/// Returns a cell with zeros for corners beyond the cloth: no triangle or edge that exists has them.
SelfCell ContactStep::cell(std::size_t place) const {
    const ivec2 own = texel_of(place);
    const SelfCloth& cloth = cloth_at(place);
    const auto at = [&](int columns, int rows) {
        const ivec2 texel{own.x + columns, own.y + rows};
        return inside(cloth, texel) ? position(this->place(texel)) : vec3{};
    };
    uint bits = (triangle_exists(own, 1) ? 1u : 0u) | (triangle_exists(own, 2) ? 2u : 0u);
    for (int k = 0; k < 3; ++k) bits |= edge_exists(own, k) ? 4u << k : 0u;
    return {at(0, 0), at(1, 0), at(0, 1), at(1, 1), bits};
}

void ContactStep::crossings() {
    contact_.crossings.assign(model_.to_part.size(), {});
    for (std::size_t a = 0; a < contact_.owners.size(); ++a)
        for (std::size_t b = 0; owned(a) && b < contact_.owners.size(); ++b) {
            if (!owned(b) || contact_.owners[a] == contact_.owners[b] || meeting(a, b) < self_meets_apart) continue;
            const uint which = meeting(a, b) - self_meets_apart;
            const SelfCrossed& pair = model_.to_part[which];
            if (contact_.owners[a] != pair.cloths.x || !boxes_meet(a, b) || !self_cells_cross(cell(a), cell(b)))
                continue;
            ++contact_.crossings[which].count;
            contact_.crossings[which].sum +=
                self_parting_of(xyz(pair.way), displacement(static_cast<uint>(a)), displacement(static_cast<uint>(b)),
                                self_parting(push_.step));
        }
}

void ContactStep::apart() {
    contact_.led.assign(model_.cloths.size(), {});
    contact_.record.crossing_count = 0;
    for (std::size_t k = 0; k < model_.to_part.size(); ++k) {
        contact_.record.crossing_count += static_cast<uint>(contact_.crossings[k].count);
        const float lacking = self_lacking(contact_.crossings[k], self_parting(push_.step));
        for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth)
            contact_.led[cloth] =
                self_led_apart(contact_.led[cloth], model_.to_part[k], static_cast<int>(cloth), lacking);
    }
}

/// Returns whether primitives of a cell and of its neighbours to the right and below are kept apart because the cloth
/// is flat there.
bool ContactStep::lies_flat(ivec2 cell) const {
    const SelfCloth& cloth = cloth_at(place(cell));
    if (!inside(cloth, {cell.x + 2, cell.y + 2})) return false;
    const auto patch = [&](const auto& value) {
        const auto of = [&](int column, int row) { return value(place(ivec2{cell.x + column, cell.y + row})); };
        return SelfPatch{of(1, 1), of(0, 1), of(2, 1), of(1, 0), of(1, 2), of(0, 0), of(2, 0), of(0, 2), of(2, 2)};
    };
    return self_patch_lies_flat(push_, cloth, patch([this](uint at) { return position(at); }),
                                patch([this](uint at) { return motion(at); }));
}

void ContactStep::pairs() {
    const std::vector<SelfBox>& boxes = contact_.boxes;
    const auto list = [&](ivec2 one, ivec2 other) {
        if (!still_cross(place(one), place(other))) add_between(one, other);
        ++contact_.record.cell_count;
    };
    for (std::size_t a = 0; a < boxes.size(); ++a) {
        if (!owned(a)) continue;
        const ivec2 own = texel_of(a);
        for (std::size_t b = a + 1; b < boxes.size(); ++b)
            if (owned(b) && meet(a, b) && !self_neighbours(own, texel_of(b)) && boxes_meet(a, b))
                list(own, texel_of(b));
        if (!meet(a, a) || lies_flat(own)) continue;
        for (int k = 0; k < self_neighbour_pairs; ++k) {
            const ivec4 pair = self_close_pair(k);
            const ivec2 one{own.x + pair.x, own.y + pair.y}, other{own.x + pair.z, own.y + pair.w};
            if (inside(cloth_at(a), one) && inside(cloth_at(a), other)) list(one, other);
        }
    }
}

vec3 ContactStep::cell_normal(ivec2 own) const {
    if (!triangle_exists(own, 1) && !triangle_exists(own, 2)) return {};
    const auto at = [&](int columns, int rows) { return position(place(ivec2{own.x + columns, own.y + rows})); };
    return self_cell_normal(true, at(0, 0), at(1, 0), at(0, 1), at(1, 1));
}

/// Adds the pairs of primitives that two particles own.
void ContactStep::add_between(ivec2 a, ivec2 b) {
    const vec3 axis = cell_normal(a);
    add_triangles(a, b, axis);
    if (a == b) return;
    add_triangles(b, a, axis);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            if (edge_exists(a, i) && edge_exists(b, k)) add_pair({true, self_edge_pair(a, i, b, k)}, axis);
}

bool ContactStep::triangle_exists(ivec2 cell, int which) const {
    if (cell.x < 0 || cell.y < 0) return false;
    return (static_cast<int>(contact_.displacements[place(cell)].w) & which) != 0;
}

bool ContactStep::edge_exists(ivec2 particle, int k) const {
    for (int side = 0; side < 2; ++side) {
        const ivec4 owner = self_edge_owner(k, side);
        if (triangle_exists({particle.x + owner.x, particle.y + owner.y}, owner.z)) return true;
    }
    return false;
}

bool ContactStep::is_corner(ivec2 particle) const {
    for (int k = 0; k < self_cells_beside; ++k) {
        const ivec4 cell = self_cell_beside(k);
        if (triangle_exists({particle.x + cell.x, particle.y + cell.y}, cell.z)) return true;
    }
    return false;
}

void ContactStep::add_triangles(ivec2 particle, ivec2 cell, vec3 axis) {
    if (!is_corner(particle)) return;
    for (int which = 1; which <= 2; ++which)
        if (triangle_exists(cell, which)) add_pair({false, self_point_pair(particle, cell, which)}, axis);
}

void ContactStep::add_pair(const TwinPair& pair, vec3 axis) {
    const uvec4& all = pair.corners;
    if (self_shares_corner(pair.edges, all)) return;
    const auto at = [&](uint corner) { return leader(place(corner)); };
    if (self_shares_corner(pair.edges, {at(all.x), at(all.y), at(all.z), at(all.w)})) return;
    const float mean = self_mean_thickness(cloth_of(all.x), cloth_of(all.w));
    const SelfBox one = pair.edges ? slab(axis, all.x, all.y) : slab(all.x, axis),
                  other = pair.edges ? slab(axis, all.z, all.w) : slab(axis, all.y, all.z, all.w);
    if (!self_primitives_meet(one, other, push_, mean)) return;
    const SelfGap gap = self_gap(pair.edges, positions(pair));
    const SelfCorners motions = corners(pair, [this](uint place) { return motion(place); });
    const auto [kept, friction] = skin(pair, gap.weights);
    if (!self_listed_pair(pair.edges, gap, motions, kept, mean)) return;
    ++(pair.edges ? contact_.record.edge_count : contact_.record.point_count);
    contact_.pairs.push_back(pair);
    if (self_touches(pair.edges, gap, motions, kept)) touch(pair, gap, friction, kept);
}

void ContactStep::touch(const TwinPair& pair, const SelfGap& gap, float friction, float kept) {
    ++(pair.edges ? contact_.record.touching_edge_count : contact_.record.touching_point_count);
    const uvec4& all = pair.corners;
    const auto found = contact_.borne.find({all.x, all.y, all.z, all.w, pair.edges});
    const vec3 force = found == contact_.borne.end() ? vec3{} : found->second;
    const vec3 begun = self_begun(gap.normal, force, friction, push_.step);
    const float freedom = self_freedom(gap.distance, kept, push_.step);
    contact_.touching.push_back({pair.edges, {all, gap.weights, texel(gap.normal, freedom), texel(begun, friction)}});
    const auto corner = places(pair);
    for (std::size_t k = 0; k < 4; ++k)
        contact_.sums[leader(corner[k])].weight += self_weight(component(gap.weights, k));
    add_impulse(0, pair.edges, all, gap.weights, begun);
}

void ContactStep::add_parts(std::size_t which, uint corner, const SelfParts& parts) {
    const auto units = [](ivec2 both) { return std::int64_t{both.x} + std::int64_t{both.y} * (1 << 20); };
    auto& sum = contact_.sums[leader(place(corner))].units[which];
    sum[0] += units(parts.x);
    sum[1] += units(parts.y);
    sum[2] += units(parts.z);
}

void ContactStep::add_impulse(std::size_t round, bool edges, const uvec4& all, vec4 weights, vec3 impulse) {
    const SelfShares shares = self_shares(edges, weights, impulse, self_units_per_impulse(cloth_of(all.x).largest));
    add_parts(round, all.x, shares.a);
    add_parts(round, all.y, shares.b);
    add_parts(round, all.z, shares.c);
    add_parts(round, all.w, shares.d);
}

void ContactStep::add_couple(const TwinPair& pair, vec4 weights, vec3 impulse) {
    const float largest = cloth_of(pair.corners.x).largest;
    const vec3 half_couple = self_half_couple(weights, self_relative(positions(pair)), impulse, largest);
    const SelfParts parts = self_parts_of(half_couple, 1.0f, self_units_per_impulse(largest));
    for (const uint corner : {pair.corners.x, pair.corners.w}) add_parts(self_sum_of_couples, corner, parts);
}

vec3 ContactStep::impulse_at(std::size_t round, uint place) const {
    return summed(contact_.sums[leader(place)], round, cloth_at(place).largest);
}

vec3 ContactStep::motion_in_round(uint place, float mass) const {
    const vec3 impulse = begins_with_none() ? vec3{} : impulse_at(static_cast<std::size_t>(push_.round), place);
    const vec3 moved = self_added(changed(place), self_moved_by(impulse, mass));
    return self_relative_motion(supported(moved, contact_.supports[place]), xyz(contact_.record.carried));
}

void ContactStep::work(TwinTouch& pair) {
    const uvec4& all = pair.touch.corners;
    const std::array<uint, 4> corner{all.x, all.y, all.z, all.w};
    const SelfCloth &one = cloth_of(all.x), &other = cloth_of(all.w);
    std::array<float, 4> mass{}, holds{};
    std::array<vec3, 4> moved{};
    for (std::size_t k = 0; k < 4; ++k) {
        mass[k] = mass_of(corner[k], k == 0 || (k == 1 && pair.edges) ? one : other);
        holds[k] = self_holds(contact_.sums[leader(place(corner[k]))].weight);
        moved[k] = motion_in_round(place(corner[k]), mass[k]);
    }
    SelfTouch& touch = pair.touch;
    const float yields =
        self_yields(touch.weights, {mass[0], mass[1], mass[2], mass[3]}, {holds[0], holds[1], holds[2], holds[3]});
    const vec3 relative = self_sum(touch.weights, {moved[0], moved[1], moved[2], moved[3]});
    if (begins_with_none()) touch.impulse = texel({}, touch.impulse.w);
    const vec3 impulse = self_next_impulse(touch, relative, yields);
    touch.impulse = texel(impulse, touch.impulse.w);
    const auto round = static_cast<std::size_t>(push_.round);
    add_impulse(round + 1, pair.edges, all, touch.weights, impulse);
    if (looks_back_) return;
    if (round == 0)
        add_impulse(self_sum_of_thickness, pair.edges, all, touch.weights,
                    xyz(touch.normal) * self_leading(touch, yields));
    const bool presses = impulse.x != 0.0f || impulse.y != 0.0f || impulse.z != 0.0f;
    if (push_.round != self_iterations - 1 || !presses) return;
    add_couple({pair.edges, all}, touch.weights, impulse);
    contact_.borne[{all.x, all.y, all.z, all.w, pair.edges}] = self_borne_force(impulse, push_.step);
}

void ContactStep::contact() {
    if (push_.round == 0 && !looks_back_) contact_.borne.clear();
    for (TwinTouch& pair : contact_.touching) work(pair);
}

void ContactStep::push() {
    for (std::size_t i = 0; i < contact_.before.size(); ++i) {
        const auto at = static_cast<uint>(i);
        if (!owned(i) || held(at) || leader(i) != at) continue;
        const bool led = !contact_.led.empty();
        const vec3 by = led ? contact_.led[static_cast<std::size_t>(contact_.owners[i])] : vec3{};
        const vec3 impulse = impulse_at(self_iterations, at);
        if (ends_frame_ && !looks_back_ && (led || contact_.sums[i].weight != 0)) clear_rounds(i);
        if (contact_.sums[i].weight == 0 && by.x == 0.0f && by.y == 0.0f && by.z == 0.0f) continue;
        const float mass = inverse_mass(at) * cloth_at(i).lightness;
        vec3 velocity = self_added(changed(at), self_moved_by(impulse, mass));
        if (led) velocity = self_led(velocity, by);
        const vec3 leading = self_moved_by(impulse_at(self_sum_of_thickness, at), mass);
        const vec3 good = self_led_by(leading, support_normal(contact_.supports[i]));
        for_sewn(i, [&](std::size_t each) {
            if (looks_back_) {
                contact_.last_motions[each] = texel(velocity);
                return;
            }
            contact_.velocities[each] = texel(velocity);
            contact_.made_good[each] = texel(good);
            move_to(each, self_added(velocity, good));
        });
    }
}

void ContactStep::sew_surfaces() {
    for (const int first : model_.sewn_leaders) {
        const auto lies = [&](std::size_t place) {
            const vec3 normal = support_normal(contact_.supports[place]);
            return normal.x != 0.0f || normal.y != 0.0f || normal.z != 0.0f;
        };
        std::optional<Support> found;
        for_sewn(static_cast<std::size_t>(first), [&](std::size_t each) {
            if (!found && lies(each)) found = contact_.supports[each];
        });
        if (found)
            for_sewn(static_cast<std::size_t>(first), [&](std::size_t each) { contact_.supports[each] = *found; });
    }
}

/// Returns the square of the way by which colliders have led a particle since impulses did.
float ContactStep::led_by_colliders(std::size_t place) const {
    const float by = contact_.before[place].w;
    vec3 left = xyz(contact_.before[place]);
    if (by == self_pushed || by == self_pushed_and_led)
        left = self_added(xyz(contact_.velocities[place]), xyz(contact_.made_good[place]));
    return self_squared(self_own_motion(displacement(static_cast<uint>(place)), left));
}

void ContactStep::sew_motions() {
    for (const int first : model_.sewn_leaders) {
        auto farthest = static_cast<std::size_t>(first);
        for_sewn(static_cast<std::size_t>(first), [&](std::size_t each) {
            if (led_by_colliders(each) > led_by_colliders(farthest)) farthest = each;
        });
        const vec3 motion = displacement(static_cast<uint>(farthest));
        const bool changed = led_by_colliders(farthest) > 0.0f && contact_.before[farthest].w == 0.0f;
        const vec4 led = changed ? vec4{} : contact_.led_ways[farthest];
        const float by = changed ? self_led_out : contact_.before[farthest].w;
        for_sewn(static_cast<std::size_t>(first), [&](std::size_t each) {
            move_to(each, motion);
            contact_.led_ways[each] = led;
            contact_.before[each].w = by;
        });
    }
}

void ContactStep::limit() {
    if (push_.round == 0) contact_.shares.assign(contact_.before.size(), 0);
    std::vector<float> next(contact_.shares.size(), 1);
    for (const TwinPair& pair : contact_.pairs) {
        const bool edges = pair.edges;
        const SelfGap gap = self_gap_squared(edges, positions(pair));
        if (push_.round == 0 && self_touch(gap)) ++contact_.record.unproved;
        const auto corner = places(pair);
        const auto along = [&](uint place) { return ordered_dot(gap.normal, bounded(place)); };
        const vec4 all{along(corner[0]), along(corner[1]), along(corner[2]), along(corner[3])};
        const vec4 made{made_by(corner[0]), made_by(corner[1]), made_by(corner[2]), made_by(corner[3])};
        const vec4 end = self_ends(gap, all, made);
        const float middle = self_middle(edges, gap.apart, end, self_wants(all, made));
        for (std::size_t k = 0; k < 4; ++k) {
            const uint at = corner[k];
            const float share = self_share(gap, middle, component(end, k), corner_side(edges, static_cast<int>(k)),
                                           component(all, k), component(made, k), held(at), cloth_at(at).least);
            next[leader(at)] = std::min(next[leader(at)], share);
            if (push_.round == 0 && !held(at) && body_at(corner[0]) != body_at(corner[3])) leave_behind(at, share);
        }
    }
    contact_.shares = next;
    share_in_cloths();
}

/// A free cloth of which a particle stays far behind for another cloth's sake goes on as a whole.
void ContactStep::leave_behind(uint place, float share) {
    const SelfCloth& cloth = cloth_at(place);
    if (cloth.held == 0 && self_stays_behind(bounded(place), share, cloth.spacing))
        contact_.cloth_shares[body_at(place)].first = true;
}

/// Finds the least share of a particle of each cloth.
void ContactStep::share_in_cloths() {
    for (auto& [whole, least] : contact_.cloth_shares) least = 1;
    for (std::size_t i = 0; i < contact_.shares.size(); ++i) {
        const auto at = static_cast<uint>(i);
        const float share = contact_.shares[i];
        if (!owned(i) || held(at) || !(share < 1.0f)) continue;
        auto& [whole, least] = contact_.cloth_shares[body_at(i)];
        least = std::min(least, share);
    }
}

void ContactStep::count_lists() {
    SelfRecord& record = contact_.record;
    record.most_pairs = std::max(record.most_pairs, record.point_count + record.edge_count);
    // The device also counts the entries that a search and boxes found, in the same maxima.
    record.most_cells = std::max(record.most_cells, record.cell_count);
    const uint touching = record.touching_point_count + record.touching_edge_count;
    record.most_touching = std::max(record.most_touching, touching);
    if (touching == 0) contact_.borne.clear();
}

void ContactStep::cut_short(std::size_t cloth) {
    SelfRecord& record = contact_.record;
    for (std::size_t i = 0; i < contact_.shares.size(); ++i) {
        if (contact_.owners[i] != static_cast<int>(cloth)) continue;
        const auto at = static_cast<uint>(i);
        const auto& [whole, least] = contact_.cloth_shares[body_at(i)];
        const float share = whole && !held(at) ? least : contact_.shares[leader(i)];
        if (held(at)) {
            record.unproved += share < 1.0f ? 1 : 0;
            continue;
        }
        const vec3 moved = displacement(at);
        const vec3 bound = self_bounded(moved, xyz(contact_.before[i]), xyz(record.carried), own_thickness(i));
        const bool is_cut = share < 1.0f || bound.x != moved.x || bound.y != moved.y || bound.z != moved.z;
        const float by = contact_.before[i].w;
        const bool pushed = by == self_pushed || by == self_pushed_and_led;
        if (!is_cut && by == 0.0f) continue;
        const vec3 own = by >= self_led_out ? self_own_motion(moved, xyz(contact_.led_ways[i])) : moved;
        const vec3 by_impulses = xyz(contact_.velocities[i]), good = xyz(contact_.made_good[i]);
        const vec3 normal = support_normal(contact_.supports[i]);
        contact_.velocities[i] = texel(pushed ? self_velocity(own, by_impulses, good, normal) : own);
        if (self_was_touched(own, by_impulses, good, normal)) contact_.last_motions[i] = contact_.velocities[i];
        vec3 made = moved;
        if (is_cut) {
            ++record.truncated;
            made = self_truncated(xyz(record.carried), bounded(at), share);
            record.most_lag = std::max(record.most_lag, floatBitsToUint(self_lag(made, moved)));
        }
        move_to(i, made);
        if (!pushed) contact_.before[i].w = self_led_out;
    }
}

void cut_short(TwinContact& contact, std::size_t cloth) {
    ContactStep step(contact, contact.model->push);
    if (cloth + 1 == contact.model->cloths.size()) step.count_lists();
    step.cut_short(cloth);
}

void Twin::run_contact(const Step& step) {
    // The twin tries all pairs of cells, so it has no search: none of self_tree to self_near,
    // and no self_primitives. What `self_begin` does belongs to its `self_pairs`.
    static constexpr std::pair<StepKind, void (ContactStep::*)()> rows[] = {
        {StepKind::self_boxes, &ContactStep::boxes},     {StepKind::self_crossings, &ContactStep::crossings},
        {StepKind::self_apart, &ContactStep::apart},     {StepKind::self_pairs, &ContactStep::pairs},
        {StepKind::self_contact, &ContactStep::contact}, {StepKind::self_push, &ContactStep::push},
        {StepKind::self_limit, &ContactStep::limit},
    };
    ContactStep contact(*contact_, step.push<SelfContactPush>(), step.looks_back, step.last);
    if (step.kind == StepKind::self_sew) return step.after_impulses ? contact.sew_motions() : contact.sew_surfaces();
    for (const auto& [kind, function] : rows)
        if (kind == step.kind) (contact.*function)();
}

}  // namespace drape
