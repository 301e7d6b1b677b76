// The twin of self-contact. Pairs are found by trying all boxes against all others: what the device's tree may not
// miss.
#include <algorithm>
#include <utility>

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
    vec3 motion(uint particle) const {
        return self_relative_motion(displacement(particle), xyz(state_.self.record.carried));
    }
    vec3 bounded(uint particle) const {
        vec3 moved = displacement(particle);
        if (inverse_mass(particle) > 0.0f) moved = self_bounded(moved, state_.self.before[particle], push_.thickness);
        return self_relative_motion(moved, xyz(state_.self.record.carried));
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
    void add_between(ivec2 a, ivec2 b) {
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
        if (self_shares_corner(edges(pair), {pair.x & ~self_edge_pair, pair.y, pair.z, pair.w})) return;
        const SelfGap gap = self_gap(edges(pair), positions(pair));
        const SelfCorners motions = corners(pair, [this](uint particle) { return motion(particle); });
        if (!self_listed_pair(edges(pair), gap, motions, push_.thickness, push_.thickness)) return;
        if (!self_listed_pair(edges(pair), gap, motions, thickness(pair), push_.thickness)) return;
        if (state_.self.record.pair_count++ < static_cast<uint>(push_.pair_room)) state_.self.pairs.push_back(pair);
    }

    TwinCloth& state_;
    const SelfContactPush& push_;
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

void Twin::self_common(const ClothModel& model, TwinCloth& state, const Step& step) {
    const auto& push = step.push<SelfContactPush>();
    SelfRecord& record = state.self.record;
    if (push.first != 0) record = {};
    vec3 sum{};
    for (int k = 0; push.held == 0 && k < self_samples * self_samples; ++k) {
        const ivec2 sample = self_sample(push.grid, k);
        sum = sum + xyz(state[Field::displacement][at(model.grid, sample)]);
    }
    const vec3 mean = self_mean(sum);
    record.carried = {mean.x, mean.y, mean.z, 0};
    record.pair_count = 0;
    record.cell_count = 0;
}

void Twin::self_boxes(const ClothModel& model, TwinCloth& state, const Step& step) {
    const auto& push = step.push<SelfContactPush>();
    if (push.level != 0) return;
    TwinCloth::SelfContact& self = state.self;
    const std::size_t count = state[Field::position].size();
    self.corrections.assign(count, {});
    self.pairs.clear();
    self.boxes.resize(count);
    const SelfPairs pairs(state, push);
    for (int y = 0; y < push.grid.y; ++y)
        for (int x = 0; x < push.grid.x; ++x) {
            const auto box_of = [&](int column, int row) {
                const auto i = static_cast<uint>(at(model.grid, {column, row}));
                return self_point_box(pairs.position(i), pairs.motion(i));
            };
            SelfBox box = box_of(x, y);
            const bool right = x + 1 < push.grid.x, below = y + 1 < push.grid.y;
            if (right) box = self_joined(box, box_of(x + 1, y));
            if (below) box = self_joined(box, box_of(x, y + 1));
            if (right && below) box = self_joined(box, box_of(x + 1, y + 1));
            self.boxes[at(model.grid, {x, y})] = box;
        }
}

/// Whether what a cell and its neighbours to the right and below own is apart because the cloth is flat there.
bool Twin::self_lies_flat(const ClothModel& model, TwinCloth& state, const SelfContactPush& push, ivec2 cell) {
    if (cell.x + 2 >= push.grid.x || cell.y + 2 >= push.grid.y) return false;
    const auto x = [&](int column, int row) {
        return xyz(state[Field::position][at(model.grid, {cell.x + column, cell.y + row})]);
    };
    const SelfPairs pairs(state, push);
    const auto moved = [&](int column, int row) {
        return pairs.motion(static_cast<uint>(at(model.grid, {cell.x + column, cell.y + row})));
    };
    const auto patch = [](const auto& of) {
        return SelfPatch{of(1, 1), of(0, 1), of(2, 1), of(1, 0), of(1, 2), of(0, 0), of(2, 0), of(0, 2), of(2, 2)};
    };
    return self_patch_lies_flat(push, patch(x), patch(moved));
}

void Twin::self_pairs(const ClothModel& model, TwinCloth& state, const Step& step) {
    const auto& push = step.push<SelfContactPush>();
    SelfPairs pairs(state, push);
    const std::vector<SelfBox>& boxes = state.self.boxes;
    const auto place = [&](std::size_t particle) {
        return ivec2{static_cast<int>(particle) % push.grid.x, static_cast<int>(particle) / push.grid.x};
    };
    for (std::size_t a = 0; a < boxes.size(); ++a) {
        for (std::size_t b = a + 1; b < boxes.size(); ++b)
            if (!self_neighbours(place(a), place(b)) && self_boxes_meet(boxes[a], boxes[b], push, 0)) {
                pairs.add_between(place(a), place(b));
                ++state.self.record.cell_count;
            }
        if (self_lies_flat(model, state, push, place(a))) continue;
        for (int k = 0; k < self_neighbour_pairs; ++k) {
            const ivec4 pair = self_neighbour_pair(k);
            const ivec2 own = place(a), one{own.x + pair.x, own.y + pair.y}, other{own.x + pair.z, own.y + pair.w};
            const auto inside = [&](ivec2 cell) { return cell.x < push.grid.x && cell.y < push.grid.y; };
            if (!inside(one) || !inside(other)) continue;
            pairs.add_between(one, other);
            ++state.self.record.cell_count;
        }
    }
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
    self.before.resize(self.corrections.size());
    for (std::size_t i = 0; i < self.before.size(); ++i) {
        const vec3 displacement = xyz(state[Field::displacement][i]);
        if (push.round == 0) self.before[i] = displacement;
        const ivec4 sum = std::exchange(self.corrections[i], {});
        if (sum.w == 0 || !(state[Field::position][i].w > 0.0f)) continue;
        touch(model, state, i,
              self_bounded(self_corrected(displacement, sum, push.thickness), self.before[i], push.thickness));
    }
}

void Twin::self_room(TwinCloth& state, const Step& step) {
    const auto& push = step.push<SelfContactPush>();
    const SelfPairs pairs(state, push);
    std::vector<float>& shares = state.self.shares;
    if (push.round == 0) shares.assign(state.self.before.size(), 0);
    std::vector<float> next(shares.size(), 1);
    for (const uvec4& pair : state.self.pairs) {
        const bool edges = SelfPairs::edges(pair);
        const SelfGap gap = self_gap(edges, pairs.positions(pair));
        const uint corner[4] = {pairs.index(pair.x), pairs.index(pair.y), pairs.index(pair.z), pairs.index(pair.w)};
        const auto along = [&](uint particle) { return ordered_dot(gap.normal, pairs.bounded(particle)); };
        const vec4 all{along(corner[0]), along(corner[1]), along(corner[2]), along(corner[3])};
        const vec4 end =
            self_ends(gap, all, {shares[corner[0]], shares[corner[1]], shares[corner[2]], shares[corner[3]]});
        for (std::size_t k = 0; k < 4; ++k) {
            const uint particle = corner[k];
            const bool held = !(pairs.inverse_mass(particle) > 0.0f);
            const float share =
                self_share(gap, self_middle(edges, end), component(end, k), corner_side(edges, static_cast<int>(k)),
                           component(all, k), shares[particle], held, push.least);
            next[particle] = std::min(next[particle], share);
        }
    }
    shares = next;
}

void Twin::self_move(const ClothModel& model, TwinCloth& state, const Step& step) {
    TwinCloth::SelfContact& self = state.self;
    self.record.most_pairs = std::max(self.record.most_pairs, self.record.pair_count);
    // The device also counts what a search found, which here none does.
    self.record.most_cells = std::max(self.record.most_cells, self.record.cell_count);
    const SelfPairs pairs(state, step.push<SelfContactPush>());
    for (std::size_t i = 0; i < self.shares.size(); ++i) {
        const auto particle = static_cast<uint>(i);
        const float share = self.shares[i];
        const bool held = !(pairs.inverse_mass(particle) > 0.0f);
        if (held) {
            self.record.unproved += share < 1.0f ? 1 : 0;
            continue;
        }
        if (!(share < 1.0f) &&
            !self_exceeds(pairs.displacement(particle), self.before[i], step.push<SelfContactPush>().thickness))
            continue;
        ++self.record.truncated;
        touch(model, state, i, self_truncated(xyz(self.record.carried), pairs.bounded(particle), share));
    }
}

}  // namespace drape
