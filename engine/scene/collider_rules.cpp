#include <fmt/format.h>

#include <algorithm>

#include "drape/error.h"
#include "mesh/distance_field.h"
#include "mesh/mesh_shape.h"
#include "scene/scene_rules.h"
#include "world/body_faults.h"
#include "world/field_plan.h"
#include "world/mass_properties.h"
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

bool check_body(const Members& members, Collider& collider) {
    if (members["mass"] && members["path"])
        return members["path"].fail("expected no path beside a mass, with which gravity and cloth move the collider");
    const auto alone = [&](const char* key, bool says) {
        return says && !members["mass"] && !members[key].fail("expected a mass too, got none");
    };
    if (alone("inertia", collider.inertia.has_value()) || alone("velocity", collider.velocity != Vec3{}) ||
        alone("angular_velocity", collider.angular_velocity != Vec3{}))
        return false;
    if (!collider.inertia || !members.fit({"inertia"})) return true;
    const auto& [x, y, z] = *collider.inertia;
    return (x <= y + z && y <= z + x && z <= x + y) ||
           members["inertia"].fail("expected moments none of which exceeds the sum of the others");
}

bool check_capsule(const Members& members, Collider& collider) {
    if (members["radius"] && members["radii"]) return members.object().fail("expected radius or radii, got both");
    return check_body(members, collider);
}

namespace {

/// Returns where the scene file has a collider, and its mass.
SceneNode mass_of(const SceneNode& colliders, const SceneDescription& scene, std::size_t number) {
    const std::size_t kind = scene.colliders[number].shape.index();
    std::size_t place = 0;
    for (std::size_t k = 0; k < number; ++k) place += scene.colliders[k].shape.index() == kind ? 1 : 0;
    return colliders.member(std::string(collider_lists[kind])).element(place).member("mass");
}

}  // namespace

bool check_bodies(const Members& members, const SceneDescription& scene) {
    if (const std::optional<BodyFault> fault = body_fault(scene))
        return mass_of(members["colliders"], scene, fault->collider).fail("expected " + fault->expected);
    for (std::size_t k = 0; k < scene.colliders.size(); ++k) {
        const Collider& body = scene.colliders[k];
        if (!body.mass) continue;
        const SceneNode mass = mass_of(members["colliders"], scene, k);
        const double least = least_mass_ratio * covering_mass(scene, body.shape);
        if (*body.mass < least)
            return mass.fail(fmt::format(
                "expected at least {:.3g} kg, {} times what the heaviest cloth weighs that covers the body, got {:.3g}",
                least, least_mass_ratio, *body.mass));
    }
    return true;
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
    return check_body(members, collider);
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
