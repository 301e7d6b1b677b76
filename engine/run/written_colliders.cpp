#include "run/written_colliders.h"

#include <fmt/format.h>

#include <cmath>

#include "mesh/mesh_shape.h"
#include "picture/collider_surface.h"
#include "world/body_pose.h"
#include "world/collider_pose.h"

namespace drape {

namespace {

constexpr int round_segments = 48, obstacle_segments = 24;

Placement3x4 placement_at(const Collider& collider, double time) {
    const ColliderPose pose = surface_pose(collider, time);
    Placement3x4 rows;
    for (std::size_t row = 0; row < 3; ++row)
        rows[row] = {pose.rotation[3 * row], pose.rotation[3 * row + 1], pose.rotation[3 * row + 2], pose.center[row]};
    return rows;
}

std::vector<Vec3> form_at(const Collider& collider, double time) {
    return std::get<Mesh>(formed(collider, time).shape).shape->vertices();
}

/// Returns where a body that cloth moves is in the frame nearest to a time.
Placement3x4 placement_of_body(const Collider& body, std::size_t number, const BodyTracks& tracks,
                               std::uint32_t frame) {
    const auto found = tracks.find(frame);
    if (found != tracks.end())
        for (const BodyState& each : found->second)
            if (each.collider == number) return placement_at(placed(body, each), 0);
    return placement_at(body, 0);
}

std::vector<WrittenCollider> colliders_of(const SceneDescription& scene, int segments,
                                          const std::shared_ptr<const BodyTracks>& bodies) {
    const PlaneSquare square = plane_square(scene);
    std::vector<WrittenCollider> written;
    for (const Collider& collider : scene.colliders) {
        ColliderSurface surface = collider_surface(collider, segments, square);
        const auto number = static_cast<std::int32_t>(written.size());
        WrittenCollider one{.name = fmt::format("collider_{}_{}", number, collider_names[collider.shape.index()]),
                            .number = number,
                            .vertices = std::move(surface.vertices),
                            .faces = {},
                            .flat = shape_geometry(collider.shape).has_flat_sides,
                            .moves = collider.moves(),
                            .color = collider.color,
                            .placement = [collider](double time) { return placement_at(collider, time); }};
        if (collider.mass && bodies)
            one.placement = [collider, bodies, number = written.size(), fps = scene.time.fps](double time) {
                return placement_of_body(collider, number, *bodies,
                                         static_cast<std::uint32_t>(std::lround(time * fps)));
            };
        if (collider.deforms()) one.form = [collider](double time) { return form_at(collider, time); };
        for (const auto& triangle : surface.triangles)
            one.faces.insert(one.faces.end(), triangle.begin(), triangle.end());
        written.push_back(std::move(one));
    }
    return written;
}

}  // namespace

std::vector<WrittenCollider> written_colliders(const SceneDescription& scene,
                                               const std::shared_ptr<const BodyTracks>& bodies) {
    return colliders_of(scene, round_segments, bodies);
}

std::vector<WrittenCollider> written_obstacles(const SceneDescription& scene,
                                               const std::shared_ptr<const BodyTracks>& bodies) {
    std::vector<WrittenCollider> obstacles = colliders_of(scene, obstacle_segments, bodies);
    for (WrittenCollider& obstacle : obstacles) obstacle = with_nodes(std::move(obstacle));
    return obstacles;
}

}  // namespace drape
