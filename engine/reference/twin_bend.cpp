// The twin relaxes bending and twist.
#include "cloth/texels.h"
#include "reference/kernels.h"
#include "reference/twin.h"

namespace drape {

using namespace glsl;

namespace {

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
            const vec3 difference = second_difference(spring_edge(start[1], start[0], moved[1], moved[0]),
                                                      spring_edge(start[1], start[2], moved[1], moved[2]));
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
            const vec3 difference = twist_difference(spring_edge(start[0], start[1], moved[0], moved[1]),
                                                     spring_edge(start[2], start[3], moved[2], moved[3]));
            const vec3 correction =
                project_bend(difference, twist_weight(weight[0], weight[1], weight[2], weight[3]), share, compliance);
            state.move_to(i[0], moved_by(moved[0], correction, weight[0]));
            state.move_to(i[1], moved_by(moved[1], correction, -weight[1]));
            state.move_to(i[2], moved_by(moved[2], correction, -weight[2]));
            state.move_to(i[3], moved_by(moved[3], correction, weight[3]));
        }
}

}  // namespace

std::vector<TwinRow> twin_bend_rows() { return {{StepKind::bend, run_bend}, {StepKind::twist, run_twist}}; }

}  // namespace drape
