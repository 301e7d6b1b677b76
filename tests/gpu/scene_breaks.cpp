#include "scene_breaks.h"

namespace drape::test {

namespace {

template <class Shape>
void forgotten(SceneDescription& scene) {
    std::erase_if(scene.colliders, [](const Collider& c) { return std::holds_alternative<Shape>(c.shape); });
}
void no_collision(SceneDescription& scene) { scene.colliders.clear(); }
void no_thickness(SceneDescription& scene) {
    for (Cloth& cloth : scene.cloths) {
        cloth.thickness = 0;
        cloth.contact = ContactOf::particles;  // else the edges of a box keep coarse cells nearly as high
    }
}
void no_friction(SceneDescription& scene) {
    for (Cloth& cloth : scene.cloths) cloth.friction = 0;
}
void colliders_still(SceneDescription& scene) {
    for (Collider& collider : scene.colliders) collider.path = {};
}
void gravity_one_percent_off(SceneDescription& scene) { scene.gravity[1] *= 1.01; }
void no_damping(SceneDescription& scene) {
    for (Cloth& cloth : scene.cloths) cloth.damping = 0;
}
void no_lift(SceneDescription& scene) { scene.wind.lift = 0; }
void no_wind(SceneDescription& scene) { scene.wind.velocity = {}; }
/// Springs are as soft as if k h^2 were k h with 1000 substeps a second.
void springs_a_thousand_times_too_soft(SceneDescription& scene) {
    for (Cloth& cloth : scene.cloths) {
        cloth.stiffness.stretch *= 1e-3;
        cloth.stiffness.shear /= 1000;
    }
}
void no_shear_springs(SceneDescription& scene) {
    for (Cloth& cloth : scene.cloths) cloth.stiffness.shear = 0;
}
void pins_stay(SceneDescription& scene) {
    for (Cloth& cloth : scene.cloths)
        for (Pin& pin : cloth.pins) pin.path = {};
}
void never_released(SceneDescription& scene) {
    for (Cloth& cloth : scene.cloths)
        for (Pin& pin : cloth.pins) pin.release.reset();
}
void no_self_collision(SceneDescription& scene) {
    for (Cloth& cloth : scene.cloths) cloth.self_collision.reset();
}
void no_loads(SceneDescription& scene) {
    for (Cloth& cloth : scene.cloths) cloth.loads.clear();
}
void never_sewn(SceneDescription& scene) {
    scene.seams.clear();
    scene.gas.clear();
}
void never_cut(SceneDescription& scene) {
    scene.cutters.clear();
    for (Cloth& cloth : scene.cloths) cloth.tear.reset();
}

/// What cloth gives to bodies is lost: it is nothing to such a mass.
void bodies_feel_no_cloth(SceneDescription& scene) {
    for (Collider& collider : scene.colliders)
        if (collider.mass) collider.mass = 1e6 * *collider.mass;
}

void bodies_pass_through_each_other(SimulationModel& model) {
    for (MemberBodies& each : model.bodies) {
        each.meet = false;
        each.obstacles.clear();
    }
}

void pins_let_go(SimulationModel& model) {
    for (ClothModel& cloth : model.cloths)
        for (std::size_t particle = 0; particle < cloth.position.size(); ++particle)
            cloth.position[particle].w = cloth.free_weight[particle];
}
void border_weighs_as_inside(SimulationModel& model) {
    for (ClothModel& cloth : model.cloths)
        for (glsl::vec4& x : cloth.position) x.w = x.w > 0 ? 1.0f : 0.0f;
}
/// Columns right of the middle move as if they were half as heavy.
void one_side_weighs_half(SimulationModel& model) {
    for (ClothModel& cloth : model.cloths)
        for (std::size_t particle = 0; particle < cloth.position.size(); ++particle)
            if (particle % cloth.grid.columns() > cloth.grid.columns() / 2) cloth.position[particle].w *= 2;
}

const std::vector<SceneBreak> breaks{
    {"", "pins_hold", "pins let go", 2, nullptr, pins_let_go},
    {"", "mass_kept", "border weighs as inside", 2, nullptr, border_weighs_as_inside},
    {"", "cut_pieces", "never cut", to_the_end, never_cut},
    {"balloon", "stretch", "springs a thousand times too soft", 60, springs_a_thousand_times_too_soft},
    {"balloon", "supported", "never sewn", to_the_end, never_sewn},
    {"balls_in_net", "pins_follow", "key-framed pins stay", 20, pins_stay},
    {"balls_in_net", "penetration", "no collision", 50, no_collision},
    {"balls_in_net", "stretch", "springs a thousand times too soft", 60, springs_a_thousand_times_too_soft},
    {"balls_in_net", "body_flies", "gravity 1 % too strong", 20, gravity_one_percent_off},
    {"balls_in_net", "bodies_apart", "bodies pass through each other", 60, nullptr, bodies_pass_through_each_other},
    {"capsules", "falls", "gravity 1 % too strong", 5, gravity_one_percent_off},
    {"capsules", "penetration", "capsules forgotten", 18, forgotten<Capsule>},
    {"capsules", "stretch", "springs a thousand times too soft", 20, springs_a_thousand_times_too_soft},
    {"capsules", "uncrossed", "no self-collision", 40, no_self_collision},
    {"chair", "falls", "gravity 1 % too strong", 8, gravity_one_percent_off},
    {"chair", "penetration", "meshes forgotten", 24, forgotten<Mesh>},
    {"chair", "stretch", "springs a thousand times too soft", 40, springs_a_thousand_times_too_soft},
    {"chair", "uncrossed", "no self-collision", 40, no_self_collision},
    {"cloth_on_sphere", "falls", "gravity 1 % too strong", 10, gravity_one_percent_off},
    {"cloth_on_sphere", "penetration", "no collision", 30, no_collision},
    {"cloth_on_sphere", "supported", "no thickness", 30, no_thickness},
    {"cloth_on_sphere", "stretch", "springs a thousand times too soft", 60, springs_a_thousand_times_too_soft},
    {"cloth_on_sphere", "uncrossed", "no self-collision", 30, no_self_collision},
    {"curtain", "pins_follow", "key-framed pins stay", 60, pins_stay},
    {"curtain", "drawn", "key-framed pins stay", 60, pins_stay},
    {"curtain", "stretch", "springs a thousand times too soft", 30, springs_a_thousand_times_too_soft},
    {"curtain", "uncrossed", "no self-collision", 140, no_self_collision},
    {"cushion", "penetration", "no collision", 70, no_collision},
    {"cushion", "stretch", "springs a thousand times too soft", 60, springs_a_thousand_times_too_soft},
    {"cushion", "supported", "never sewn", to_the_end, never_sewn},
    {"cut_flag", "uncrossed", "no self-collision", 42, no_self_collision},
    {"cut_in_two", "uncrossed", "no self-collision", 80, no_self_collision},
    {"flag", "torque", "no lift", 60, no_lift},
    {"flag", "blown", "no wind", 180, no_wind},
    {"flag", "stretch", "springs a thousand times too soft", 30, springs_a_thousand_times_too_soft},
    {"flag", "uncrossed", "no self-collision", 40, no_self_collision},
    {"folded", "penetration", "no collision", 14, no_collision},
    {"folded", "uncrossed", "no self-collision", 20, no_self_collision},
    {"four_colliders", "falls", "gravity 1 % too strong", 4, gravity_one_percent_off},
    {"four_colliders", "penetration", "ellipsoids forgotten", 24, forgotten<Ellipsoid>},
    {"four_colliders", "supported", "moving colliders stay", 120, colliders_still},
    {"four_colliders", "stretch", "springs a thousand times too soft", 28, springs_a_thousand_times_too_soft},
    {"four_colliders", "uncrossed", "no self-collision", 40, no_self_collision},
    {"hanging_sheet", "stretch_law", "no shear springs", 110, no_shear_springs},
    {"ribbons", "uncrossed", "no self-collision", 60, no_self_collision},
    {"rotating_sphere", "penetration", "no collision", 14, no_collision},
    {"rotating_sphere", "carried", "no friction", 110, no_friction},
    {"rotating_sphere", "uncrossed", "no self-collision", 30, no_self_collision},
    {"round_tablecloth", "falls", "gravity 1 % too strong", 5, gravity_one_percent_off},
    {"round_tablecloth", "penetration", "meshes forgotten", 20, forgotten<Mesh>},
    {"round_tablecloth", "stretch", "springs a thousand times too soft", 40, springs_a_thousand_times_too_soft},
    {"round_tablecloth", "uncrossed", "no self-collision", 40, no_self_collision},
    {"skirt", "pins_follow", "key-framed pins stay", 80, pins_stay},
    {"skirt", "penetration", "no collision", 60, no_collision},
    {"skirt", "stretch", "springs a thousand times too soft", 60, springs_a_thousand_times_too_soft},
    {"skirt", "uncrossed", "no self-collision", 90, no_self_collision},
    {"stack", "penetration", "no collision", 16, no_collision},
    {"stack", "uncrossed", "no self-collision", 30, no_self_collision},
    {"swinging_blade", "uncrossed", "no self-collision", to_the_end, no_self_collision},
    {"t_shirt", "penetration", "no collision", 60, no_collision},
    {"t_shirt", "stretch", "springs a thousand times too soft", 100, springs_a_thousand_times_too_soft},
    {"t_shirt", "supported", "never sewn", to_the_end, never_sewn},
    {"t_shirt", "uncrossed", "no self-collision", 90, no_self_collision},
    {"torn_banner", "uncrossed", "no self-collision", to_the_end, no_self_collision},
    {"trampoline", "penetration", "no collision", 50, no_collision},
    {"trampoline", "stretch", "springs a thousand times too soft", 50, springs_a_thousand_times_too_soft},
    {"trampoline", "body_flies", "gravity 1 % too strong", 24, gravity_one_percent_off},
    {"trampoline", "rebounds", "bodies feel no cloth", 70, bodies_feel_no_cloth},
    {"twist", "pins_follow", "key-framed pins stay", 20, pins_stay},
    {"twist", "uncrossed", "no self-collision", 60, no_self_collision},
    {"two_cloths", "falls", "gravity 1 % too strong", 4, gravity_one_percent_off},
    {"two_cloths", "penetration", "boxes forgotten", 22, forgotten<Box>},
    {"two_cloths", "supported", "no thickness", 22, no_thickness},
    {"two_cloths", "released", "never released", 70, never_released},
    {"two_cloths", "uncrossed", "no self-collision", 60, no_self_collision},
    {"two_cloths", "stretch", "springs a thousand times too soft", 8, springs_a_thousand_times_too_soft},
    {"two_corner_drape", "swing", "no damping", 30, no_damping},
    {"two_corner_drape", "mirror", "one side weighs half", 14, nullptr, one_side_weighs_half},
    {"two_corner_drape", "stretch", "springs a thousand times too soft", 14, springs_a_thousand_times_too_soft},
    {"weighted_sheet", "borne", "no loads", to_the_end, no_loads},
    {"weighted_sheet", "stretch", "springs a thousand times too soft", 30, springs_a_thousand_times_too_soft},
};

}  // namespace

const std::vector<SceneBreak>& scene_breaks() { return breaks; }

}  // namespace drape::test
