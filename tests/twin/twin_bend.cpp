// The twin relaxes bending and twist.
#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {

using namespace glsl;

namespace {

/// The edge between two particles at rest, when the substep began and now, m.
struct RestEdge {
    vec3 rest{0, 0, 0}, start{0, 0, 0}, now{0, 0, 0};
};

RestEdge sum_of(const RestEdge& one, const RestEdge& other, float sign) {
    return {other.rest + one.rest * sign, other.start + one.start * sign, other.now + one.now * sign};
}

/// The rest of bending elements is read off the cloth through this.
struct RestShape {
    const ClothModel& model;
    const TwinCloth& state;
    const BendTargetPush& push;
    bool advance, is_bdf2;

    struct Bent {
        vec3 target{0, 0, 0};
        Tangents pull{{0, 0, 0}, {0, 0, 0}};
    };
    vec4 stiffness() const { return is_bdf2 ? push.stiffness_bdf2 : push.stiffness; }
    bool inside(ivec2 p) const { return p.x >= 0 && p.y >= 0 && p.x < push.grid.x && p.y < push.grid.y; }
    vec4 shares(ivec2 owner) const { return state.topology.spring_shares()[at(model.grid, owner)]; }
    /// Returns the share of a spring along row (0) or column (1), 0 where there is none.
    float share(ivec2 first, ivec2 second, int direction) const {
        return inside(first) && inside(second) ? component(shares(first), direction) : 0.0f;
    }
    RestEdge edge(ivec2 from, ivec2 to) const {
        const std::size_t a = at(model.grid, from), b = at(model.grid, to);
        const vec3 from_at = xyz(state[Field::position][a]), to_at = xyz(state[Field::position][b]);
        RestEdge edge{xyz(model.rest_shape()[b]) - xyz(model.rest_shape()[a]), to_at - from_at, to_at - from_at};
        if (push.gathers == 0 || advance)
            edge.now =
                spring_edge(from_at, to_at, xyz(state[Field::displacement][a]), xyz(state[Field::displacement][b]));
        if (push.gathers != 0 || is_bdf2) edge.start = edge.now;
        return edge;
    }
    /// Returns the way from the particle before `middle` to the one after, as far as both hang together with it.
    RestEdge through(ivec2 middle, ivec2 step, int direction) const {
        const ivec2 first{middle.x - step.x, middle.y - step.y}, third{middle.x + step.x, middle.y + step.y};
        RestEdge before, after;
        if (share(first, middle, direction) > 0) before = edge(middle, first);
        if (share(middle, third, direction) > 0) after = edge(middle, third);
        return sum_of(before, after, -1.0f);
    }
    static Bent bent(const RestEdge& difference, const RestEdge& row, const RestEdge& column, float acting) {
        const vec4 coordinates = rest_coordinates(difference.rest, Tangents(row.rest, column.rest));
        const Tangents start(row.start, column.start);
        const vec3 beyond = beyond_rest(difference.start, rest_difference(coordinates, start, difference.start));
        return {rest_difference(coordinates, Tangents(row.now, column.now), difference.now),
                rest_pull(coordinates, start, beyond * acting)};
    }
    Bent element(ivec2 middle, int axis) const {
        const ivec2 step = bend_axes[static_cast<std::size_t>(axis)].offset;
        const ivec2 first{middle.x - step.x, middle.y - step.y}, third{middle.x + step.x, middle.y + step.y};
        if (!inside(first) || !inside(third)) return {};
        const float acting =
            component(stiffness(), axis) * bend_share(share(first, middle, axis), share(middle, third, axis));
        return bent(sum_of(edge(middle, first), edge(middle, third), 1.0f), through(middle, {1, 0}, 0),
                    through(middle, {0, 1}, 1), acting);
    }
    Bent cell(ivec2 corner) const {
        const ivec2 right{corner.x + 1, corner.y}, below{corner.x, corner.y + 1}, across{corner.x + 1, corner.y + 1};
        if (!inside(across)) return {};
        const RestEdge upper = edge(corner, right), lower = edge(below, across);
        const float acting = stiffness().z * twist_share(shares(corner), shares(right), shares(below));
        return bent(sum_of(upper, lower, -1.0f), sum_of(upper, lower, 1.0f),
                    sum_of(edge(corner, below), edge(right, across), 1.0f), acting);
    }
};

void run_bend_targets(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& control = state.integers(Field::line_control);
    const RestShape shape{model, state, step.push<BendTargetPush>(), step.substep > 0,
                          !control.empty() && control[control_order] == 2u};
    std::vector<vec4>& targets = state[Field::bend_targets];
    const auto columns = static_cast<std::size_t>(shape.push.grid.x);
    for (int y = 0; y < shape.push.grid.y; ++y)
        for (int x = 0; x < shape.push.grid.x; ++x) {
            const RestShape::Bent row = shape.element({x, y}, 0), column = shape.element({x, y}, 1),
                                  twist = shape.cell({x, y});
            const Tangents pull = sum_of_pulls(row.pull, column.pull);
            const vec3 parts[bend_parts] = {row.target,  column.target,  twist.target,     pull.row,
                                            pull.column, twist.pull.row, twist.pull.column};
            for (std::size_t part = 0; part < std::size_t{bend_parts}; ++part)
                targets[(std::size_t{bend_parts} * static_cast<std::size_t>(y) + part) * columns +
                        static_cast<std::size_t>(x)] = texel(parts[part]);
        }
}

void run_bend_pulls(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const ivec2 size = model.grid.size();
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const std::size_t i = at(model.grid, {x, y});
            state.move_to(
                i, moved_by(xyz(state[Field::displacement][i]), state.bend_pull({x, y}), state.dragged_weight_of(i)));
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

vec3 TwinCloth::bend_pull(ivec2 particle) const {
    const int x = particle.x, y = particle.y;
    const ivec2 size = topology.grid().size();
    const auto acts = [&](ivec2 first, ivec2 second, int direction) {
        const bool inside = first.x >= 0 && first.y >= 0 && second.x < size.x && second.y < size.y;
        return inside && component(topology.spring_shares()[at(topology.grid(), first)], direction) > 0 ? 1.0f : 0.0f;
    };
    const float left = acts({x - 1, y}, particle, 0), right = acts(particle, {x + 1, y}, 0),
                up = acts({x, y - 1}, particle, 1), down = acts(particle, {x, y + 1}, 1);
    vec3 sum{0, 0, 0};
    const auto add = [&](int column, int row, int part, float sign) {
        if (column >= 0 && row >= 0 && column < size.x && row < size.y)
            sum = add_pull_of(sum, bend_target({column, row}, part), sign);
    };
    add(x, y, bend_pull_row, left - right);
    add(x, y, bend_pull_column, up - down);
    add(x - 1, y, bend_pull_row, left);
    add(x + 1, y, bend_pull_row, -right);
    add(x, y - 1, bend_pull_column, up);
    add(x, y + 1, bend_pull_column, -down);
    add(x, y, twist_pull_row, -1);
    add(x, y, twist_pull_column, -1);
    add(x - 1, y, twist_pull_row, 1);
    add(x - 1, y, twist_pull_column, -1);
    add(x, y - 1, twist_pull_row, -1);
    add(x, y - 1, twist_pull_column, 1);
    add(x - 1, y - 1, twist_pull_row, 1);
    add(x - 1, y - 1, twist_pull_column, 1);
    return sum;
}

std::vector<TwinRow> twin_bend_rows() {
    return {{StepKind::bend_targets, run_bend_targets},
            {StepKind::bend_pulls, run_bend_pulls},
            {StepKind::bend, run_bend},
            {StepKind::twist, run_twist}};
}

}  // namespace drape
