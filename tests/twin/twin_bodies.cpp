// These passes of the twin are of the bodies that cloth moves.
#include "cloth/bodies.h"
#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/mesh_twin.h"
#include "twin/twin.h"

namespace drape {

namespace glsl {

/// Contact of a body with the planes of its scene.
struct BodyOnPlanes {
    const BodyMovePush& push;
    const ColliderRecord* colliders;

#include "include/body_step.h"
};

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

/// Contact of bodies with each other and with obstacles. Scenes may have every kind.
struct BodiesMeeting {
    static constexpr bool has_balls = true, has_boxes = true, has_ellipsoids = true, has_capsules = true,
                          has_hulls = true, boxes_meet = true;
    const bool obstacles_move;
    const BodyMovePush& push;
    const BodyConstants* body_constants;
    const ColliderRecord* colliders;
    const vec4* fields;
    const vec4* hull_points;
    MetBody* met_bodies;
    BodyMeeting* body_meetings;

    vec3 hull_point(int place) const { return xyz(hull_points[place]); }

#include "include/body_meet.h"
};

}  // namespace glsl

using namespace glsl;

namespace {

/// Returns a body as actions and gravity move it in a step's substep.
RigidBody driven_body(const SimulationModel& model, std::vector<vec4>& bodies, const Step& step,
                      const FrameInputs& inputs, std::size_t number) {
    const auto& push = step.push<BodyMovePush>();
    const BodyConstants own = body_constants(model, model.cloths[step.cloth].member)[number];
    RigidBody before = load_body(bodies, number);
    if (is_light(own)) {
        vec4 &given = bodies[number * body_texels + body_owed], &spin = bodies[number * body_texels + body_owed_spin];
        const BodyStrike owed{xyz(given), xyz(spin)}, paid = paid_part(owed, own, before.turn, given.w > 0.0f),
                                                      rest = unpaid_part(owed, paid);
        given = texel(rest.impulse);
        spin = texel(rest.moment);
        before = struck_body(before, own.inverse.w, paid.impulse, paid.moment);
    }
    const vec3 steady = xyz(push.gravity);
    const vec3 gravity = model.weighs ? steady + xyz(inputs.wind[static_cast<std::size_t>(push.weather)]) : steady;
    const float last_step = bodies[number * body_texels + body_last_spin].w;
    const RigidBody pushed =
        model.options.bodies
            ? acted_body(before, own, inputs.body_actions[static_cast<std::size_t>(push.first_action) + number],
                         push.begins == 1, gravity, last_step, push.gravity.w)
            : before;
    return fallen_body(pushed, gravity, fall_time(last_step, push.gravity.w));
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

void Twin::meet_bodies(const Step& step, const FrameInputs& inputs) {
    const auto& push = step.push<BodyMovePush>();
    const std::size_t member = model_->cloths[step.cloth].member;
    const std::vector<BodyConstants> constants = body_constants(*model_, member);
    const int all = push.body_count + push.obstacle_count;
    const std::shared_ptr<const std::vector<vec4>> made = twin_fields(*model_, inputs);
    std::vector<vec4>& bodies = cloths_[step.cloth][Field::bodies];
    std::vector<MetBody> met(constants.size());
    std::vector<BodyMeeting> meetings(static_cast<std::size_t>(pair_meetings * push.body_count * all));
    BodiesMeeting meeting{obstacles_move(*model_),
                          push,
                          constants.data(),
                          inputs.colliders.data(),
                          made ? made->data() : model_->mesh_fields.data(),
                          model_->bodies[member].hull_points.data(),
                          met.data(),
                          meetings.data()};
    const auto count = static_cast<std::size_t>(push.body_count);
    for (std::size_t number = 0; number < constants.size(); ++number)
        met[number] = number < count
                          ? meeting.met_body(driven_body(*model_, bodies, step, inputs, number), constants[number])
                          : meeting.met_obstacle(constants[number]);
    for (int pair = 0; pair < push.body_count * all; ++pair) meeting.find_meetings(pair, all);
    meeting.meet_all(all);
    for (std::size_t number = 0; number < count; ++number) {
        store_body(bodies, number, meeting.body_after_meetings(static_cast<int>(number), load_body(bodies, number)));
        bodies[number * body_texels + body_last_velocity] = {0, 0, 0, met[number].led.w};
    }
}

void Twin::move_bodies(const Step& step, FrameInputs& inputs) {
    const auto& push = step.push<BodyMovePush>();
    std::vector<vec4>& bodies = cloths_[step.cloth][Field::bodies];
    const std::vector<BodyConstants> constants = body_constants(*model_, model_->cloths[step.cloth].member);
    for (std::size_t number = 0; number < body_count(*model_); ++number) {
        const BodyConstants& own = constants[number];
        const RigidBody before = load_body(bodies, number);
        RigidBody body = before;
        float touched = bodies[number * body_texels + body_last_velocity].w;
        if (!bodies_meet(*model_)) {
            const RigidBody driven = driven_body(*model_, bodies, step, inputs, number);
            body = BodyOnPlanes{push, inputs.colliders.data()}.body_on_planes(driven, own);
            touched = touches_planes(driven, body);
        }
        const RigidBody now = moved_body(body, xyz(own.inverse), push.gravity.w);
        store_body(bodies, number, now);
        bodies[number * body_texels + body_last_velocity] = texel(now.velocity, touched);
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
    for (std::size_t number = 0; number < body_count(*model_); ++number) {
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
        const RigidBody body = load_body(bodies, number);
        const BodyStrike strike = strike_of(body, constants[number], {added[0], added[1], added[2]},
                                            {added[3], added[4], added[5]}, push.unit);
        if (!is_light(constants[number])) {
            store_body(bodies, number, struck_body(body, constants[number].inverse.w, strike.impulse, strike.moment));
            continue;
        }
        vec4 &owed = bodies[number * body_texels + body_owed], &spin = bodies[number * body_texels + body_owed_spin];
        const BodyStrike all = strikes_sum({xyz(owed), xyz(spin)}, strike);
        owed = texel(all.impulse, is_strike(strike) ? 1.0f : owed.w);
        spin = texel(all.moment);
    }
}

}  // namespace drape
