#include "world/field_plan.h"

#include <algorithm>
#include <limits>

#include "mesh/distance_field.h"
#include "shared/collider_types.h"
#include "world/contact_shape.h"

namespace drape {

namespace {

/// Returns half of the least distance between particles of the scene's cloths, m.
double half_cell(const SceneDescription& scene) {
    double least = std::numeric_limits<double>::infinity();
    for (const Cloth& cloth : scene.cloths) least = std::min(least, 0.5 * least_spacing(cloth));
    return least;
}

/// A margin for cells larger than the mesh would only waste the room of its samples.
double margin_of(const SceneDescription& scene, const Collider& collider) {
    const Vec3& half_extents = std::get<Mesh>(collider.shape).shape->half_extents();
    double margin = 0;
    for (const Cloth& cloth : scene.cloths) {
        margin = std::max(margin, cloth.thickness + std::get<Mesh>(contact_shape(cloth, collider).shape).grown);
        if (meets_edges(cloth, {collider}))
            margin = std::max(margin, std::min(edge_reach(cloth), *std::ranges::max_element(half_extents)));
    }
    return margin;
}

/// Returns the largest number of points for a mesh that asks for no spacing.
std::size_t most_points(const SceneDescription& scene, const Collider& collider) {
    const auto is_mesh = [](const Collider& each) { return special(each.shape).mesh != nullptr; };
    const auto count = static_cast<std::size_t>(std::ranges::count_if(scene.colliders, is_mesh));
    const std::size_t share = most_field_points / std::max<std::size_t>(count, 1);
    return collider.deforms() ? std::min(usual_moving_points, share / glsl::moving_point_texels)
                              : std::min(usual_field_points, share);
}

}  // namespace

FieldPlan field_plan(const SceneDescription& scene, const Collider& collider) {
    const Mesh& mesh = std::get<Mesh>(collider.shape);
    FieldPlan plan{mesh.spacing.value_or(half_cell(scene)), 0, margin_of(scene, collider), 0, 0};
    if (mesh.shell && !mesh.spacing) plan.wanted = std::min(plan.wanted, 0.5 * *mesh.shell);
    plan.spacing =
        mesh.spacing ? plan.wanted : field_spacing(*mesh.shape, plan.wanted, plan.margin, most_points(scene, collider));
    plan.points = field_points(*mesh.shape, plan.spacing, plan.margin);
    plan.texels = collider.deforms() ? plan.points * glsl::moving_point_texels : plan.points;
    return plan;
}

}  // namespace drape
