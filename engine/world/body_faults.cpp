#include "world/body_faults.h"

#include <fmt/format.h>

namespace drape {

namespace {

/// Returns whether the contact of bodies has these two shapes, of which one is a body.
bool can_meet(const ColliderShape& one, const ColliderShape& other) {
    const auto is_met_by_ellipsoids = ForEachKind{
        [](const Plane&) { return true; },      [](const Sphere&) { return true; },  [](const Box&) { return false; },
        [](const Ellipsoid&) { return false; }, [](const Capsule&) { return true; }, [](const Mesh&) { return false; }};
    const bool first = std::holds_alternative<Ellipsoid>(one), second = std::holds_alternative<Ellipsoid>(other);
    return (!first || std::visit(is_met_by_ellipsoids, other)) && (!second || std::visit(is_met_by_ellipsoids, one));
}

}  // namespace

std::optional<BodyFault> body_fault(const SceneDescription& scene) {
    std::size_t bodies = 0;
    for (std::size_t k = 0; k < scene.colliders.size(); ++k) {
        const Collider& body = scene.colliders[k];
        if (!body.mass) continue;
        if (const Mesh* const mesh = special(body.shape).mesh; mesh && (mesh->shell || mesh->sequence))
            return BodyFault{k, "no mass of a mesh that is a shell or deforms"};
        if (++bodies * scene.colliders.size() > most_body_pairs)
            return BodyFault{k, fmt::format("at most {} pairs of a body and a collider, a body counting once with each",
                                            most_body_pairs)};
        for (std::size_t other = 0; other < scene.colliders.size(); ++other)
            if (other != k && !can_meet(body.shape, scene.colliders[other].shape))
                return BodyFault{k,
                                 fmt::format("no {} beside a {}, which have no contact with each other where one has a "
                                             "mass: ellipsoids meet planes, spheres and capsules",
                                             collider_names[body.shape.index()],
                                             collider_names[scene.colliders[other].shape.index()])};
    }
    return std::nullopt;
}

}  // namespace drape
