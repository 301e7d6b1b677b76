// The twin's line solver consists of the control, the prediction in second order and tridiagonal solves.
#include <algorithm>

#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/reduced_system.h"
#include "twin/twin.h"

namespace drape {

using namespace glsl;

namespace {

/// Returns whether the substep is BDF2.
bool decide_order(TwinCloth& state, const PredictPush& push) {
    auto& texels = state.integers(Field::line_control);
    LineControl last{texels[control_order], texels[control_wrong_lines], texels[control_hold]};
    if (push.joint >= 0) {
        const glsl::uvec4 joint = (*state.sewn)[static_cast<std::size_t>(push.joint)].control;
        last = {joint.x, joint.y, joint.z};
    }
    const LineControl next = next_control(last, push.most_wrong);
    texels = {next.order, next.wrong_lines, next.hold};
    return next.order == 2u;
}

void run_predict(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<PredictPush>();
    const bool advance = step.substep > 0;
    const bool is_bdf2 = decide_order(state, push);
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        const vec4 position = state[Field::position][i];
        const vec3 displacement = xyz(state[Field::displacement][i]);
        if (advance) {
            const CompensatedSum advanced =
                compensated_add(xyz(position), displacement, xyz(state[Field::position_remainder][i]));
            state[Field::position][i] = texel(advanced.value, position.w);
            state[Field::position_remainder][i] = texel(advanced.remainder);
        }
        const vec3 before = xyz(state[Field::displacement_before][i]),
                   excess_before = xyz(state[Field::velocity_excess][i]);
        const vec3 excess = velocity_excess(displacement, before);
        state[Field::displacement_before][i] = texel(displacement);
        state[Field::velocity_excess][i] = texel(excess);
        if (position.w == 0.0f) continue;
        const vec4 applied = state.force_on(i);
        vec3 increment;
        float loss;
        if (is_bdf2) {
            const vec3 forced = forced_step(xyz(push.gravity_step_bdf2), xyz(applied), position.w, push.force_step.y);
            increment = bdf2_increment(displacement, before, excess, excess_before, forced, push.weight.x,
                                       push.weight.y, push.loss.y);
            loss = drag_loss(bdf2_drag(applied.w), position.w, push.force_step.y);
        } else {
            increment = verlet_increment(displacement, xyz(push.gravity_step), xyz(applied), position.w,
                                         push.force_step.x, push.loss.x);
            loss = drag_loss(applied.w, position.w, push.force_step.x);
        }
        state.step_displacement(i, displacement, increment, loss);
    }
}

namespace {

/// A line as the shader sees it.
struct LineView {
    const ClothModel& model;
    const Step& step;
    const LinePush& push;
    const TwinCloth& state;
    std::vector<ivec2> particles;
    std::vector<vec3> moved;       ///< displacements as the first system leaves them, m
    std::vector<vec3> delta;       ///< changes that the first system made, m
    std::vector<float> tension{};  ///< by spring, as the first system leaves it: extension by the compliance in use, m

