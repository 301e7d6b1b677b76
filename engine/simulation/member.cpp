#include "simulation/member.h"

#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <utility>

#include "simulation/contact_report.h"
#include "simulation/frame_checks.h"
#include "simulation/scene_checks.h"
#include "world/motion.h"

namespace drape {

namespace {

constexpr std::size_t numbers_of_key = 6;  // translate, rotate

SceneDescription able_to_move(SceneDescription scene, const EnsembleControls& controls) {
    if (controls.pins)
        for (Cloth& cloth : scene.cloths)
            for (Pin& pin : cloth.pins)
                if (pin.path.keys.empty()) pin.path.keys.push_back({});
    if (controls.colliders)
        for (Collider& collider : scene.colliders)
            if (!collider.path.moves()) {
                const MotionKey rest = key_at(collider.path, 0);
                collider.path.keys = {rest, rest};
                collider.path.keys[1].time = 1;
            }
    return scene;
}

ModelOptions with_air(ModelOptions options, const EnsembleControls& controls) {
    options.air = options.air || controls.wind;
    return options;
}

std::size_t pin_count(const SimulationModel& model) {
    std::size_t count = 0;
    for (const Cloth& cloth : model.scene.cloths) count += cloth.pins.size();
    return count;
}

/// Changes a path so that from `from` to `to` (s) it moves to a key at constant speed, from wherever it is at `from`.
void go(MotionPath& path, double from, double to, std::span<const double> target) {
    const MotionKey now = key_at(path, from);
    const MotionKey end{to, {target[0], target[1], target[2]}, {target[3], target[4], target[5]}};
    // Keys beyond both ends make the cubic between the two times a straight line (world/motion.h).
    const auto beyond = [&](double at, double share) {
        MotionKey key{at, {}, {}};
        for (std::size_t k = 0; k < 3; ++k) {
            key.translate[k] = now.translate[k] + share * (end.translate[k] - now.translate[k]);
            key.rotate[k] = now.rotate[k] + share * (end.rotate[k] - now.rotate[k]);
        }
        return key;
    };
    path.keys = {beyond(from - (to - from), -1), now, end, beyond(to + (to - from), 2)};
}

void check_list(std::span<const double> numbers, const char* name, bool is_control, std::size_t per_member,
                std::size_t members) {
    if (numbers.empty()) return;
    if (!is_control)
        throw ActionError(
            fmt::format("actions: the ensemble was made without control of {0}: ask for it in controls", name), 0);
    if (numbers.size() != per_member * members)
        throw ActionError(fmt::format("actions: {} has {} numbers, {} members with {} each are {}", name,
                                      numbers.size(), members, per_member, per_member * members),
                          0);
    for (std::size_t k = 0; k < numbers.size(); ++k)
        if (!(std::abs(numbers[k]) <= FLT_MAX))
            throw ActionError(fmt::format("actions: member {}: {}: number {} is {}, expected a finite one",
                                          k / per_member, name, k % per_member, numbers[k]),
                              k / per_member);
}

}  // namespace

MemberMotion::MemberMotion(const SimulationModel& model) : wind(model.scene.wind) {
    for (const ClothModel& cloth : model.cloths)
        for (const DynamicPin& pin : cloth.dynamic_pins) pins.push_back(pin.path);
    for (const Collider& collider : model.scene.colliders) colliders.push_back(collider.path);
}

void MemberMotion::put_into(SimulationModel& model) const {
    model.scene.wind = wind;
    auto pin = pins.begin();
    for (std::size_t k = 0; k < model.cloths.size(); ++k)
        for (DynamicPin& each : model.cloths[k].dynamic_pins)
            model.scene.cloths[k].pins[each.number].path = each.path = *pin++;  // pictures draw the scene's paths
    for (std::size_t k = 0; k < colliders.size(); ++k) {
        model.scene.colliders[k].path = colliders[k];
        for (std::vector<KeptCollider>& list : model.kept_colliders) list[k].collider.path = colliders[k];
    }
}

Member::Member(const SceneDescription& scene, const EnsembleControls& controls, const ModelOptions& options)
    : model(able_to_move(checked_scene(scene), controls), with_air(options, controls)), start(model) {
    begin_anew();
}

void Member::begin_anew() {
    start.put_into(model);
    static_cast<MemberProgress&>(*this) = {};
    watch = std::make_unique<Watch>(model);
    self_contact = starting_report(model);
}

void Member::judge() {
    if (failure || std::exchange(judged, true)) return;
    FinishedFrame finished;
    finished.frame = frame;
    finished.statistics = statistics;
    finished.effort = effort;
    failure = frame_failure(model, *watch, finished);
}

void check_actions(const EnsembleActions& actions, const EnsembleControls& controls, const SimulationModel& model,
                   std::size_t member_count) {
    check_list(actions.wind, "wind", controls.wind, 3, member_count);
    check_list(actions.pins, "pins", controls.pins, numbers_of_key * pin_count(model), member_count);
    check_list(actions.colliders, "colliders", controls.colliders, numbers_of_key * model.scene.colliders.size(),
               member_count);
}

void act(const EnsembleActions& actions, std::size_t number, Member& member) {
    SimulationModel& model = member.model;
    const double fps = model.scene.time.fps, from = member.frame / fps, to = (member.frame + 1) / fps;
    if (!actions.wind.empty()) {
        std::copy_n(actions.wind.begin() + static_cast<std::ptrdiff_t>(3 * number), 3,
                    model.scene.wind.velocity.begin());
        model.scene.wind.gust.amplitude = 0;
        model.scene.wind.keys.clear();
    }
    const auto move_next = [&](MotionPath& path, std::span<const double> numbers, std::size_t first, bool acted) {
        if (!numbers.empty())
            go(path, from, to, numbers.subspan(numbers_of_key * first, numbers_of_key));
        else if (acted)
            path.keys = {key_at(path, from)};  // the collider stays where the last action put it
    };
    std::size_t pin = number * pin_count(model);
    for (std::size_t k = 0; k < model.cloths.size(); ++k) {
        for (DynamicPin& each : model.cloths[k].dynamic_pins) {
            move_next(each.path, actions.pins, pin + each.number, member.pins_acted);
            model.scene.cloths[k].pins[each.number].path = each.path;
        }
        pin += model.scene.cloths[k].pins.size();
    }
    for (std::size_t k = 0; k < model.scene.colliders.size(); ++k) {
        MotionPath& path = model.scene.colliders[k].path;
        move_next(path, actions.colliders, number * model.scene.colliders.size() + k, member.colliders_acted);
        for (std::vector<KeptCollider>& list : model.kept_colliders) list[k].collider.path = path;
    }
    member.pins_acted = member.pins_acted || !actions.pins.empty();
    member.colliders_acted = member.colliders_acted || !actions.colliders.empty();
}

}  // namespace drape
