// The twin relaxes bending and twist.
#include "cloth/texels.h"
#include "reference/kernels.h"
#include "reference/twin.h"

namespace drape {

using namespace glsl;

namespace {

/// The edge between two particles at rest and now, m.
struct RestEdge {
    vec3 rest{0, 0, 0}, now{0, 0, 0};
};

/// The targets of bending read the cloth through this.
struct RestShape {
    const ClothModel& model;
    const TwinCloth& state;
    bool moved;

    bool inside(ivec2 p) const {
        const ivec2 size = model.grid.size();
        return p.x >= 0 && p.y >= 0 && p.x < size.x && p.y < size.y;
    }
    float share(ivec2 owner, int direction) const {
        return inside(owner) ? component(state.topology.spring_shares()[at(model.grid, owner)], direction) : 0.0f;
    }
    RestEdge edge(ivec2 from, ivec2 to) const {
        const std::size_t a = at(model.grid, from), b = at(model.grid, to);
        const auto moved_at = [&](std::size_t i) { return moved ? xyz(state[Field::displacement][i]) : vec3{0, 0, 0}; };
        return {xyz(model.position[b]) - xyz(model.position[a]),
                spring_edge(xyz(state[Field::position][a]), xyz(state[Field::position][b]), moved_at(a), moved_at(b))};
    }
    /// Returns the way to the particle after `middle` from the one before, as far as both hang together with it.
    RestEdge through(ivec2 middle, ivec2 step, int direction) const {
        const ivec2 first{middle.x - step.x, middle.y - step.y}, third{middle.x + step.x, middle.y + step.y};
        RestEdge before, after;
        if (share(first, direction) > 0) before = edge(middle, first);
        if (inside(third) && share(middle, direction) > 0) after = edge(middle, third);
        return {after.rest - before.rest, after.now - before.now};
    }
    vec3 element(ivec2 middle, ivec2 step) const {
        const ivec2 first{middle.x - step.x, middle.y - step.y}, third{middle.x + step.x, middle.y + step.y};
        if (!inside(first) || !inside(third)) return {0, 0, 0};
        const RestEdge row = through(middle, {1, 0}, 0), column = through(middle, {0, 1}, 1);
        return turned_difference(second_difference(edge(middle, first).rest, edge(middle, third).rest),
                                 Tangents(row.rest, column.rest), Tangents(row.now, column.now));
    }
    vec3 cell(ivec2 corner) const {
        const ivec2 right{corner.x + 1, corner.y}, below{corner.x, corner.y + 1}, across{corner.x + 1, corner.y + 1};
        if (!inside(across)) return {0, 0, 0};
        const RestEdge upper = edge(corner, right), lower = edge(below, across), near = edge(corner, below),
                       far = edge(right, across);
        return turned_difference(twist_difference(upper.rest, lower.rest),
                                 Tangents(upper.rest + lower.rest, near.rest + far.rest),
                                 Tangents(upper.now + lower.now, near.now + far.now));
    }
};

void run_bend_targets(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const RestShape shape{model, state, !model.scheme.spare_state || step.substep > 0};
    const ivec2 size = model.grid.size();
    std::vector<vec4>& targets = state[Field::bend_targets];
    const auto columns = static_cast<std::size_t>(size.x);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const std::size_t first = 3 * columns * static_cast<std::size_t>(y) + static_cast<std::size_t>(x);
            targets[first] = texel(shape.element({x, y}, {1, 0}));
            targets[first + columns] = texel(shape.element({x, y}, {0, 1}));
            targets[first + 2 * columns] = texel(shape.cell({x, y}));
        }
}

void run_bend(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<BendPush>();
    const CutTopology& topology = state.topology;
    const auto share = [&](ivec2 owner) {
        return topology.masked() ? component(topology.spring_shares()[at(topology.grid(), owner)], push.channel)
                                 : border_share(owner, push.axis, push.grid);
    };
    for (int y = 0; y < push.element_count.y; ++y)
        for (int x = 0; x < push.element_count.x; ++x) {
            const ivec2 middle = bend_middle({x, y}, push.axis, push.colour);
            const ivec2 first{middle.x - push.axis.x, middle.y - push.axis.y};
            const std::size_t i[3] = {at(topology.grid(), first), at(topology.grid(), middle),
                                      at(topology.grid(), {middle.x + push.axis.x, middle.y + push.axis.y})};
            vec3 start[3], moved[3];
            float weight[3];
            for (std::size_t k = 0; k < 3; ++k) {
                start[k] = xyz(state[Field::position][i[k]]);
                moved[k] = xyz(state[Field::displacement][i[k]]);
                weight[k] = state.dragged_weight_of(i[k]);
            }
            const vec3 difference = beyond_rest(second_difference(spring_edge(start[1], start[0], moved[1], moved[0]),
                                                                  spring_edge(start[1], start[2], moved[1], moved[2])),
                                                state.bend_target(middle, push.channel));
            const vec3 correction = project_bend(difference, bend_weight(weight[0], weight[1], weight[2]),
                                                 bend_share(share(first), share(middle)), push.compliance);
            state.move_to(i[0], moved_by(moved[0], correction, weight[0]));
            state.move_to(i[1], moved_by(moved[1], correction, -2.0f * weight[1]));
            state.move_to(i[2], moved_by(moved[2], correction, weight[2]));
        }
}

void run_twist(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<TwistPush>();
    const CutTopology& topology = state.topology;
    const std::vector<vec4>& shares = topology.spring_shares();
    const auto& control = state.integers(Field::line_control);
    const bool is_bdf2 = !control.empty() && control[control_order] == 2u;
    const float compliance = is_bdf2 ? push.compliance_bdf2 : push.compliance;
    for (int y = 0; y < push.element_count.y; ++y)
        for (int x = 0; x < push.element_count.x; ++x) {
            const ivec2 corner = twist_corner({x, y}, push.first);
            const std::size_t i[4] = {at(topology.grid(), corner), at(topology.grid(), {corner.x + 1, corner.y}),
                                      at(topology.grid(), {corner.x, corner.y + 1}),
                                      at(topology.grid(), {corner.x + 1, corner.y + 1})};
            vec3 start[4], moved[4];
            float weight[4];
            for (std::size_t k = 0; k < 4; ++k) {
                start[k] = xyz(state[Field::position][i[k]]);
                moved[k] = xyz(state[Field::displacement][i[k]]);
                weight[k] = state.dragged_weight_of(i[k]);
            }
            const float share = topology.masked() ? twist_share(shares[i[0]], shares[i[1]], shares[i[2]]) : 1.0f;
            const vec3 difference = beyond_rest(twist_difference(spring_edge(start[0], start[1], moved[0], moved[1]),
                                                                 spring_edge(start[2], start[3], moved[2], moved[3])),
                                                state.bend_target(corner, 2));
            const vec3 correction =
                project_bend(difference, twist_weight(weight[0], weight[1], weight[2], weight[3]), share, compliance);
            state.move_to(i[0], moved_by(moved[0], correction, weight[0]));
            state.move_to(i[1], moved_by(moved[1], correction, -weight[1]));
            state.move_to(i[2], moved_by(moved[2], correction, -weight[2]));
            state.move_to(i[3], moved_by(moved[3], correction, weight[3]));
        }
}

}  // namespace

std::vector<TwinRow> twin_bend_rows() {
    return {{StepKind::bend_targets, run_bend_targets}, {StepKind::bend, run_bend}, {StepKind::twist, run_twist}};
}

}  // namespace drape