    LineView(const ClothModel& cloth, const Step& pass, const TwinCloth& images, int line)
        : model(cloth), step(pass), push(pass.push<LinePush>()), state(images), particles{line_start(line, push.step)} {
        for (int p = 1; p < push.particle_count; ++p)
            particles.push_back(next_on_line(particles.back(), push.step, push.grid.x));
        for (std::size_t p = 0; p < particles.size(); ++p) moved.push_back(displacement(p));
        delta.resize(particles.size());
    }
    std::size_t spring_count() const { return particles.size() - 1; }
    std::size_t index(std::size_t particle) const { return at(model.grid, particles[particle]); }
    float weight(std::size_t particle) const { return state.dragged_weight_of(index(particle)); }
    vec3 displacement(std::size_t particle) const { return xyz(state[Field::displacement][index(particle)]); }
    vec3 start(std::size_t particle) const { return xyz(state[Field::position][index(particle)]); }
    /// Lines in parts keep the edges and not the displacements.
    bool in_parts() const { return step.kernel == Kernel::line_parts; }
    vec3 edge(std::size_t e) const {
        if (!in_parts()) return spring_edge(start(e), start(e + 1), moved[e], moved[e + 1]);
        const vec3 before = spring_edge(start(e), start(e + 1), displacement(e), displacement(e + 1));
        return before + (delta[e + 1] - delta[e]);
    }
    std::vector<vec3> reduced(const std::vector<CyclicRow>& rows) const {
        return in_parts() ? reduced_in_parts(rows, step.subgroup) : drape::reduced(rows);
    }
    LineSpring spring(std::size_t e) const { return line_spring(edge(e), rest_length(e)); }
    float rest_length(std::size_t e) const { return model.rest_length(push.rest_length, index(e), push.channel); }
    /// Returns the target of bending at a place; places before the first, wrapped around, have the first's.
    vec3 target(std::size_t p) const {
        const std::size_t near = p < particles.size() ? p : p > 2 * particles.size() ? 0 : particles.size() - 1;
        return state.bend_target(particles[near], push.channel);
    }
    float share(std::size_t e) const {
        if (particles[e].x == push.seam) return 0.0f;
        return state.topology.masked() ? component(state.topology.spring_shares()[index(e)], push.channel)
                                       : border_share(particles[e], push.step, push.grid);
    }
    float last_tension(std::size_t e, float followed) const {
        return tension_in_use(state.tension(static_cast<std::size_t>(push.channel))[index(e)], reciprocal(followed));
    }
};

/// Solves the first system of a line. Returns the changes of its particles' displacements, m.
std::vector<vec3> tension_deltas(const LineView& line, const std::vector<float>& stiffness) {
    std::vector<vec4> eliminated;
    EliminatedParticle previous = unmoved_start();
    vec3 edge_before{0, 0, 0};
    float stiffness_before = 0;
    for (std::size_t p = 0; p < line.particles.size(); ++p) {
        const bool has_spring = p < line.spring_count();
        const vec3 edge = has_spring ? line.edge(p) : vec3{0, 0, 0};
        previous = eliminate_particle(previous, edge_before, stiffness_before, edge, has_spring ? stiffness[p] : 0.0f,
                                      line.weight(p));
        eliminated.push_back(previous.row);
        edge_before = edge;
        stiffness_before = has_spring ? stiffness[p] : 0.0f;
    }
    std::vector<vec3> delta(eliminated.size());
    vec3 after{0, 0, 0};
    for (std::size_t p = eliminated.size(); p-- > 0;) after = delta[p] = substitute_particle(eliminated[p], after);
    return delta;
}

/// Solves the first system by cyclic reduction.
std::vector<vec3> reduced_deltas(const LineView& line, const std::vector<float>& stiffness) {
    std::vector<CyclicRow> rows;
    vec3 edge_before{0, 0, 0};
    float stiffness_before = 0;
    for (std::size_t p = 0; p < line.particles.size(); ++p) {
        const bool has_spring = p < line.spring_count();
        const vec3 edge = has_spring ? line.edge(p) : vec3{0, 0, 0};
        const float after = has_spring ? stiffness[p] : 0.0f;
        rows.push_back(particle_row(edge_before, stiffness_before, edge, after, line.weight(p)));
        edge_before = edge;
        stiffness_before = after;
    }
    return line.reduced(rows);
}

/// Solves the first system of a line that bends by cyclic reduction.
std::vector<vec3> reduced_bent_deltas(const LineView& line, const std::vector<float>& stiffness, float bend) {
    const auto spring = [&](std::size_t e) {  // places before the first spring wrap around to beyond the last
        return e < line.spring_count() ? BentSpring(line.edge(e), stiffness[e], line.share(e))
                                       : BentSpring({0, 0, 0}, 0, 0);
    };
    std::vector<BentRow> rows;
    for (std::size_t p = 0; p < line.particles.size(); ++p)
        rows.push_back(bent_row(spring(p - 2), spring(p - 1), spring(p), spring(p + 1),
                                BentTargets(line.target(p - 1), line.target(p), line.target(p + 1)), bend,
                                line.weight(p), p % 2 != 0));
    return reduced(rows);
}

/// Solves the first system of a line that bends.
std::vector<vec3> bent_deltas(const LineView& line, const std::vector<float>& stiffness, float bend) {
    std::vector<BentParticle> eliminated;
    BentLine bent = unbent_line();
    const std::size_t last = line.spring_count();
    for (std::size_t p = 0; p < last; ++p) {
        const bool has_element = p + 1 < last;
        eliminated.push_back(
            eliminate_bent(bent, line.edge(p), stiffness[p],
                           beyond_rest(second_difference(-line.edge(p), has_element ? line.edge(p + 1) : vec3{0, 0, 0}),
                                       line.target(p + 1)),
                           element_bend(bend, line.share(p), has_element ? line.share(p + 1) : 0.0f), line.weight(p)));
        bent = eliminated.back().line;
    }
    eliminated.push_back(eliminate_last_bent(bent, line.weight(last)));
    std::vector<vec3> delta(eliminated.size());
    vec3 after{0, 0, 0}, turn{0, 0, 0};
    for (std::size_t p = eliminated.size(); p-- > 0;) {
        const BentParticle& particle = eliminated[p];
        turn = substitute_turn(texel(particle.turn, particle.by_turn), particle.by_shift, turn, after);
        after = delta[p] = bent_delta(after, turn);
    }
    return delta;
}

/// Lets the tension of the last substep and the bending resist, and follows the tension to where the particles are now.
void filter(LineView& line, float compliance, float followed, float bend) {
    std::vector<float> per_length, stiffness;
    for (std::size_t e = 0; e < line.spring_count(); ++e) {
        per_length.push_back(
            tension_per_length(line.last_tension(e, followed), line.start(e + 1) - line.start(e), line.rest_length(e)));
        stiffness.push_back(geometric_stiffness(per_length[e], line.share(e), reciprocal(compliance)));
    }
    if (line.step.kernel != Kernel::plain)
        line.delta = bend > 0 ? reduced_bent_deltas(line, stiffness, bend) : reduced_deltas(line, stiffness);
    else
        line.delta = bend > 0 ? bent_deltas(line, stiffness, bend) : tension_deltas(line, stiffness);
    for (std::size_t p = 0; p < line.particles.size(); ++p)
        line.moved[p] = moved_by(line.moved[p], line.delta[p], 1.0f);
    for (std::size_t e = 0; e < line.spring_count(); ++e)
        line.tension.push_back(filtered_tension(per_length[e], line.spring(e)));
}

/// Solves the second system. Returns the changes of the multipliers and raises `largest` to the worst spring's |C - T|.
std::vector<float> solve(const LineView& line, const std::vector<LineSpring>& springs, float compliance,
                         float& largest) {
    std::vector<vec2> eliminated(springs.size());
    vec2 previous{0, 0};
    vec3 after{0, 0, 0};
    for (std::size_t e = springs.size(); e-- > 0;) {
        const vec3 before = e > 0 ? springs[e - 1].normal : vec3{0, 0, 0};
        const float share = line.share(e);
        largest = larger_violation(largest, springs[e], share, line.push.compression, line.tension[e]);
        previous = eliminate_spring(previous, before, springs[e], after, line.weight(e), line.weight(e + 1), share,
                                    line.push.compression, compliance, line.tension[e]);
        eliminated[e] = previous;
        after = springs[e].normal;
    }
    std::vector<float> change(springs.size());
    float last = 0;
    for (std::size_t e = 0; e < springs.size(); ++e) last = change[e] = substitute_spring(eliminated[e], last);
    return change;
}

/// Solves the second system by cyclic reduction.
std::vector<float> reduced_changes(const LineView& line, const std::vector<LineSpring>& springs, float compliance,
                                   float& largest) {
    const vec3 none{0, 0, 0};
    std::vector<CyclicRow> rows;
    for (std::size_t e = 0; e < springs.size(); ++e) {
        const float share = line.share(e), compression = line.push.compression;
        largest = larger_violation(largest, springs[e], share, compression, line.tension[e]);
        rows.push_back(spring_row(e > 0 ? springs[e - 1].normal : none, springs[e],
                                  e + 1 < springs.size() ? springs[e + 1].normal : none, line.weight(e),
                                  line.weight(e + 1), share, compression, compliance, line.tension[e]));
    }
    std::vector<float> changes;
    for (const vec3& change : line.reduced(rows)) changes.push_back(change.x);
    return changes;
}

}  // namespace

void run_line(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<LinePush>();
    const bool is_bdf2 = state.integers(Field::line_control)[control_order] == 2u;
    const float compliance = is_bdf2 ? push.compliance_bdf2 : push.compliance;
    const float followed = is_bdf2 ? push.followed_bdf2 : push.followed;
    std::vector<float>& stored = state.tension(static_cast<std::size_t>(push.channel));
    for (int k = 0; k < push.line_count; ++k) {
        LineView line(model, step, state, k);
        if (step.iteration == 0)
            filter(line, compliance, followed, is_bdf2 ? push.bend_bdf2 : push.bend);
        else
            for (std::size_t e = 0; e < line.spring_count(); ++e)
                line.tension.push_back(line.last_tension(e, followed));
        std::vector<LineSpring> springs;
        for (std::size_t e = 0; e < line.spring_count(); ++e) springs.push_back(line.spring(e));
        float largest = 0;
        const std::vector<float> change = step.kernel != Kernel::plain
                                              ? reduced_changes(line, springs, compliance, largest)
                                              : solve(line, springs, compliance, largest);
        if (line_is_wrong(largest, push.rest_length)) ++state.integers(Field::line_control)[control_wrong_lines];
        const vec3 none{0, 0, 0};
        for (std::size_t p = 0; p < line.particles.size(); ++p) {
            const bool is_first = p == 0, is_last = p == springs.size();
            const vec3 correction =
                line_correction(is_first ? none : springs[p - 1].normal, is_first ? 0.0f : change[p - 1],
                                is_last ? none : springs[p].normal, is_last ? 0.0f : change[p]);
            const std::size_t i = line.index(p);
            state.move_to(i, moved_by_both(line.displacement(p), line.delta[p], correction, line.weight(p)));
            if (is_last) continue;
            const float share = line.share(p);
            stored[i] = stored_tension(
                changed_tension(line.tension[p], change[p], share, shared_compliance(compliance, share)), followed);
        }
    }
}

}  // namespace

std::vector<TwinRow> twin_line_rows() { return {{StepKind::predict, run_predict}, {StepKind::line, run_line}}; }

}  // namespace drape
