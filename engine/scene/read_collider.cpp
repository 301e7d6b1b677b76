#include "scene/scene_sections.h"

namespace drape {
namespace {

// A limit far above what the kernels are built for, so that a mistake is an error and not an hour of waiting.
constexpr std::size_t collider_limit = 1024;

void read_common(const SceneNode& node, ColliderCommon& common) {
    node.member("friction").read(common.friction, not_negative);
    node.member("rotate").read(common.rotate);
    node.member("color").read_color(common.color);
    read_path(node.member("path"), common.path);
}

template <typename Collider, typename ReadShape>
void read_list(const SceneNode& node, ObjectKind kind, std::vector<Collider>& colliders, ReadShape read_shape) {
    if (!node.open_array("an array of at most 1024 colliders", 0, collider_limit)) return;
    colliders.assign(node.value()->size(), {});
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        SceneNode element = node.element(i);
        if (!element.open_object(kind)) continue;
        read_common(element, colliders[i]);
        read_shape(element, colliders[i]);
    }
}

}  // namespace

void read_colliders(SceneNode node, Colliders& colliders) {
    if (!node.open_object(ObjectKind::colliders)) return;
    read_list(node.member("planes"), ObjectKind::plane, colliders.planes,
              [](const SceneNode& plane, PlaneCollider& field) {
                  plane.member("normal").read_direction(field.normal);
                  plane.member("offset").read(field.offset, any_number);
              });
    read_list(node.member("spheres"), ObjectKind::sphere, colliders.spheres,
              [](const SceneNode& sphere, SphereCollider& field) {
                  sphere.member("center").read(field.center);
                  sphere.member("radius").read(field.radius, positive);
              });
    read_list(node.member("boxes"), ObjectKind::box, colliders.boxes, [](const SceneNode& box, BoxCollider& field) {
        box.member("center").read(field.center);
        box.member("half_extents").read(field.half_extents, positive);
    });
    read_list(node.member("ellipsoids"), ObjectKind::ellipsoid, colliders.ellipsoids,
              [](const SceneNode& ellipsoid, EllipsoidCollider& field) {
                  ellipsoid.member("center").read(field.center);
                  ellipsoid.member("radii").read(field.radii, positive);
              });
}

}  // namespace drape
