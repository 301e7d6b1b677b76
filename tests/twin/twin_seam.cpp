// The twin of the passes that keep sewn particles together.
#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {

using namespace glsl;

namespace {

/// Calls `give` with each of the cloth's particles at a place, the place, and what that was before the first of them.
template <class Give>
void for_sewn(const TwinPlace& where, const Give& give) {
    const std::vector<Sewn>& all = where.model.sewn;
    for (std::size_t own = 0; own < all.size(); ++own) {
        if (all[own].sewn.at.w == 0) continue;
        glsl::SewnPlace& place = (*where.state.sewn)[static_cast<std::size_t>(all[own].sewn.at.z)];
        const glsl::SewnPlace begun = place;
        const auto count = static_cast<std::size_t>(all[own].sewn.at.w);
        for (std::size_t k = 0; k < count; ++k) give(all[own + k], place, begun, count);
    }
}

std::vector<vec4>& vectors_of(const TwinPlace& where) {
    return where.state[where.step.push<SeamPush>().stage == seam_normals ? Field::normal : Field::wind_force];
}

/// Returns whether contact has written the position and the displacement of the substep before.
bool touches(const TwinPlace& where) {
    return where.step.push<SeamPush>().stage != seam_released && !where.scene.scene.colliders.empty();
}

void give_vectors(const TwinPlace& where) {
    const bool normals = where.step.push<SeamPush>().stage == seam_normals;
    for_sewn(where, [&](const Sewn& each, glsl::SewnPlace& place, const glsl::SewnPlace&, std::size_t) {
        const vec4 own = vectors_of(where)[each.particle];
        place.vector = each.sewn.weights.z != 0 ? own
                       : normals                ? texel(sewn_normal(xyz(place.vector), xyz(own)))
                                                : sewn_force(place.vector, own);
    });
}

void give_means(const TwinPlace& where) {
    TwinCloth& state = where.state;
    const bool touched = touches(where);
    for_sewn(where, [&](const Sewn& each, glsl::SewnPlace& place, const glsl::SewnPlace&, std::size_t) {
        const float share = each.sewn.weights.x;
        const vec4 moved = state[Field::displacement][each.particle];
        place.displacement = texel(sewn_mean(xyz(place.displacement), xyz(moved), share),
                                   share == 1.0f ? moved.w : place.displacement.w);
        place.remainder =
            texel(sewn_mean(xyz(place.remainder), xyz(state[Field::displacement_remainder][each.particle]), share));
        if (share != 1.0f) return;
        place.position = state[Field::position][each.particle];
        if (touched) place.before = where.before()[each.particle];
    });
}

void give_touched(const TwinPlace& where) {
    TwinCloth& state = where.state;
    float farthest = -1;
    for_sewn(where, [&](const Sewn& each, glsl::SewnPlace& place, const glsl::SewnPlace& begun, std::size_t count) {
        if (each.sewn.at.w > 0) farthest = -1;
        const vec4 start = state[Field::position][each.particle], moved = state[Field::displacement][each.particle];
        const float way = sewn_way(xyz(moved), xyz(begun.displacement), xyz(start), xyz(begun.position));
        if (count > 1 && !(way > farthest)) return;
        farthest = way;
        place.position = texel(xyz(start), begun.position.w);
        place.displacement = moved;
        if (!where.scene.scene.colliders.empty()) place.before = where.before()[each.particle];
    });
}

void give_solved(const TwinPlace& where) {
    for_sewn(where, [&](const Sewn& each, glsl::SewnPlace& place, const glsl::SewnPlace&, std::size_t) {
        const vec3 moved = xyz(where.state[Field::displacement][each.particle]);
        place.displacement = texel(sewn_mean(xyz(place.displacement), moved, each.sewn.parts.x), place.displacement.w);
    });
}

void run_give(const TwinPlace& where) {
    const int stage = where.step.push<SeamPush>().stage;
    if (stage >= seam_forces)
        give_vectors(where);
    else if (stage <= seam_released)
        give_means(where);
    else if (stage == seam_touched)
        give_touched(where);
    else
        give_solved(where);
}

void take_vectors(const TwinPlace& where) {
    const bool normals = where.step.push<SeamPush>().stage == seam_normals;
    for (const Sewn& each : where.model.sewn) {
        const vec4 sum = (*where.state.sewn)[static_cast<std::size_t>(each.sewn.at.z)].vector;
        vec4& own = vectors_of(where)[each.particle];
        if (!normals)
            own = own_force(sum, each.sewn.parts.y);
        else if (shares_normal(xyz(sum), xyz(own)))
            own = texel(unit_or_zero(xyz(sum)));
    }
}

void run_take(const TwinPlace& where) {
    const int stage = where.step.push<SeamPush>().stage;
    if (stage >= seam_forces) return take_vectors(where);
    TwinCloth& state = where.state;
    const bool predicted = stage <= seam_released, touched = touches(where);
    for (const Sewn& each : where.model.sewn) {
        const glsl::SewnPlace& place = (*state.sewn)[static_cast<std::size_t>(each.sewn.at.z)];
        state[Field::displacement][each.particle] = place.displacement;
        if (predicted) state[Field::displacement_remainder][each.particle] = place.remainder;
        if (touched) where.before()[each.particle] = place.before;
        if (predicted || touched)
            state[Field::position][each.particle] =
                texel(xyz(place.position), place.position.w == 0 ? 0 : each.sewn.weights.y);
    }
}

}  // namespace

std::vector<TwinRow> twin_seam_rows() { return {{StepKind::seam_give, run_give}, {StepKind::seam_take, run_take}}; }

}  // namespace drape
