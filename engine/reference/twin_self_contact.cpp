// The twin of self-contact. Pairs are found by trying all boxes against all others: what the device's tree may not
// miss.
#include <algorithm>

#include "cloth/texels.h"
#include "reference/kernels.h"
#include "reference/twin.h"

namespace drape {

using namespace glsl;

namespace {

/// What the passes do with a cloth's pairs, on one step's state.
class SelfPairs {
  public:
    SelfPairs(TwinCloth& state, const SelfContactPush& push) : state_(state), push_(push) {}

    uint index(uint corner) const {
        const ivec2 texel = self_texel(corner);
        return static_cast<uint>(texel.y * push_.grid.x + texel.x);
    }
    vec3 position(uint particle) const { return xyz(state_[Field::position][particle]); }
    vec3 displacement(uint particle) const { return xyz(state_[Field::displacement][particle]); }
    float inverse_mass(uint particle) const { return state_[Field::position][particle].w; }
    vec3 bounded(uint particle) const {
        const vec3 moved = displacement(particle);
        return inverse_mass(particle) > 0.0f ? self_bounded(moved, state_.self.limits[particle]) : moved;
    }
    template <class Of>
    SelfCorners corners(const uvec4& pair, const Of& of) const {
        return {of(index(pair.x)), of(index(pair.y)), of(index(pair.z)), of(index(pair.w))};
    }
    SelfCorners positions(const uvec4& pair) const {
        return corners(pair, [this](uint particle) { return position(particle); });
    }
    SelfCorners displacements(const uvec4& pair) const {
        return corners(pair, [this](uint particle) { return displacement(particle); });
    }
    static bool edges(const uvec4& pair) { return (pair.x & self_edge_pair) != 0; }
    float thickness(const uvec4& pair) const {
        return self_pair_thickness(push_, edges(pair), self_texel(pair.x), self_texel(pair.y), self_texel(pair.z),
                                   self_texel(pair.w));
    }

    /// The pairs of what two particles own.
    void add_between(ivec2 a, ivec2 b, float reach) {
        reach_ = reach;
        const bool same = a == b;
        add_triangles(a, b);
        if (same) return;
        add_triangles(b, a);
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                if (edge_exists(a, i) && edge_exists(b, k)) {
                    const ivec4 one = self_edge(i), other = self_edge(k);
                    add_pair({corner(a, one.x, one.y) | self_edge_pair, corner(a, one.z, one.w),
                              corner(b, other.x, other.y), corner(b, other.z, other.w)});
                }
    }

  private:
    static uint corner(ivec2 from, int columns, int rows) { return self_corner({from.x + columns, from.y + rows}); }
    bool triangle_exists(ivec2 cell, int which) const {
        if (!cell_inside(cell, push_.grid)) return false;
        return (state_.topology.grid().cell(cell.x, cell.y) & static_cast<std::uint32_t>(which)) != 0;
    }
    bool edge_exists(ivec2 particle, int k) const {
        for (int side = 0; side < 2; ++side) {
            const ivec4 owner = self_edge_owner(k, side);
            if (triangle_exists({particle.x + owner.x, particle.y + owner.y}, owner.z)) return true;
        }
        return false;
    }
    void add_triangles(ivec2 particle, ivec2 cell) {
        for (int which = 1; which <= 2; ++which)
            if (triangle_exists(cell, which)) {
                uvec4 pair{self_corner(particle), 0, 0, 0};
                const ivec2 b = triangle_corner(which, 0), c = triangle_corner(which, 1), d = triangle_corner(which, 2);
                pair.y = corner(cell, b.x, b.y), pair.z = corner(cell, c.x, c.y), pair.w = corner(cell, d.x, d.y);
                add_pair(pair);
            }
    }
    void add_pair(const uvec4& pair) {
        const uint a = pair.x & ~self_edge_pair;
        if (a == pair.y || a == pair.z || a == pair.w || pair.y == pair.z || pair.y == pair.w) return;
        if (self_far(edges(pair), positions(pair), reach_)) return;
        const SelfGap gap = self_gap(edges(pair), positions(pair));
        const float approach = self_approach(edges(pair), displacements(pair));
        if (!(gap.distance < self_listing_distance(gap, push_.thickness, push_.thickness, approach))) return;
        if (!(gap.distance < self_listing_distance(gap, thickness(pair), push_.thickness, approach))) return;
        if (state_.self.record.pair_count++ < static_cast<uint>(push_.pair_room)) state_.self.pairs.push_back(pair);
    }

