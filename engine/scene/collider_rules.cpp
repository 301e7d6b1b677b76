#include <fmt/format.h>

#include "drape/error.h"
#include "mesh/distance_field.h"
#include "scene/field_plan.h"
#include "scene/scene_rules.h"

namespace drape {

bool check_capsule(const Members& members, Collider&) {
    if (!members["radius"] || !members["radii"]) return true;
    return members.object().fail("expected radius or radii, got both");
}

bool check_mesh(const Members& members, Collider& collider) {
    if (!members.fit({"file", "scale", "shell"})) return false;
    Mesh& mesh = std::get<Mesh>(collider.shape);
    mesh.file = members["file"].file(mesh.file).string();
    try {
        read_file(mesh);
    } catch (const Error& error) {
        return members["file"].fail(error.what());
    }
    return true;
}

bool check_fields(const SceneNode& colliders, const SceneDescription& scene) {
    std::size_t points = 0, place = 0;
    for (const Collider& collider : scene.colliders) {
        if (!std::holds_alternative<Mesh>(collider.shape)) continue;
        const FieldPlan plan = field_plan(scene, collider);
        points += plan.points;
        const SceneNode mesh = colliders.member("meshes").element(place++);
        if (points <= most_field_points) continue;
        const SceneNode spacing = mesh.member("spacing");
        return (spacing ? spacing : mesh)
            .fail(
                fmt::format("expected distances to all meshes at no more than {} points, got {} up to this one, which "
                            "has a spacing of {:.3g} m",
                            most_field_points, points, plan.spacing));
    }
    return true;
}

}  // namespace drape
