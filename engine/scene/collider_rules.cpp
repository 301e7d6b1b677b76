#include <fmt/format.h>

#include "drape/error.h"
#include "mesh/distance_field.h"
#include "mesh/mesh_shape.h"
#include "scene/scene_rules.h"
#include "world/field_plan.h"
#include "world/triangle_crossings.h"

namespace drape {

namespace {

/// Warns of a body whose surface crosses itself. A shell may: what is near it is near it.
void warn_of_crossings(const SceneNode& file, const MeshShape& shape) {
    if (shape.shell() > 0) return;
    TriangleCrossings::Mesh surface{shape.vertices(), {}};
    for (const Triangle& triangle : shape.triangles())
        surface.indices.insert(surface.indices.end(), triangle.begin(), triangle.end());
    const std::size_t pairs = TriangleCrossings({surface}).count();
    if (pairs > 0)
        file.warn(fmt::format(
            "the surface crosses itself ({} pairs of triangles): parts that overlap are one body; a surface whose "
            "parts were united has none",
            pairs));
}

}  // namespace

bool check_capsule(const Members& members, Collider&) {
    if (!members["radius"] || !members["radii"]) return true;
    return members.object().fail("expected radius or radii, got both");
}

bool check_mesh(const Members& members, Collider& collider) {
    Mesh& mesh = std::get<Mesh>(collider.shape);
    const SceneNode frames = members["frames"];
    const Mesh still;
    const auto says = [&](const char* key, bool differs) {
        return !frames && differs && !members[key].fail("expected frames too, got none");
    };
    if (says("frames_per_second", mesh.frames_per_second != still.frames_per_second) ||
        says("frames_start", mesh.frames_start != still.frames_start) || says("loop", mesh.loop != still.loop))
        return false;
    if (members["shell"] && members["solid"]) return members.object().fail("expected shell or solid, got both");
    if (!members.fit({"file", "scale", "shell", "solid", "frames", "frames_per_second", "frames_start", "loop"}))
        return false;
    mesh.file = members["file"].file(mesh.file).string();
    if (frames) mesh.frames = frames.file(mesh.frames).string();
    try {
        read_file(mesh);
    } catch (const Error& error) {
        return (frames ? frames : members["file"]).fail(error.what());
    }
    if (const std::string mended = mesh.shape->mending().text(); !mended.empty())
        members["file"].warn(fmt::format("the mesh was mended to be a body: {}", mended));
    warn_of_crossings(members["file"], *mesh.shape);
    return true;
}

bool check_fields(const SceneNode& colliders, const SceneDescription& scene) {
    std::size_t points = 0, place = 0;
    for (const Collider& collider : scene.colliders) {
        if (!special(collider.shape).mesh) continue;
        const FieldPlan plan = field_plan(scene, collider);
        points += plan.texels;
        const SceneNode mesh = colliders.member("meshes").element(place++);
        if (points <= most_field_points) continue;
        const SceneNode spacing = mesh.member("spacing");
        return (spacing ? spacing : mesh)
            .fail(
                fmt::format("expected distances to all meshes at no more than {} points, got {} up to this one, which "
                            "has a spacing of {:.3g} m{}",
                            most_field_points, points, plan.spacing,
                            collider.deforms() ? ", where one that deforms counts three times" : ""));
    }
    return true;
}

}  // namespace drape
