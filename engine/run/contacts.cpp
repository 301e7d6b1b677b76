#include "run/contacts.h"

#include <algorithm>

#include "cloth/frame_inputs.h"
#include "world/contact_shape.h"
#include "world/surface_distance.h"

namespace drape {

namespace glsl {
#include "include/colliders.h"
}  // namespace glsl

namespace {

/// Returns a particle's distance, m, to the shape that contact keeps it out of. For a mesh the triangles give it,
/// without a field.
float distance_to(const Collider& kept, const glsl::ColliderRecord& record, const glsl::vec3& world,
                  const glsl::vec3& local) {
    if (const Mesh* mesh = special(kept.shape).mesh)
        return static_cast<float>(exact::shape_distance(*mesh, {local.x, local.y, local.z}));
    return glsl::collider_surface(kept.kind(), record, world, local, nullptr).distance;
}

}  // namespace

std::vector<std::int16_t> touched_colliders(const Cloth& shape, const std::vector<Collider>& colliders, double time,
                                            std::span<const float> xyzw) {
    const double edge = least_spacing(shape);
    const auto reach = static_cast<float>(shape.thickness + contact_reach * edge);
    std::vector<std::int16_t> touched(xyzw.size() / 4, -1);
    std::vector<float> nearest(touched.size(), reach);
    if (has_skin(shape))
        for (std::size_t particle = 0; particle < nearest.size(); ++particle)
            nearest[particle] =
                static_cast<float>(shape.thickness * double{thickness_factor(shape, particle)} + contact_reach * edge);
    for (std::size_t number = 0; number < colliders.size(); ++number) {
        const int kind = colliders[number].kind();
        const Collider kept = formed(contact_shape(shape, colliders[number]), time);
        const glsl::ColliderRecord record = collider_record(kept, time, time);
        for (std::size_t particle = 0; particle < touched.size(); ++particle) {
            if (xyzw[4 * particle + 3] == 0) continue;
            const glsl::vec3 world{xyzw[4 * particle], xyzw[4 * particle + 1], xyzw[4 * particle + 2]};
            const glsl::vec3 local = glsl::local_point(record, world);
            // A test of bounds spares the costly distances. A plane's distance costs no more than the test.
            if (!special(kept.shape).plane && glsl::beyond_reach(kind, record, world, reach)) continue;
            const float distance = distance_to(kept, record, world, local);
            if (distance > nearest[particle]) continue;
            nearest[particle] = distance;
            touched[particle] = static_cast<std::int16_t>(number);
        }
    }
    return touched;
}

}  // namespace drape
