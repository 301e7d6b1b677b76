// These passes of the twin are of the bodies that cloth moves.
#include "cloth/bodies.h"
#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {

namespace glsl {

/// Contact of a body with the planes of its scene.
struct BodyOnPlanes {
    const BodyMovePush& push;
    const ColliderRecord* colliders;

#include "include/body_step.h"
};

}  // namespace glsl

using namespace glsl;

namespace {

RigidBody load_body(const std::vector<vec4>& bodies, std::size_t number) {
    const vec4* const row = &bodies[number * body_texels];
    return {xyz(row[body_position]), xyz(row[body_remainder]), row[body_turn],
            xyz(row[body_velocity]), xyz(row[body_slower]),    xyz(row[body_spin])};
}

void store_body(std::vector<vec4>& bodies, std::size_t number, const RigidBody& body) {
    vec4* const row = &bodies[number * body_texels];
    row[body_position] = texel(body.position);
    row[body_remainder] = texel(body.remainder);
    row[body_turn] = body.turn;
    row[body_velocity] = texel(body.velocity);
    row[body_slower] = texel(body.slower);
    row[body_spin] = texel(body.spin);
}

}  // namespace

std::vector<float> body_distances(const TwinCloth& fine, const TwinCloth& coarse) {
    const std::vector<vec4>&one = fine[Field::bodies], &other = coarse[Field::bodies];
    std::vector<float> all;
    for (std::size_t row = 0; row < one.size(); row += body_texels)
        all.push_back(body_distance(xyz(one[row + body_position]), xyz(one[row + body_remainder]),
                                    xyz(other[row + body_position]), xyz(other[row + body_remainder])));
    return all;
}

void Twin::move_bodies(const Step& step, FrameInputs& inputs) {
    const auto& push = step.push<BodyMovePush>();
    std::vector<vec4>& bodies = cloths_[step.cloth][Field::bodies];
    const std::vector<BodyConstants> constants = body_constants(*model_, model_->cloths[step.cloth].member);
    for (std::size_t number = 0; number < constants.size(); ++number) {
        const BodyConstants& own = constants[number];
        const RigidBody before = load_body(bodies, number);
        const vec3 steady = xyz(push.gravity);
        const vec3 gravity =
            model_->weighs ? steady + xyz(inputs.wind[static_cast<std::size_t>(push.weather)]) : steady;
        const float last_step = bodies[number * body_texels + body_last_spin].w;
        const RigidBody pushed =
            model_->options.bodies
                ? acted_body(before, own, inputs.body_actions[static_cast<std::size_t>(push.first_action) + number],
                             push.begins == 1, gravity, last_step, push.gravity.w)
                : before;
        const RigidBody fallen = fallen_body(pushed, gravity, fall_time(last_step, push.gravity.w));
        const RigidBody body = BodyOnPlanes{push, inputs.colliders.data()}.body_on_planes(fallen, own);
        const RigidBody now = moved_body(body, xyz(own.inverse), push.gravity.w);
        store_body(bodies, number, now);
        bodies[number * body_texels + body_last_velocity] = texel(now.velocity, touches_planes(fallen, body));
        bodies[number * body_texels + body_last_spin] = texel(now.spin, push.gravity.w);
        for (int list = 0; list < push.list_count; ++list) {
            ColliderRecord& record =
                inputs.colliders[static_cast<std::size_t>(push.first + list * push.record_count + own.what.y)];
            record = placed_record(record, own, before, now);
        }
    }
}

void Twin::strike_bodies(const Step& step) {
    const auto& push = step.push<BodyStrikePush>();
    std::vector<vec4>& bodies = cloths_[bearer_of(step.cloth)][Field::bodies];
    const std::vector<uint>& impulses = cloths_[step.cloth].integers(Field::impulses);
    std::vector<uint>& struck = cloths_[step.cloth].integers(Field::struck);
    const std::vector<BodyConstants> constants = body_constants(*model_, model_->cloths[step.cloth].member);
    for (std::size_t number = 0; number < constants.size(); ++number) {
        const std::size_t row = static_cast<std::size_t>(impulse_first + constants[number].what.y) * impulse_columns;
        std::array<float, impulse_numbers> added{};
        for (std::size_t k = 0; k < added.size(); ++k) {
            uint* const kept = &struck[number * impulse_columns + 2 * k];
            const ImpulseWords now{impulses[row + 2 * k], impulses[row + 2 * k + 1]};
            const ImpulseWords before = push.begins == 0 ? ImpulseWords{kept[0], kept[1]} : ImpulseWords{0, 0};
            added[k] = words_number(words_difference(now, before));
            kept[0] = now.low;
            kept[1] = now.high;
        }
        store_body(bodies, number,
                   body_after_cloth(load_body(bodies, number), constants[number], {added[0], added[1], added[2]},
                                    {added[3], added[4], added[5]}, push.unit));
    }
}

}  // namespace drape
