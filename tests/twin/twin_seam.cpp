// The twin of the passes that keep sewn particles together.
#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {

using namespace glsl;

namespace {

/// An entry of the list of sewn particles, as a pass that hands on sees it.
struct Given {
    const Sewn& each;
    std::size_t own;  ///< its index
    glsl::SewnPlace& place;
    const glsl::SewnPlace& begun;  ///< the place before any of the cloth's particles was counted
    std::size_t count;             ///< of the cloth's particles there

    const SewnParticle& sewn() const { return each.sewn; }
    std::size_t particle() const { return each.particle; }
    bool is_between() const { return each.sewn.between.x >= 0; }
};

bool has_ripped(const TwinPlace& where, std::size_t own) {
    const std::vector<vec4>& loads = where.state[Field::seam_loads];
    return !loads.empty() && loads[where.model.sewn[own].particle].w != 0;
}

template <class Give>
void for_sewn(const TwinPlace& where, const Give& give) {
    const std::vector<Sewn>& all = where.model.sewn;
    for (std::size_t first = 0; first < all.size(); ++first) {
        if (all[first].sewn.at.w == 0 || has_ripped(where, first)) continue;
        glsl::SewnPlace& place = (*where.state.sewn)[static_cast<std::size_t>(all[first].sewn.at.z)];
        const glsl::SewnPlace begun = place;
        const auto count = static_cast<std::size_t>(all[first].sewn.at.w);
        for (std::size_t k = 0; k < count; ++k) {
            if (where.step.push<SeamPush>().first == 1 && all[first + k].sewn.weights.z != 0) place.load = {};
            give(Given{all[first + k], first + k, place, begun, count});
        }
    }
}

int stage_of(const TwinPlace& where) { return where.step.push<SeamPush>().stage; }
bool moves_all(int stage) {
    return stage == seam_predicted || stage == seam_released || stage == seam_begun || stage == seam_met;
}
bool has_vectors(int stage) { return stage == seam_forces || stage == seam_normals || stage == seam_areas; }

std::vector<vec4>& vectors_of(const TwinPlace& where) {
    return where.state[stage_of(where) == seam_normals ? Field::normal : Field::wind_force];
}

/// Returns whether contact has written the position and the displacement of the substep before.
bool touches(const TwinPlace& where) {
    const int stage = stage_of(where);
    return stage == seam_met ||
           ((stage == seam_predicted || stage == seam_touched) && !where.scene.scene.colliders.empty());
}

/// Returns how much is left of a particle's gap.
glsl::vec2 left_of(const TwinPlace& where, const SewnParticle& sewn) {
    const int first = where.step.push<SeamPush>().opening;
    return where.inputs.openings[static_cast<std::size_t>(first + sewn.between.z)].left;
}

/// Returns where a particle's place is.
vec3 place_of(const TwinPlace& where, const SewnParticle& sewn, vec3 at) {
    if (sewn.between.z < 0) return at;
    const glsl::vec2 left = left_of(where, sewn);
    return sewn_together(at, xyz(sewn.gap),
                         stage_of(where) == seam_touched || stage_of(where) == seam_met ? left.y : left.x);
}

/// Adds what pulls a particle to the load on its seam.
void add_load(const TwinPlace& where, const Given& given, vec3 pull) {
    if (where.state[Field::seam_loads].empty() || given.sewn().carried.y == 0) return;
    given.place.load = seam_load(given.place.load, pull, given.sewn().carried.z);
}

/// Returns the force that has moved a particle of this inverse mass by so much.
vec3 pull_of(const TwinPlace& where, vec3 moved, float inverse_mass) {
    const glsl::vec2 force = where.step.push<SeamPush>().force;
    const bool is_bdf2 =
        where.model.scheme.second_order && where.state.integers(Field::line_control)[control_order] == 2u;
    return sewn_pull(moved, inverse_mass, is_bdf2 ? force.y : force.x);
}

vec3 lead_of(const TwinPlace& where, std::size_t own) { return xyz(where.state[Field::sewn_leads][own]); }

void give_vectors(const TwinPlace& where) {
    const bool normals = stage_of(where) == seam_normals, forces = stage_of(where) == seam_forces;
    for_sewn(where, [&](const Given& given) {
        vec4 own = vectors_of(where)[given.particle()];
        if (where.scene.weighs && forces)
            own = without_carried(own,
                                  xyz(where.inputs.wind[static_cast<std::size_t>(where.step.push<SeamPush>().weather)]),
                                  given.sewn().carried.x, where.state[Field::position][given.particle()].w);
        if (forces) add_load(where, given, xyz(own));
        if (given.is_between()) own = own_force(own, given.sewn().weights.w);
        vec4& sum = given.place.vector;
        sum = given.sewn().weights.z != 0 ? own
              : normals                   ? texel(sewn_normal(xyz(sum), xyz(own)))
                                          : sewn_force(sum, own);
    });
}

void give_means(const TwinPlace& where) {
    TwinCloth& state = where.state;
    const bool touched = touches(where), settled = stage_of(where) != seam_predicted;
    const bool counts_changes = !settled && !where.scene.method().iterates();
    for_sewn(where, [&](const Given& given) {
        glsl::SewnPlace& place = given.place;
        const bool leads = given.sewn().between.w == 1;
        const float share = !settled ? given.sewn().weights.x : leads ? 1.0f : 0.0f;
        const vec4 moved = state[Field::displacement][given.particle()];
        if (!settled && !where.scene.method().iterates())
            add_load(where, given, pull_of(where, xyz(moved), given.sewn().weights.y));
        const vec3 way =
            counts_changes && given.is_between() ? sewn_lead(xyz(moved), lead_of(where, given.own)) : xyz(moved);
        place.displacement =
            texel(sewn_mean(xyz(place.displacement), way, share), leads ? moved.w : place.displacement.w);
        place.remainder =
            texel(sewn_mean(xyz(place.remainder), xyz(state[Field::displacement_remainder][given.particle()]), share));
        if (!leads) return;
        const vec4 start = state[Field::position][given.particle()];
        place.position = texel(place_of(where, given.sewn(), xyz(start)), start.w);
        if (touched) place.before = where.before()[given.particle()];
    });
}

void give_touched(const TwinPlace& where) {
    TwinCloth& state = where.state;
    float farthest = -1;
    for_sewn(where, [&](const Given& given) {
        if (given.sewn().at.w > 0) farthest = -1;
        if (given.is_between()) return;
        const vec4 start = state[Field::position][given.particle()],
                   moved = state[Field::displacement][given.particle()];
        const vec3 from = place_of(where, given.sewn(), xyz(start));
        const float way = sewn_way(xyz(moved), xyz(given.begun.displacement), from, xyz(given.begun.position));
        if (given.count > 1 && !(way > farthest)) return;
        farthest = way;
        given.place.position = texel(from, given.begun.position.w);
        given.place.displacement = moved;
        if (!where.scene.scene.colliders.empty()) given.place.before = where.before()[given.particle()];
    });
}

void give_solved(const TwinPlace& where) {
    for_sewn(where, [&](const Given& given) {
        const glsl::vec4 parts = given.sewn().parts;
        vec3 moved = xyz(where.state[Field::displacement][given.particle()]);
        add_load(where, given,
                 pull_of(where, sewn_lead(moved, xyz(given.begun.displacement)),
                         dragged_weight(given.sewn().weights.y, given.begun.displacement.w)));
        if (given.is_between()) moved = sewn_lead(moved, lead_of(where, given.own));
        const vec3 mean = xyz(given.place.displacement);
        vec3 changed = sewn_change(mean, moved, xyz(given.begun.displacement), parts.y);
        if (given.begun.position.w == 0) changed = mean;
        given.place.displacement =
            texel(parts.w != 0 ? changed : sewn_mean(mean, moved, parts.x), given.place.displacement.w);
    });
}

void give_order(const TwinPlace& where) {
    const auto& push = where.step.push<SeamPush>();
    const auto& own = where.state.integers(Field::line_control);
    glsl::uvec4& control = (*where.state.sewn)[static_cast<std::size_t>(push.joint)].control;
    const LineControl joint =
        joined_control({control.x, control.y, push.begins == 1 ? 0u : control.z},
                       {own[control_order], own[control_wrong_lines], own[control_hold]}, push.most_wrong);
    control = {joint.order, joint.wrong_lines, joint.hold, 0};
}

/// As a frame ends, what comes apart has to know where it is.
void give_ends(const TwinPlace& where) {
    for_sewn(where, [&](const Given& given) {
        if (given.sewn().between.w == 1) given.place.position = where.state[Field::position][given.particle()];
    });
}

void run_give(const TwinPlace& where) {
    const int stage = stage_of(where);
    if (stage == seam_orders)
        give_order(where);
    else if (stage == seam_ripped)
        give_ends(where);
    else if (has_vectors(stage))
        give_vectors(where);
    else if (moves_all(stage))
        give_means(where);
    else if (stage == seam_touched)
        give_touched(where);
    else
        give_solved(where);
}

const glsl::SewnPlace& place_at(const TwinPlace& where, int index) {
    return (*where.state.sewn)[static_cast<std::size_t>(index)];
}

void take_vectors(const TwinPlace& where) {
    for (std::size_t index = 0; index < where.model.sewn.size(); ++index) {
        const Sewn& each = where.model.sewn[index];
        const SewnParticle& sewn = each.sewn;
        if (sewn.between.y == 0 || has_ripped(where, index)) continue;
        const bool is_between = sewn.between.x >= 0;
        vec4 sum = place_at(where, sewn.at.z).vector;
        const vec4 other = is_between ? place_at(where, sewn.between.x).vector : vec4{};
        vec4& own = vectors_of(where)[each.particle];
        if (stage_of(where) == seam_areas) {
            own = sum;
            continue;
        }
        if (stage_of(where) == seam_forces) {
            const vec4 force = own_force(sum, sewn.parts.y);
            own = is_between ? sewn_force(force, own_force(other, sewn.parts.z)) : force;
            continue;
        }
        if (is_between) sum = texel(sewn_between(xyz(sum), xyz(other), sewn.weights.w, sewn.gap.w));
        if (shares_normal(xyz(sum), xyz(own))) own = texel(unit_or_zero(xyz(sum)));
    }
}

/// Returns what is between two places.
glsl::SewnPlace between(const glsl::SewnPlace& one, const glsl::SewnPlace& other, float of_one, float of_other) {
    const auto mean = [&](const vec4& a, const vec4& b) {
        return texel(sewn_between(xyz(a), xyz(b), of_one, of_other), a.w);
    };
    glsl::SewnPlace place = one;
    place.position = mean(one.position, other.position);
    if (other.position.w != 0) place.position.w = other.position.w;
    place.displacement = mean(one.displacement, other.displacement);
    place.remainder = mean(one.remainder, other.remainder);
    place.before = mean(one.before, other.before);
    return place;
}

/// As a frame ends, places whose seam does not bear its load come apart.
void rip_places(const TwinPlace& where) {
    for (std::size_t own = 0; own < where.model.sewn.size(); ++own) {
        const SewnParticle& sewn = where.model.sewn[own].sewn;
        if (has_ripped(where, own) || sewn.carried.y == 0) continue;
        const glsl::SewnPlace& place = place_at(where, sewn.at.z);
        vec4& load = where.state[Field::seam_loads][where.model.sewn[own].particle];
        load = seam_load_of(place.load, where.step.push<SeamPush>().share, sewn.carried.y);
        if (load.w != 0)
            where.state[Field::position][where.model.sewn[own].particle] = texel(xyz(place.position), sewn.carried.w);
    }
}

void run_take(const TwinPlace& where) {
    const int stage = stage_of(where);
    if (stage == seam_ripped) return rip_places(where);
    if (has_vectors(stage)) return take_vectors(where);
    TwinCloth& state = where.state;
    const bool predicted = moves_all(stage), touched = touches(where), moves = stage == seam_predicted || touched;
    std::vector<vec4>& leads = state[Field::sewn_leads];
    leads.resize(where.model.sewn.size());
    for (std::size_t own = 0; own < leads.size(); ++own) {
        const Sewn& each = where.model.sewn[own];
        const SewnParticle& sewn = each.sewn;
        if (has_ripped(where, own)) continue;
        glsl::SewnPlace place = place_at(where, sewn.at.z);
        if (sewn.between.x >= 0) {
            const vec3 begun = xyz(place.displacement);
            place = between(place, place_at(where, sewn.between.x), sewn.weights.w, sewn.gap.w);
            leads[own] = texel(sewn_lead(xyz(place.displacement), begun));
        }
        if (sewn.between.y == 0) continue;
        state[Field::displacement][each.particle] = place.displacement;
        if (predicted) state[Field::displacement_remainder][each.particle] = place.remainder;
        if (touched) where.before()[each.particle] = place.before;
        if (!predicted && !touched) continue;
        vec3 at = xyz(place.position);
        if (sewn.between.z >= 0) {
            const glsl::vec2 left = left_of(where, sewn);
            at = sewn_apart(at, xyz(sewn.gap), moves ? left.y : left.x);
        }
        state[Field::position][each.particle] = texel(at, place.position.w == 0 ? 0 : sewn.weights.y);
    }
}

}  // namespace

std::vector<TwinRow> twin_seam_rows() { return {{StepKind::seam_give, run_give}, {StepKind::seam_take, run_take}}; }

}  // namespace drape