    TwinCloth& state_;
    const SelfContactPush& push_;
    float reach_ = 0;
};

void touch(const ClothModel& model, TwinCloth& state, std::size_t particle, vec3 displacement) {
    state.move_to(particle, displacement);
    if (!model.plan.second_order) return;
    state[Field::displacement_before][particle] = texel(displacement);
    uint& hold = state.integers(Field::line_control)[control_hold];
    hold = std::max(hold, line_hold_contact);
}

float corner_side(bool edges, int k) { return k == 0 || (edges && k == 1) ? 1.0f : -1.0f; }

}  // namespace

void Twin::self_boxes(const ClothModel& model, TwinCloth& state, const Step& step) {
    const auto& push = step.push<SelfContactPush>();
    if (push.level != 0) return;
    TwinCloth::SelfContact& self = state.self;
    const std::size_t count = state[Field::position].size();
    self.corrections.assign(count, {});
    self.shares.assign(count, floatBitsToUint(1.0f));
    self.limits.resize(count);
    self.pairs.clear();
    if (push.first != 0) self.record = {};
    self.record.pair_count = 0;
    self.boxes.resize(count);
    for (int y = 0; y < push.grid.y; ++y)
        for (int x = 0; x < push.grid.x; ++x) {
            const auto box_of = [&](int column, int row) {
                const std::size_t i = at(model.grid, {column, row});
                return self_point_box(xyz(state[Field::position][i]), xyz(state[Field::displacement][i]));
            };
            SelfBox box = box_of(x, y);
            const bool right = x + 1 < push.grid.x, below = y + 1 < push.grid.y;
            if (right) box = self_joined(box, box_of(x + 1, y));
            if (below) box = self_joined(box, box_of(x, y + 1));
            if (right && below) box = self_joined(box, box_of(x + 1, y + 1));
            self.boxes[at(model.grid, {x, y})] = box;
        }
}

void Twin::self_pairs(const ClothModel&, TwinCloth& state, const Step& step) {
    const auto& push = step.push<SelfContactPush>();
    SelfPairs pairs(state, push);
    const std::vector<SelfBox>& boxes = state.self.boxes;
    const auto place = [&](std::size_t particle) {
        return ivec2{static_cast<int>(particle) % push.grid.x, static_cast<int>(particle) / push.grid.x};
    };
    for (std::size_t a = 0; a < boxes.size(); ++a)
        for (std::size_t b = a; b < boxes.size(); ++b)
            if (self_boxes_meet(boxes[a], boxes[b], push))
                pairs.add_between(place(a), place(b), self_reach(boxes[a], boxes[b], push));
}

void Twin::self_contact(TwinCloth& state, const Step& step) {
    const auto& push = step.push<SelfContactPush>();
    const SelfPairs pairs(state, push);
    const float per_metre = self_correction_units / push.thickness;
    for (const uvec4& pair : state.self.pairs) {
        const bool edges = SelfPairs::edges(pair);
        const SelfGap gap = self_gap(edges, pairs.positions(pair));
        const uint corner[4] = {pairs.index(pair.x), pairs.index(pair.y), pairs.index(pair.z), pairs.index(pair.w)};
        const vec4 mass{pairs.inverse_mass(corner[0]), pairs.inverse_mass(corner[1]), pairs.inverse_mass(corner[2]),
                        pairs.inverse_mass(corner[3])};
        const vec3 impulse =
            self_impulse(gap, pairs.displacements(pair), mass, pairs.thickness(pair), push.friction, push.recovery);
        if (impulse.x == 0.0f && impulse.y == 0.0f && impulse.z == 0.0f) continue;
        for (std::size_t k = 0; k < 4; ++k) {
            const float moves = component(mass, k) * component(gap.weights, k);
            ivec4& sum = state.self.corrections[corner[k]];
            sum.x += self_units(impulse.x * moves, per_metre);
            sum.y += self_units(impulse.y * moves, per_metre);
            sum.z += self_units(impulse.z * moves, per_metre);
            sum.w += self_weight(component(gap.weights, k));
        }
    }
}

void Twin::self_push(const ClothModel& model, TwinCloth& state, const Step& step) {
    const auto& push = step.push<SelfContactPush>();
    TwinCloth::SelfContact& self = state.self;
    for (std::size_t i = 0; i < self.limits.size(); ++i) {
        const vec3 displacement = xyz(state[Field::displacement][i]);
        self.limits[i] = self_limit(displacement, push.thickness);
        if (self.corrections[i].w == 0 || !(state[Field::position][i].w > 0.0f)) continue;
        touch(model, state, i, self_corrected(displacement, self.corrections[i], push.thickness));
    }
}

void Twin::self_room(TwinCloth& state, const Step& step) {
    const auto& push = step.push<SelfContactPush>();
    const SelfPairs pairs(state, push);
    for (const uvec4& pair : state.self.pairs) {
        const bool edges = SelfPairs::edges(pair);
        const SelfGap gap = self_gap(edges, pairs.positions(pair));
        const uint corner[4] = {pairs.index(pair.x), pairs.index(pair.y), pairs.index(pair.z), pairs.index(pair.w)};
        for (int k = 0; k < 4; ++k) {
            const uint particle = corner[k];
            const bool held = !(pairs.inverse_mass(particle) > 0.0f);
            const float share =
                self_share(gap, component(gap.room, static_cast<std::size_t>(k)), corner_side(edges, k),
                           pairs.bounded(particle), held ? self_held_share : self_room_share, push.least);
            if (!(share < 1.0f)) continue;
            if (held)
                ++state.self.record.unproved;
            else
                state.self.shares[particle] = std::min(state.self.shares[particle], floatBitsToUint(share));
        }
    }
}

void Twin::self_move(const ClothModel& model, TwinCloth& state, const Step& step) {
    TwinCloth::SelfContact& self = state.self;
    self.record.most_pairs = std::max(self.record.most_pairs, self.record.pair_count);
    const SelfPairs pairs(state, step.push<SelfContactPush>());
    for (std::size_t i = 0; i < self.shares.size(); ++i) {
        const auto particle = static_cast<uint>(i);
        const float share = uintBitsToFloat(self.shares[i]);
        if (!(pairs.inverse_mass(particle) > 0.0f)) continue;
        if (!(share < 1.0f) && !self_exceeds(pairs.displacement(particle), self.limits[i])) continue;
        ++self.record.truncated;
        touch(model, state, i, self_truncated(pairs.bounded(particle), share));
    }
}

}  // namespace drape
