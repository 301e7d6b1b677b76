#include "control/impossible_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "control/impossible_pins.h"
#include "world/collider_pose.h"
#include "world/contact_shape.h"
#include "world/surface_distance.h"
#include "world/weather.h"

namespace drape {

namespace {

/// Wind that takes a cloth to its own speed within this share of a frame moves it in jerks that no loop of frames sees.
constexpr double least_wind_share = 0.05;

/// Returns the nearest point of the collider; a point inside is its own.
Vec3 projected(const Collider& collider, const ColliderPose& pose, const Vec3& point) {
    const double distance = exact::surface_distance(collider, pose, point);
    if (!(distance > 0)) return point;
    const double step = 1e-6 * std::max(1.0, distance);
    Vec3 normal{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Vec3 before = point, after = point;
        before[axis] -= step;
        after[axis] += step;
        normal[axis] = exact::surface_distance(collider, pose, after) - exact::surface_distance(collider, pose, before);
    }
    const double size = length(normal);
    Vec3 foot = point;
    for (std::size_t axis = 0; size > 0 && axis < 3; ++axis) foot[axis] -= distance * normal[axis] / size;
    return foot;
}

std::string name_of(const SimulationModel& model, std::size_t collider) {
    return fmt::format("collider {} (of {})", collider, collider_lists[model.scene.colliders[collider].shape.index()]);
}

/// Returns a sentence where two colliders leave the cloth less room than at the start, and less than it takes.
std::string pinched_between(const SimulationModel& model, const Cloth& cloth, std::size_t a, std::size_t b,
                            std::uint32_t frame) {
    const std::vector<Collider>& all = model.scene.colliders;
    const auto stays = [](const Collider& each) { return each.path.keys.empty() && !each.deforms(); };
    if (stays(all[a]) && stays(all[b])) return {};  // they are where they were at the start
    const double time = frame / model.scene.time.fps;
    const double room = room_between(all[a], all[b], time), at_start = room_between(all[a], all[b], 0);
    if (!(room < at_start)) return {};
    // Contact keeps a cloth's particles out of larger shapes, so that its triangles are outside the colliders.
    const double kept_out = room_between(contact_shape(cloth, all[a]), contact_shape(cloth, all[b]), 0);
    const double thickness = least_thickness(cloth), taken = at_start - kept_out + 2 * thickness;
    if (!(room < taken) || kept_out < 2 * thickness) return {};
    return fmt::format("{} and {} leave {:.3g} m between them, where cloth '{}' takes {:.3g}", name_of(model, a),
                       name_of(model, b), room, cloth.name, taken);
}

std::string pinched(const SimulationModel& model, std::uint32_t frame) {
    const std::size_t count = model.scene.colliders.size();
    for (const Cloth& cloth : model.scene.cloths)
        for (std::size_t a = 0; a < count; ++a)
            for (std::size_t b = 0; b < a; ++b)
                if (std::string text = pinched_between(model, cloth, b, a, frame); !text.empty()) return text;
    return {};
}

std::string blown_away(const SimulationModel& model) {
    const Wind& wind = model.scene.wind;
    const double speed = length(strongest_wind(wind)) + wind.gust.amplitude;
    if (!wind.blows() || !(wind.drag > 0)) return {};
    for (const Cloth& cloth : model.scene.cloths) {
        // Drag 1/2 rho Cd v^2 accelerates an areal density s to v within 2 s / (rho Cd v).
        const double seconds = 2 * cloth.areal_density / (wind.air_density * wind.drag * speed);
        if (!(seconds < least_wind_share / model.scene.time.fps)) continue;
        return fmt::format(
            "wind of {:.3g} m/s takes cloth '{}' of {:.3g} kg/m^2 to its own speed within {:.2g} ms, {:.2g} of a "
            "frame: a denser cloth, less wind or more frames a second would do",
            speed, cloth.name, cloth.areal_density, 1000 * seconds, seconds * model.scene.time.fps);
    }
    return {};
}

}  // namespace

double room_between(const Collider& one, const Collider& other, double time) {
    const Collider a = formed(one, time), b = formed(other, time);
    const ColliderPose pose_a = collider_pose(a, time), pose_b = collider_pose(b, time);
    Vec3 on_a = pose_a.center, on_b = pose_b.center;
    double room = 0;
    constexpr int most_rounds = 500;
    for (int round = 0; round < most_rounds; ++round) {
        on_a = projected(a, pose_a, on_b);
        on_b = projected(b, pose_b, on_a);
        const double now = length(minus(on_a, on_b));
        if (round > 0 && !(room - now > 1e-12 * room)) break;
        room = now;
    }
    return length(minus(on_a, on_b));
}

std::string impossible_scene(const SimulationModel& model, std::uint32_t frame) {
    if (std::string text = impossible_pins(model, frame); !text.empty()) return text;
    if (std::string text = pinched(model, frame); !text.empty()) return text;
    return blown_away(model);
}

}  // namespace drape
