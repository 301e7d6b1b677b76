#include "simulation/member.h"

#include <utility>

#include "simulation/contact_report.h"
#include "simulation/frame_checks.h"
#include "simulation/member_actions.h"
#include "simulation/scene_checks.h"

namespace drape {

MemberMotion::MemberMotion(const SimulationModel& model) : wind(model.scene.wind), gravity(model.scene.gravity_keys) {
    for (const ClothModel& cloth : model.cloths)
        pins.insert(pins.end(), cloth.dynamic_pins.begin(), cloth.dynamic_pins.end());
    for (const Collider& collider : model.scene.colliders) colliders.push_back(collider.path);
    for (const Body& body : model.bodies.front().bodies) bodies.push_back(body.acts);
    for (const Cloth& cloth : model.scene.cloths) loads.insert(loads.end(), cloth.loads.begin(), cloth.loads.end());
}

void MemberMotion::put_into(SimulationModel& model) const {
    model.scene.wind = wind;
    model.scene.gravity_keys = gravity;
    auto load = loads.begin();
    for (Cloth& cloth : model.scene.cloths)
        for (Load& each : cloth.loads) each = *load++;
    auto pin = pins.begin();
    for (std::size_t k = 0; k < model.cloths.size(); ++k)
        for (DynamicPin& each : model.cloths[k].dynamic_pins) {
            each = *pin++;
            if (!each.hand) model.scene.cloths[k].pins[each.number].path = each.path;  // pictures draw these paths
        }
    for (std::size_t k = 0; k < bodies.size(); ++k) model.bodies.front().bodies[k].acts = bodies[k];
    for (std::size_t k = 0; k < colliders.size(); ++k) {
        model.scene.colliders[k].path = colliders[k];
        for (std::vector<KeptCollider>& list : model.kept_colliders) list[k].collider.path = colliders[k];
    }
}

Member::Member(const SceneDescription& scene, const EnsembleControls& controls, const ModelOptions& options)
    : model(able_to_move(checked_scene(scene), controls), controlled(options, controls)), start(model) {
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
    finished.bodies = bodies;
    finished.effort = effort;
    failure = frame_failure(model, *watch, finished);
}

}  // namespace drape
