// The kernels of everything but lines, and the table of all.
#include "native_vectors.h"

namespace drape::native {

namespace NATIVE_VARIANT {

namespace {

// --- What begins and ends a substep, particle by particle. Constants are copied out of the push structures: a loop
// that loads them under a condition is not vectorised.

vec3 forward(const vec4& v) { return {v.x, v.y, v.z}; }

const vec3 no_force{0.0f, 0.0f, 0.0f};

template <bool advance>
void force(const SheetView& sheet, const ForcePush& push, Rows rows) {
    const vec3 gravity = forward(push.gravity_step);
    const float force_step = push.force_step, loss = push.damping_loss;
    const int count = sheet.whole_vectors();
    for (int y = rows.first; y < rows.last; ++y) {
        const std::ptrdiff_t row = sheet.place(0, y);
#pragma GCC ivdep
        for (int x = 0; x < count; ++x) {
            const std::ptrdiff_t at = row + x;
            const vec3 displacement = load(sheet.displacement, at);
            if (advance) advance_particle(sheet, at, load(sheet.position, at), displacement);
            step_particle(sheet, at, displacement,
                          verlet_increment(displacement, gravity, no_force, sheet.weight[at], force_step, loss));
        }
    }
}

template <bool advance, bool is_bdf2>
void predict(const SheetView& sheet, const PredictPush& push, Rows rows) {
    const vec3 gravity = forward(is_bdf2 ? push.gravity_step_bdf2 : push.gravity_step);
    const float force_step = is_bdf2 ? push.force_step.y : push.force_step.x;
    const float loss = is_bdf2 ? push.loss.y : push.loss.x, old_weight = push.weight.x, new_weight = push.weight.y;
    const int count = sheet.whole_vectors();
    for (int y = rows.first; y < rows.last; ++y) {
        const std::ptrdiff_t row = sheet.place(0, y);
#pragma GCC ivdep
        for (int x = 0; x < count; ++x) {
            const std::ptrdiff_t at = row + x;
            const vec3 displacement = load(sheet.displacement, at), before = load(sheet.displacement_before, at);
            if (advance) advance_particle(sheet, at, load(sheet.position, at), displacement);
            const vec3 excess_before = load(sheet.velocity_excess, at), excess = velocity_excess(displacement, before);
            store(sheet.displacement_before, at, displacement);
            store(sheet.velocity_excess, at, excess);
            const float weight = sheet.weight[at];
            step_particle(sheet, at, displacement,
                          is_bdf2 ? bdf2_increment(displacement, before, excess, excess_before,
                                                   forced_step(gravity, no_force, weight, force_step), old_weight,
                                                   new_weight, loss)
                                  : verlet_increment(displacement, gravity, no_force, weight, force_step, loss));
        }
    }
}

void force_rows(const SheetView& sheet, const ForcePush& push, bool advance, Rows rows) {
    return advance ? force<true>(sheet, push, rows) : force<false>(sheet, push, rows);
}

void predict_rows(const SheetView& sheet, const PredictPush& push, bool advance, bool is_bdf2, Rows rows) {
    if (is_bdf2) return advance ? predict<true, true>(sheet, push, rows) : predict<false, true>(sheet, push, rows);
    return advance ? predict<true, false>(sheet, push, rows) : predict<false, false>(sheet, push, rows);
}

void advance_rows(const SheetView& sheet, Rows rows) {
    for (int y = rows.first; y < rows.last; ++y) {
        const std::ptrdiff_t row = sheet.place(0, y);
#pragma GCC ivdep
        for (std::ptrdiff_t at = row; at < row + sheet.columns; ++at)
            advance_particle(sheet, at, load(sheet.position, at), load(sheet.displacement, at));
    }
}

// --- Springs relaxed pair by pair.

/// `count` pairs, `stride` columns apart, of one row's particles with those `to_second` further in memory.
template <int stride>
void relax(const SheetView& sheet, const SpringPush& push, std::ptrdiff_t first_at, std::ptrdiff_t to_second, int count,
           float share) {
    const float rest_length = push.rest_length, compression = push.compression, compliance = push.compliance;
#pragma GCC ivdep
    for (int k = 0; k < count; ++k) {
        const std::ptrdiff_t first = first_at + stride * k, second = first + to_second;
        const float weight_first = sheet.weight[first], weight_second = sheet.weight[second];
        const vec3 moved_first = load(sheet.displacement, first), moved_second = load(sheet.displacement, second);
        const vec3 edge =
            spring_edge(load(sheet.position, first), load(sheet.position, second), moved_first, moved_second);
        const SpringResult result =
            project_spring(edge, weight_first + weight_second, rest_length, share, compression, compliance, 0.0f);
        store(sheet.displacement, first, moved_by(moved_first, result.correction, -weight_first));
        store(sheet.displacement, second, moved_by(moved_second, result.correction, weight_second));
    }
}

void spring_rows(const SheetView& sheet, const SpringPush& push, Rows rows) {
    const std::ptrdiff_t to_second = push.offset.y * sheet.pitch + push.offset.x;
    const int last = push.grid.x - 1;
    for (int pair = rows.first; pair < rows.last; ++pair) {
        const ivec2 owner = spring_owner({0, pair}, push.offset, push.parity_axis, push.parity);
        const std::ptrdiff_t first = sheet.place(owner.x, owner.y);
        if (push.parity_axis == 0) {
            const float share = border_share({1, owner.y}, push.offset, push.grid);
            relax<2>(sheet, push, first, to_second, push.pair_count.x, share);
        } else if (push.offset.x == 0) {  // borders have half
            relax<1>(sheet, push, first, to_second, 1, 0.5f);
            relax<1>(sheet, push, first + 1, to_second, last - 1, 1.0f);
            relax<1>(sheet, push, first + last, to_second, 1, 0.5f);
        } else {
            relax<1>(sheet, push, first, to_second, push.pair_count.x, 1.0f);
        }
    }
}

// --- Explicit steps: every spring once; its pull is added to one end and subtracted from the other, in the order of
// every sum over springs (include/explicit.h).

struct RowView {
    Vectors position, displacement;
};

RowView row_of(const SheetView& sheet, int y) {
    return {sheet.position.from(sheet.place(0, y)), sheet.displacement.from(sheet.place(0, y))};
}

/// Springs from the first `count` particles of a row to those `offset` further in another; also those that do not
/// exist.
template <bool advance>
void pull(const RowView& a, const RowView& b, int offset, int count, float rest_length, const float* stiffness,
          float compression, float strain_damping, const Vectors& out) {
#pragma GCC ivdep
    for (int x = 0; x < count; ++x) {
        const vec3 start = load(a.position, x), end = load(b.position, x + offset);
        const vec3 moved_start = load(a.displacement, x), moved_end = load(b.displacement, x + offset);
        const vec3 edge = advance ? spring_edge(start, end, moved_start, moved_end) : end - start;
        store(out, x,
              spring_pull(edge, moved_end - moved_start, rest_length, stiffness[x], compression, strain_damping));
    }
}

/// Springs from a row to the one below: down, down-right, down-left.
template <bool advance>
void pull_down(const SheetView& sheet, const ExplicitPush& push, const RowView& a, const RowView& b,
               const ExplicitScratch& scratch, const Vectors (&out)[3]) {
    const int count = sheet.whole_vectors();
    pull<advance>(a, b, 0, count, push.rest_length.y, scratch.stiffness[2], push.compression.x, push.strain_damping,
                  out[0]);
    pull<advance>(a, b, 1, count, push.rest_length.z, scratch.stiffness[3], push.compression.x, push.strain_damping,
                  out[1]);
    pull<advance>(a, b, -1, count, push.rest_length.w, scratch.stiffness[3], push.compression.x, push.strain_damping,
                  out[2]);
}

/// Springs that do not exist, beyond the ends of the rows: -0 where particles start them and +0, which is subtracted,
/// where they end them. Neither changes a bit of a sum.
void clear_ends(int columns, const Vectors& along, const Vectors& right, const Vectors& left) {
    const vec3 nothing{0.0f, 0.0f, 0.0f};
    const Vectors starting[] = {along, right};
    for (const Vectors& pulls : starting) {
        store(pulls, -1, nothing);
        store(pulls, columns - 1, no_pull);
    }
    store(left, 0, no_pull);
    store(left, columns, nothing);
}

/// Three rows of springs that do not exist.
void clear(int columns, const Vectors (&rows)[3], float zero) {
    for (const Vectors& pulls : rows)
        for (int x = -1; x <= columns; ++x) store(pulls, x, {zero, zero, zero});
}

template <bool advance>
void update_row(const SheetView& sheet, const ExplicitPush& push, int y, const ExplicitScratch& scratch) {
    const std::ptrdiff_t row = sheet.place(0, y);
    const vec3 gravity{push.gravity_step.x, push.gravity_step.y, push.gravity_step.z};
    const float force_step = push.force_step, loss = push.damping_loss;  // not loaded under a condition
    const int count = sheet.whole_vectors();
#pragma GCC ivdep
    for (int x = 0; x < count; ++x) {
        vec3 sum = no_pull;
        sum = sum - load(scratch.above[1], x - 1);
        sum = sum - load(scratch.above[0], x);
        sum = sum - load(scratch.above[2], x + 1);
        sum = sum - load(scratch.along, x - 1);
        sum = sum + load(scratch.along, x);
        sum = sum + load(scratch.below[2], x);
        sum = sum + load(scratch.below[0], x);
        sum = sum + load(scratch.below[1], x);
        const std::ptrdiff_t at = row + x;
        const vec3 displacement = load(sheet.displacement, at);
        if (advance) advance_particle(sheet, at, load(sheet.position, at), displacement);
        const vec3 increment =
            explicit_increment(displacement, gravity, {0.0f, 0.0f, 0.0f}, sum, sheet.weight[at], force_step, loss);
        step_particle(sheet, at, displacement, increment);
    }
}

template <bool advance>
void step_rows(const SheetView& sheet, const ExplicitPush& push, Rows rows, ExplicitScratch scratch) {
    for (int y = rows.first; y < rows.last; ++y) {
        const RowView here = row_of(sheet, y), copied{scratch.next_position, scratch.next_displacement};
        const float* along = scratch.stiffness[y == 0 || y == sheet.rows - 1 ? 1 : 0];
        pull<advance>(here, here, 1, sheet.whole_vectors(), push.rest_length.x, along, push.compression.x,
                      push.strain_damping, scratch.along);
        if (y + 1 < sheet.rows)
            pull_down<advance>(sheet, push, here, y + 1 < rows.last ? row_of(sheet, y + 1) : copied, scratch,
                               scratch.below);
        else
            clear(sheet.columns, scratch.below, -0.0f);
        clear_ends(sheet.columns, scratch.along, scratch.below[1], scratch.below[2]);
        update_row<advance>(sheet, push, y, scratch);
        for (int k = 0; k < 3; ++k) {
            const Vectors above = scratch.above[k];
            scratch.above[k] = scratch.below[k];
            scratch.below[k] = above;
        }
    }
}

template <bool advance>
void prepare_rows(const SheetView& sheet, const ExplicitPush& push, Rows rows, const ExplicitScratch& scratch) {
    if (rows.first > 0)
        pull_down<advance>(sheet, push, row_of(sheet, rows.first - 1), row_of(sheet, rows.first), scratch,
                           scratch.above);
    else
        clear(sheet.columns, scratch.above, 0.0f);
    clear_ends(sheet.columns, scratch.along, scratch.above[1], scratch.above[2]);
    if (rows.last == sheet.rows) return;
    const RowView next = row_of(sheet, rows.last);
    for (int x = 0; x < sheet.columns; ++x) {
        store(scratch.next_position, x, load(next.position, x));
        store(scratch.next_displacement, x, load(next.displacement, x));
    }
}

void prepare_explicit(const SheetView& sheet, const ExplicitPush& push, bool advance, Rows rows,
                      const ExplicitScratch& scratch) {
    return advance ? prepare_rows<true>(sheet, push, rows, scratch) : prepare_rows<false>(sheet, push, rows, scratch);
}

void explicit_rows(const SheetView& sheet, const ExplicitPush& push, bool advance, Rows rows,
                   const ExplicitScratch& scratch) {
    return advance ? step_rows<true>(sheet, push, rows, scratch) : step_rows<false>(sheet, push, rows, scratch);
}

}  // namespace

}  // namespace NATIVE_VARIANT

#define NATIVE_NAME_OF(variant) variant##_kernels
#define NATIVE_NAME(variant) NATIVE_NAME_OF(variant)

const Kernels& NATIVE_NAME(NATIVE_VARIANT)() {
    using namespace NATIVE_VARIANT;
    static constexpr Kernels kernels{prepare_explicit, explicit_rows, force_rows, predict_rows,
                                     advance_rows,     spring_rows,   solve_lines};
    return kernels;
}

}  // namespace drape::native
