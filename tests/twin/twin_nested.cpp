// The twin relaxes nested boxes around lone pins.
#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {

using namespace glsl;

namespace {

constexpr vec3 none{0, 0, 0};

/// A line of a box, in one direction, as the shader sees it.
struct NestedLine {
    const ClothModel& model;
    TwinCloth& state;
    const NestedPush& push;
    int direction, seam;
    float compliance, followed;
    ivec2 step;
    std::vector<ivec2> particles;  // columns and rows in the cloth

    std::size_t index(std::size_t particle) const { return at(model.grid, particles[particle]); }
    float weight(std::size_t particle) const { return state.dragged_weight_of(index(particle)); }
    LineSpring spring(std::size_t e) const {
        const std::size_t a = index(e), b = index(e + 1);
        return line_spring(spring_edge(xyz(state[Field::position][a]), xyz(state[Field::position][b]),
                                       xyz(state[Field::displacement][a]), xyz(state[Field::displacement][b])),
                           model.rest_length(component(push.rest_length, direction), a, direction));
    }
    float share(std::size_t e) const {
        if (particles[e].x == seam) return 0.0f;
        return state.topology.masked() ? component(state.topology.spring_shares()[index(e)], direction)
                                       : border_share(particles[e], step, push.grid);
    }
    float& stored(std::size_t e) const { return state.tension(static_cast<std::size_t>(direction))[index(e)]; }

    /// Returns the changes of its springs' multipliers.
    std::vector<float> changes(const std::vector<LineSpring>& springs) const {
        const std::size_t count = springs.size();
        std::vector<vec2> eliminated(count);
        vec2 previous{0, 0};
        for (std::size_t e = count; e-- > 0;)
            eliminated[e] = previous =
                eliminate_spring(previous, e > 0 ? springs[e - 1].normal : none, springs[e],
                                 e + 1 < count ? springs[e + 1].normal : none, weight(e), weight(e + 1), share(e),
                                 push.compression, compliance, tension_in_use(stored(e), reciprocal(followed)));
        std::vector<float> changes;
        float before = 0;
        for (const vec2& row : eliminated) changes.push_back(before = substitute_spring(row, before));
        return changes;
    }

    void solve() const {
        const std::size_t count = particles.size() - 1;
        std::vector<LineSpring> springs;
        for (std::size_t e = 0; e < count; ++e) springs.push_back(spring(e));
        const std::vector<float> change = changes(springs);
        for (std::size_t p = 0; p <= count; ++p) {
            const bool is_first = p == 0, is_last = p == count;
            const vec3 correction =
                line_correction(is_first ? none : springs[p - 1].normal, is_first ? 0.0f : change[p - 1],
                                is_last ? none : springs[p].normal, is_last ? 0.0f : change[p]);
            state.move_to(index(p), moved_by(xyz(state[Field::displacement][index(p)]), correction, weight(p)));
            if (is_last || !(share(p) > 0.0f)) continue;
            const float tension = tension_in_use(stored(p), reciprocal(followed));
            stored(p) = stored_tension(
                changed_tension(tension, change[p], share(p), shared_compliance(compliance, share(p))), followed);
        }
    }
};

void solve_direction(const ClothModel& model, TwinCloth& state, const NestedPush& push, const NestedBox& box,
                     int direction, bool is_bdf2) {
    if (!(component(push.rest_length, direction) > 0.0f)) return;
    const ivec2 step = nested_step(direction);
    const int seam = nested_seam(step, box.size.x);
    for (int k = 0; k < (step.y == 0 ? box.size.y : box.size.x); ++k) {
        NestedLine line{model,
                        state,
                        push,
                        direction,
                        seam < 0 ? -1 : box.first.x + seam,
                        component(is_bdf2 ? push.compliance_bdf2 : push.compliance, direction),
                        component(is_bdf2 ? push.followed_bdf2 : push.followed, direction),
                        step,
                        {}};
        ivec2 in_box = line_start(k, step);
        for (int p = 0; p < (step.y == 0 ? box.size.x : box.size.y); ++p) {
            line.particles.push_back({box.first.x + in_box.x, box.first.y + in_box.y});
            in_box = next_on_line(in_box, step, box.size.x);
        }
        line.solve();
    }
}

void run_nested(const TwinPlace& where) {
    const auto& [scene, model, state, step, inputs, motions, meeting] = where;
    const auto& push = step.push<NestedPush>();
    const bool is_bdf2 = state.integers(Field::line_control)[control_order] == 2u;
    const std::vector<ivec4>& table = model.scheme.nested_table;
    const auto first = static_cast<std::size_t>(push.first_pin);
    for (std::size_t k = first; k < first + static_cast<std::size_t>(table[first].z); ++k) {
        const ivec2 pin{table[k].x, table[k].y};
        if (state[Field::position][at(model.grid, pin)].w != 0.0f) continue;
        for (std::size_t block = 0; block < static_cast<std::size_t>(push.block_count); ++block)
            for (int iteration = 0; iteration < table[block].z; ++iteration)
                for (int order = 0; order < 4; ++order)
                    solve_direction(model, state, push, nested_box(pin, {table[block].x, table[block].y}, push.grid),
                                    nested_direction(order), is_bdf2);
    }
}

}  // namespace

std::vector<TwinRow> twin_nested_rows() { return {{StepKind::nested, run_nested}}; }

}  // namespace drape
