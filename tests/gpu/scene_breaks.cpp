#include "scene_breaks.h"

#include <cmath>

#include "support/method_steps.h"

namespace drape::test {

namespace {

void for_each_cloth(SimulationModel& model, void (*change)(ClothModel&)) {
    for (ClothModel& cloth : model.cloths) change(cloth);
}

void no_collision(SimulationModel& model) { model.scene.colliders.clear(); }
template <class Shape>
void forgotten(SimulationModel& model) {
    std::erase_if(model.scene.colliders, [](const Collider& c) { return std::holds_alternative<Shape>(c.shape); });
}
void no_thickness(SimulationModel& model) {
    for_each_cloth(model, [](ClothModel& cloth) { cloth.collision.contact.x = 0; });
}
void no_friction(SimulationModel& model) {
    for_each_cloth(model, [](ClothModel& cloth) { cloth.collision.contact.y = 0; });
}
void colliders_still(SimulationModel& model) {
    for (Collider& collider : model.scene.colliders) collider.path = {};
}
void gravity_one_percent_off(SimulationModel& model) {
    for_each_cloth(model, [](ClothModel& cloth) {
        test::for_pushes<glsl::ForcePush>(cloth.plan, [](glsl::ForcePush& push) { push.gravity_step.y *= 1.01f; });
    });
}
void no_damping(SimulationModel& model) {
    for_each_cloth(model, [](ClothModel& cloth) {
        test::for_pushes<glsl::ForcePush>(cloth.plan, [](glsl::ForcePush& push) { push.damping_loss = 0; });
    });
}
void no_lift(SimulationModel& model) {
    for_each_cloth(model, [](ClothModel& cloth) { cloth.wind.lift_coefficient = 0; });
}
void no_wind(SimulationModel& model) {
    for_each_cloth(model, [](ClothModel& cloth) { cloth.wind.drag_coefficient = cloth.wind.lift_coefficient = 0; });
}
/// k h^2 becomes k h: the springs are 1 / h times too soft.
void compliance_lacks_a_step(SimulationModel& model) {
    for_each_cloth(model, [](ClothModel& cloth) {
        test::for_pushes<glsl::SpringPush>(
            cloth.plan, [&](glsl::SpringPush& push) { push.compliance /= static_cast<float>(cloth.substep_length); });
    });
}
void leave_out_springs(ClothModel& cloth, bool (*is_out)(int channel)) {
    std::erase_if(cloth.plan.iterated,
                  [&](const MethodStep& step) { return is_out(std::get<glsl::SpringPush>(step.constants).channel); });
}
void no_shear_springs(SimulationModel& model) {
    for_each_cloth(model,
                   [](ClothModel& cloth) { leave_out_springs(cloth, [](int channel) { return channel >= 2; }); });
}
void one_diagonal_only(SimulationModel& model) {
    for_each_cloth(model,
                   [](ClothModel& cloth) { leave_out_springs(cloth, [](int channel) { return channel == 3; }); });
}
/// The factor sqrt(2) of a diagonal's rest length.
void diagonals_too_short(SimulationModel& model) {
    for_each_cloth(model, [](ClothModel& cloth) {
        test::for_pushes<glsl::SpringPush>(cloth.plan, [&](glsl::SpringPush& push) {
            if (push.channel >= 2) push.rest_length = static_cast<float>(cloth.spacing[0]);
        });
    });
}
void pins_let_go(SimulationModel& model) {
    for_each_cloth(model, [](ClothModel& cloth) {
        for (std::size_t particle = 0; particle < cloth.position.size(); ++particle)
            cloth.position[particle].w = cloth.free_weight[particle];
    });
}
void pins_stay(SimulationModel& model) {
    for_each_cloth(model, [](ClothModel& cloth) {
        for (DynamicPin& pin : cloth.dynamic_pins) pin.path = {};
    });
}
void never_released(SimulationModel& model) {
    for_each_cloth(model, [](ClothModel& cloth) {
        for (DynamicPin& pin : cloth.dynamic_pins) pin.release.reset();
    });
}

void never_cut(SimulationModel& model) { model.scene.cutters.clear(); }
void border_weighs_as_inside(SimulationModel& model) {
    for_each_cloth(model, [](ClothModel& cloth) {
        for (glsl::vec4& x : cloth.position) x.w = x.w > 0 ? 1.0f : 0.0f;
    });
}

}  // namespace

const std::vector<SceneBreak>& scene_breaks() {
    static const std::vector<SceneBreak> breaks{
        {"", "pins_hold", "pins let go", 2, pins_let_go},
        {"", "mass_kept", "border weighs as inside", 2, border_weighs_as_inside},
        {"", "cut_pieces", "never cut", to_the_end, never_cut},
        {"capsules", "falls", "gravity 1 % too strong", 5, gravity_one_percent_off},
        {"capsules", "penetration", "capsules forgotten", 40, forgotten<Capsule>},
        {"capsules", "stretch", "compliance lacks a factor h", 60, compliance_lacks_a_step},
        {"cloth_on_sphere", "falls", "gravity 1 % too strong", 10, gravity_one_percent_off},
        {"cloth_on_sphere", "penetration", "no collision", 30, no_collision},
        {"cloth_on_sphere", "supported", "no thickness", 30, no_thickness},
        {"cloth_on_sphere", "stretch", "compliance lacks a factor h", 60, compliance_lacks_a_step},
        {"curtain", "pins_follow", "key-framed pins stay", 60, pins_stay},
        {"curtain", "drawn", "key-framed pins stay", 60, pins_stay},
        {"curtain", "stretch", "diagonals without sqrt(2)", 30, diagonals_too_short},
        {"flag", "torque", "no lift", 60, no_lift},
        {"flag", "blown", "no wind", 180, no_wind},
        {"flag", "stretch", "diagonals without sqrt(2)", 30, diagonals_too_short},
        {"four_colliders", "falls", "gravity 1 % too strong", 8, gravity_one_percent_off},
        {"four_colliders", "penetration", "ellipsoids forgotten", 30, forgotten<Ellipsoid>},
        {"four_colliders", "supported", "moving colliders stay", 120, colliders_still},
        {"four_colliders", "stretch", "compliance lacks a factor h", 60, compliance_lacks_a_step},
        {"hanging_sheet", "stretch_law", "no shear springs", 180, no_shear_springs},
        {"rotating_sphere", "penetration", "no collision", 30, no_collision},
        {"rotating_sphere", "carried", "no friction", 110, no_friction},
        {"two_cloths", "falls", "gravity 1 % too strong", 10, gravity_one_percent_off},
        {"two_cloths", "penetration", "boxes forgotten", 30, forgotten<Box>},
        {"two_cloths", "supported", "no thickness", 40, no_thickness},
        {"two_cloths", "released", "never released", 75, never_released},
        {"two_cloths", "swing", "no damping", 120, no_damping},
        {"two_cloths", "stretch", "compliance lacks a factor h", 30, compliance_lacks_a_step},
        {"two_corner_drape", "falls", "gravity 1 % too strong", 4, gravity_one_percent_off},
        {"two_corner_drape", "swing", "no damping", 60, no_damping},
        {"two_corner_drape", "mirror", "one diagonal only", 40, one_diagonal_only},
        {"two_corner_drape", "stretch", "compliance lacks a factor h", 60, compliance_lacks_a_step},
    };
    return breaks;
}

}  // namespace drape::test
