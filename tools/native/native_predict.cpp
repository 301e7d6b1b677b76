// What begins and ends a substep: particle by particle. Constants are copied out of the push structures: a loop that
// loads them under a condition is not vectorised.
#include "native_vectors.h"

namespace drape::native {

namespace {

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

}  // namespace

void NATIVE_VARIANT::force_rows(const SheetView& sheet, const ForcePush& push, bool advance, Rows rows) {
    return advance ? force<true>(sheet, push, rows) : force<false>(sheet, push, rows);
}

void NATIVE_VARIANT::predict_rows(const SheetView& sheet, const PredictPush& push, bool advance, bool is_bdf2,
                                  Rows rows) {
    if (is_bdf2) return advance ? predict<true, true>(sheet, push, rows) : predict<false, true>(sheet, push, rows);
    return advance ? predict<true, false>(sheet, push, rows) : predict<false, false>(sheet, push, rows);
}

void NATIVE_VARIANT::advance_rows(const SheetView& sheet, Rows rows) {
    for (int y = rows.first; y < rows.last; ++y) {
        const std::ptrdiff_t row = sheet.place(0, y);
#pragma GCC ivdep
        for (std::ptrdiff_t at = row; at < row + sheet.columns; ++at)
            advance_particle(sheet, at, load(sheet.position, at), load(sheet.displacement, at));
    }
}

}  // namespace drape::native
