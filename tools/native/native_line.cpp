// Sixteen lines at a time, one per lane, each pass over them in the order of Twin::line.
#include "native_vectors.h"

namespace drape::native {

namespace {

/// 16 lines of a sheet.
struct Lines {
    const SheetView& sheet;
    const LinePush& push;
    int first, count;  ///< line of lane 0; lines, 16 at most
    float compliance, followed;

    bool along_rows() const { return push.step.y == 0; }
    /// Column of lane 0 at particle p of lines that go down.
    int column(int p) const {
        const int x = (first + push.step.x * p) % push.grid.x;
        return x < 0 ? x + push.grid.x : x;
    }
    /// Calls `each` with stretches of lanes whose texels lie side by side: (lane, texel, lanes).
    template <class Each>
    void stretches(int p, const Each& each) const {
        const int x = column(p), together = count < push.grid.x - x ? count : push.grid.x - x;
        each(0, sheet.place(x, p), together);
        if (together < count) each(together, sheet.place(0, p), count - together);
    }
};

SHARED vec3 at(const float (&v)[3][line_lanes], int lane) { return {v[0][lane], v[1][lane], v[2][lane]}; }

SHARED void put(float (&v)[3][line_lanes], int lane, vec3 value) {
    v[0][lane] = value.x;
    v[1][lane] = value.y;
    v[2][lane] = value.z;
}

SHARED void load_lane(const SheetView& sheet, const float* tension, LineParticles& to, int lane, std::ptrdiff_t from) {
    put(to.start, lane, load(sheet.position, from));
    put(to.displacement, lane, load(sheet.displacement, from));
    to.weight[lane] = sheet.weight[from];
    to.tension[lane] = tension[from];
}

/// Unused lanes hold still: weight and share are 0.
void load_lines(const Lines& lines, LineParticles* particles) {
    const LinePush& push = lines.push;
    const float* tension = lines.sheet.tension[push.channel];
    for (int p = 0; p < push.particle_count; ++p) {
        LineParticles& to = particles[p];
        if (lines.count < line_lanes) to = LineParticles{};
        if (lines.along_rows()) {
            for (int lane = 0; lane < lines.count; ++lane) {
                load_lane(lines.sheet, tension, to, lane, lines.sheet.place(p, lines.first + lane));
                to.share[lane] = border_share({p, lines.first + lane}, push.step, push.grid);
            }
            continue;
        }
        lines.stretches(p, [&](int first, std::ptrdiff_t from, int count) {
#pragma GCC ivdep
            for (int k = 0; k < count; ++k) load_lane(lines.sheet, tension, to, first + k, from + k);
        });
        const int x = lines.column(p);
        for (int lane = 0; lane < lines.count; ++lane) {
            const int column = x + lane < push.grid.x ? x + lane : x + lane - push.grid.x;
            to.share[lane] = column == push.seam ? 0.0f : border_share({column, p}, push.step, push.grid);
        }
    }
}

/// Tension in use of the springs; in a first iteration per length.
template <bool first_iteration>
void use_tension(const Lines& lines, LineParticles* particles) {
    const float per_followed = reciprocal(lines.followed);
    for (int p = 0; p + 1 < lines.push.particle_count; ++p) {
        LineParticles& here = particles[p];
        const LineParticles& next = particles[p + 1];
#pragma GCC ivdep
        for (int k = 0; k < line_lanes; ++k) {
            const float tension = tension_in_use(here.tension[k], per_followed);
            here.tension[k] = first_iteration ? tension_per_length(tension, at(next.start, k) - at(here.start, k),
                                                                   lines.push.rest_length)
                                              : tension;
        }
    }
}

/// Forward elimination of the first system.
void eliminate(const Lines& lines, LineParticles* particles) {
    alignas(64) float previous[4][line_lanes] = {}, left[line_lanes], edge_before[3][line_lanes] = {},
                      stiffness_before[line_lanes] = {};
    for (float& value : left) value = unmoved_start().left;
    const float per_compliance = reciprocal(lines.compliance);
    const int count = lines.push.particle_count;
    for (int p = 0; p < count; ++p) {
        LineParticles& here = particles[p];
        const LineParticles& next = particles[p + 1];
        const bool has_spring = p + 1 < count;
#pragma GCC ivdep
        for (int k = 0; k < line_lanes; ++k) {
            const vec3 between =
                spring_edge(at(here.start, k), at(next.start, k), at(here.displacement, k), at(next.displacement, k));
            const vec3 edge = chosen(has_spring, between, {0.0f, 0.0f, 0.0f});
            const float resisting = geometric_stiffness(here.tension[k], here.share[k], per_compliance);
            const float stiffness = has_spring ? resisting : 0.0f;
            const EliminatedParticle before{{previous[0][k], previous[1][k], previous[2][k], previous[3][k]}, left[k]};
            const auto [reduced, left_over] =
                eliminate_particle(before, at(edge_before, k), stiffness_before[k], edge, stiffness, here.weight[k]);
            here.eliminated[0][k] = previous[0][k] = reduced.x;
            here.eliminated[1][k] = previous[1][k] = reduced.y;
            here.eliminated[2][k] = previous[2][k] = reduced.z;
            here.eliminated[3][k] = previous[3][k] = reduced.w;
            left[k] = left_over;
            put(edge_before, k, edge);
            stiffness_before[k] = stiffness;
        }
    }
}

/// Leaves the springs as the first system moves the particles, which the second one needs.
template <bool first_iteration>
void move_particles(const Lines& lines, LineParticles* particles) {
    alignas(64) float after[3][line_lanes] = {}, moved_after[3][line_lanes] = {};
    for (int p = lines.push.particle_count - 1; p >= 0; --p) {
        LineParticles& here = particles[p];
        const LineParticles& next = particles[p + 1];
#pragma GCC ivdep
        for (int k = 0; k < line_lanes; ++k) {
            vec3 delta{0.0f, 0.0f, 0.0f}, moved = at(here.displacement, k);
            if (first_iteration) {
                delta = substitute_particle(
                    {here.eliminated[0][k], here.eliminated[1][k], here.eliminated[2][k], here.eliminated[3][k]},
                    at(after, k));
                moved = moved_by(moved, delta, 1.0f);
            }
            put(here.delta, k, delta);
            const LineSpring spring = line_spring(
                spring_edge(at(here.start, k), at(next.start, k), moved, at(moved_after, k)), lines.push.rest_length);
            put(here.spring.normal, k, spring.normal);
            here.spring.excess[k] = spring.excess;
            if (first_iteration) here.tension[k] = filtered_tension(here.tension[k], spring);
            put(after, k, delta);
            put(moved_after, k, moved);
        }
    }
}

/// Elimination of the second system, from the lines' ends; `largest` hears of the worst spring.
void eliminate_springs(const Lines& lines, LineParticles* particles, float (&largest)[line_lanes]) {
    alignas(64) float previous[2][line_lanes] = {}, after[3][line_lanes] = {};
    const LineParticles before_first{};
    for (int e = lines.push.particle_count - 2; e >= 0; --e) {
        LineParticles& here = particles[e];
        const LineParticles& before = e > 0 ? particles[e - 1] : before_first;
        const LineParticles& next = particles[e + 1];
        // A loop by itself: its conditions keep the compiler from vectorising, and would what follows.
#pragma GCC ivdep
        for (int k = 0; k < line_lanes; ++k) {
            const LineSpring spring{at(here.spring.normal, k), 0.0f, here.spring.excess[k]};
            largest[k] = larger_violation(largest[k], spring, here.share[k], lines.push.compression, here.tension[k]);
        }
#pragma GCC ivdep
        for (int k = 0; k < line_lanes; ++k) {
            const LineSpring spring{at(here.spring.normal, k), 0.0f, here.spring.excess[k]};
            const vec2 reduced = eliminate_spring({previous[0][k], previous[1][k]}, at(before.spring.normal, k), spring,
                                                  at(after, k), here.weight[k], next.weight[k], here.share[k],
                                                  lines.push.compression, lines.compliance, here.tension[k]);
            here.spring_eliminated[0][k] = previous[0][k] = reduced.x;
            here.spring_eliminated[1][k] = previous[1][k] = reduced.y;
            put(after, k, spring.normal);
        }
    }
}

/// Leaves displacements and stored tensions.
void correct(const Lines& lines, LineParticles* particles) {
    alignas(64) float change_before[line_lanes] = {}, normal_before[3][line_lanes] = {};
    const int count = lines.push.particle_count;
    for (int p = 0; p < count; ++p) {
        LineParticles& here = particles[p];
        const bool has_spring = p + 1 < count;
#pragma GCC ivdep
        for (int k = 0; k < line_lanes; ++k) {
            const float solved =
                substitute_spring({here.spring_eliminated[0][k], here.spring_eliminated[1][k]}, change_before[k]);
            const float change = has_spring ? solved : 0.0f;
            const vec3 normal = chosen(has_spring, at(here.spring.normal, k), {0.0f, 0.0f, 0.0f});
            const vec3 correction = line_correction(at(normal_before, k), change_before[k], normal, change);
            put(here.displacement, k,
                moved_by_both(at(here.displacement, k), at(here.delta, k), correction, here.weight[k]));
            const float tension = changed_tension(here.tension[k], change, here.share[k],
                                                  shared_compliance(lines.compliance, here.share[k]));
            here.tension[k] = stored_tension(tension, lines.followed);
            change_before[k] = change;
            put(normal_before, k, normal);
        }
    }
}

SHARED void store_lane(const SheetView& sheet, float* tension, const LineParticles& from, int lane, std::ptrdiff_t to,
                       bool has_spring) {
    store(sheet.displacement, to, at(from.displacement, lane));
    if (has_spring) tension[to] = from.tension[lane];
}

void store_lines(const Lines& lines, const LineParticles* particles) {
    float* const tension = lines.sheet.tension[lines.push.channel];
    for (int p = 0; p < lines.push.particle_count; ++p) {
        const LineParticles& from = particles[p];
        const bool has_spring = p + 1 < lines.push.particle_count;
        if (lines.along_rows()) {
            for (int lane = 0; lane < lines.count; ++lane)
                store_lane(lines.sheet, tension, from, lane, lines.sheet.place(p, lines.first + lane), has_spring);
            continue;
        }
        lines.stretches(p, [&](int first, std::ptrdiff_t to, int count) {
#pragma GCC ivdep
            for (int k = 0; k < count; ++k) store_lane(lines.sheet, tension, from, first + k, to + k, has_spring);
        });
    }
}

}  // namespace

std::uint32_t NATIVE_VARIANT::solve_lines(const SheetView& sheet, const LinePush& push, bool first_iteration,
                                          bool is_bdf2, int first, int last, LineParticles* scratch) {
    std::uint32_t wrong = 0;
    scratch[push.particle_count] = LineParticles{};
    for (int line = first; line < last; line += line_lanes) {
        const Lines lines{sheet,
                          push,
                          line,
                          last - line < line_lanes ? last - line : line_lanes,
                          is_bdf2 ? push.compliance_bdf2 : push.compliance,
                          is_bdf2 ? push.followed_bdf2 : push.followed};
        load_lines(lines, scratch);
        if (first_iteration) {
            use_tension<true>(lines, scratch);
            eliminate(lines, scratch);
            move_particles<true>(lines, scratch);
        } else {
            use_tension<false>(lines, scratch);
            move_particles<false>(lines, scratch);
        }
        alignas(64) float largest[line_lanes] = {};
        eliminate_springs(lines, scratch, largest);
        for (int k = 0; k < lines.count; ++k) wrong += line_is_wrong(largest[k], push.rest_length);
        correct(lines, scratch);
        store_lines(lines, scratch);
    }
    return wrong;
}

}  // namespace drape::native
