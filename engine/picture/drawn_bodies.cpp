#include "picture/drawn_bodies.h"

#include <algorithm>

#include "world/body_pose.h"

namespace drape {

DrawnBodies::DrawnBodies(const SceneDescription& scene, std::optional<std::size_t> left_out)
    : colliders_(scene.colliders),
      left_out_(left_out),
      fixtures_(fixtures(scene)),
      corners_(mesh_corners(scene.colliders, 0)),
      deform_(std::ranges::any_of(scene.colliders, &Collider::deforms)) {
    if (left_out_) colliders_.erase(colliders_.begin() + static_cast<std::ptrdiff_t>(*left_out_));
}

std::vector<Collider> DrawnBodies::at(double time, std::span<const BodyState> moved) const {
    std::vector<Collider> bodies = colliders_;
    for (const BodyState& body : moved) {
        Collider& drawn = bodies[body.collider - (left_out_ && *left_out_ < body.collider ? 1 : 0)];
        drawn = placed(drawn, body);
    }
    for (const Fixture& fixture : fixtures_) bodies.push_back(posed(fixture, time));
    return bodies;
}

std::vector<std::uint16_t> DrawnBodies::ids(std::size_t cloth_count) const {
    std::vector<std::uint16_t> ids;
    for (std::size_t i = 0; i < colliders_.size(); ++i) {
        const std::size_t number = i + (left_out_ && i >= *left_out_ ? 1 : 0);
        ids.push_back(static_cast<std::uint16_t>(std::min<std::size_t>(cloth_count + 1 + number, fixture_id - 1)));
    }
    ids.resize(count(), fixture_id);
    return ids;
}

RoundColumns DrawnBodies::columns(const FrameView& view, double end, std::uint32_t height) const {
    constexpr int moments = 64;
    RoundColumns columns{};
    for (int moment = 0; moment <= moments; ++moment)
        for (const double time = end * moment / moments; const Collider& body : at(time)) {
            std::uint32_t& most = columns[static_cast<std::size_t>(body.kind())];
            most = std::max(most, round_columns(radius_in_pixels(body, time, view.camera_at(time), height)));
        }
    return columns;
}

}  // namespace drape
