// Warns of what a scene may have, but hardly means: pins that hold cloth where it cannot be, grids too coarse for
// edges, and values far beyond what cloth and pictures of it have.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vectors.h"
#include "scene/scene_rules.h"
#include "world/collider_pose.h"
#include "world/contact_shape.h"
#include "world/held.h"
#include "world/start.h"
#include "world/weather.h"

namespace drape {

namespace {

// Lengths are m. Sails and tents are smaller, tarpaulins and lead aprons lighter, tornadoes slower.
constexpr double large = 200, heavy = 50, fast = 150, far = 200;
constexpr double narrow = 1;  ///< degrees: a telescope's

using Corners = std::array<Vec3, 3>;

/// Values that are much too large are mostly in a smaller unit.
constexpr const char* metres = "scenes are in metres: divide millimetres by 1000, centimetres by 100";

void warn_of_held(const SceneNode& cloths, const SceneDescription& scene) {
    const auto pin = [&](std::size_t cloth, std::size_t index) {
        return cloths.element(cloth).member("pins").element(index);
    };
    for (const HeldDeep& held : held_in_colliders(scene))
        pin(held.cloth, held.pin)
            .warn(held_text(scene, held) +
                  ": what is held cannot give way, and the cloth beside it is pulled in; lead the pin around the "
                  "collider, release it before, or let the collider pass it");
    for (const PathJump& jump : path_jumps(scene))
        pin(jump.cloth, jump.pin)
            .member("path")
            .warn(fmt::format(
                "the path begins with a jump: at time 0 it has its particles up to {:.3g} m from where cloth \"{}\" "
                "starts, and they get there in the first substep; begin it with {{\"t\": 0}}, or place the cloth there",
                jump.distance, scene.cloths[jump.cloth].name));
}

/// Returns how far from each other two of a path's places are at most along an axis, m.
double span(const MotionPath& path) {
    double largest = 0;
    for (std::size_t k = 0; k < 3 && !path.keys.empty(); ++k) {
        const auto [low, high] =
            std::ranges::minmax(path.keys, {}, [k](const MotionKey& key) { return key.translate[k]; });
        largest = std::max(largest, high.translate[k] - low.translate[k]);
    }
    return largest;
}

void warn_of_far(const SceneNode& path, const MotionPath& motion) {
    if (const double way = span(motion); way > far)
        path.warn(fmt::format("the path leads {:.4g} m far: {}", way, metres));
}

void warn_of_cloth(const SceneNode& node, const Cloth& cloth) {
    const StartBox box = start_box(cloth);
    const double side = std::max({cloth.size[0] * std::abs(cloth.placement.scale[0]),
                                  cloth.size[1] * std::abs(cloth.placement.scale[1]),
                                  cloth.start.empty() ? 0.0 : length(minus(box.high, box.low))});
    if (side > large)
        node.member("size").warn(fmt::format("cloth \"{}\" is {:.4g} m long: {}", cloth.name, side, metres));
    if (cloth.areal_density > heavy)
        node.member("areal_density")
            .warn(fmt::format("a square metre of cloth \"{}\" weighs {:.4g} kg, and fabrics have .02 to 2 kg: divide "
                              "grams by 1000",
                              cloth.name, cloth.areal_density));
    if (const double speed = start_speed(cloth); speed > 10 * fast)
        node.member(cloth.velocities.empty() ? "velocity" : "velocities")
            .warn(fmt::format("cloth \"{}\" starts at {:.4g} m/s: {}", cloth.name, speed, metres));
    for (std::size_t pin = 0; pin < cloth.pins.size(); ++pin)
        warn_of_far(node.member("pins").element(pin).member("path"), cloth.pins[pin].path);
}

/// Returns how many particles start in a triangle, up to rounding.
std::size_t particles_in(const Corners& corners, const Cloth& cloth) {
    const Vec3 normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    const double rounding = 1e-5 * least_spacing(cloth);
    std::size_t count = 0;
    for (std::uint32_t row = 0; row < cloth.grid[1]; ++row)
        for (std::uint32_t column = 0; column < cloth.grid[0]; ++column) {
            const Vec3 at = start_place(cloth, column, row);
            if (std::abs(dot(normal, minus(at, corners[0]))) > rounding * length(normal)) continue;
            bool inside = true;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 side = minus(corners[(k + 1) % 3], corners[k]);
                inside = inside && dot(normal, cross(side, minus(at, corners[k]))) >= 0;
            }
            count += inside ? 1 : 0;
        }
    return count;
}

/// A blade in a column's plane separates the column from one side, and again wherever rounding moves its particles.
void warn_of_blades(const SceneNode& cutters, const SceneDescription& scene) {
    for (std::size_t i = 0; i < scene.cutters.size(); ++i)
        for (const Cloth& cloth : scene.cloths) {
            const Cutter& cutter = scene.cutters[i];
            if (!cutter.path.keys.empty() || start_jitter(cloth) > 0) continue;
            const std::size_t count = particles_in(cutter.triangle, cloth);
            if (count < 2) continue;
            cutters.element(i).warn(fmt::format(
                "{} particles of cloth \"{}\" start exactly in the cutter's plane: as they move to and fro through it, "
                "crumbs are cut off; move the cutter aside by a fraction of a cell",
                count, cloth.name));
            break;
        }
}

/// Cloth that is drawn over the edge of a box holds by the capstan's law if its particles are at most so many
/// thicknesses apart (tests/reference/edge_capstan_test.cpp); farther apart, by half to twice of it.
constexpr double widest_at_edge = 5;

/// Returns a box around where a cloth may come: it falls as far as pins let it, and stays beside itself if nothing
/// drives it.
StartBox reach_of(const Cloth& cloth, const SceneDescription& scene, bool driven) {
    const double size = std::hypot(cloth.size[0] * std::abs(cloth.placement.scale[0]),
                                   cloth.size[1] * std::abs(cloth.placement.scale[1]));
    const double aside = driven ? size : std::ranges::max(grid_spacing(cloth));
    StartBox box = start_box(cloth);
    const double fall = cloth.pins.empty() ? 1e6 : size;
    for (std::size_t k = 0; k < 3; ++k) {
        const double down = scene.gravity[k] == 0 ? 0 : std::copysign(fall, scene.gravity[k]);
        box.low[k] += std::min(down, 0.0) - aside;
        box.high[k] += std::max(down, 0.0) + aside;
    }
    return box;
}

bool holds(const StartBox& box, const Vec3& at) {
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) inside = inside && at[k] >= box.low[k] && at[k] <= box.high[k];
    return inside;
}

/// Returns whether an edge of a box that is at `pose` goes through `within`.
bool edge_within(const Vec3& half_extents, const ColliderPose& pose, const StartBox& within) {
    constexpr int points = 64;
    for (std::size_t along = 0; along < 3; ++along)
        for (unsigned corner = 0; corner < 4; ++corner)
            for (int point = 0; point <= points; ++point) {
                Vec3 local{};
                local[along] = half_extents[along] * (2.0 * point / points - 1);
                local[(along + 1) % 3] = half_extents[(along + 1) % 3] * ((corner & 1) == 0 ? -1 : 1);
                local[(along + 2) % 3] = half_extents[(along + 2) % 3] * ((corner & 2) == 0 ? -1 : 1);
                if (holds(within, plus(pose.center, rotate(pose.rotation, local)))) return true;
            }
    return false;
}

bool may_reach_edge(const Cloth& cloth, const Collider& collider, const SceneDescription& scene) {
    const auto* const box = std::get_if<Box>(&collider.shape);
    if (box == nullptr) return false;
    const bool pins_move = std::ranges::any_of(cloth.pins, [](const Pin& pin) { return !pin.path.keys.empty(); });
    const bool driven = pins_move || !collider.path.keys.empty() || start_speed(cloth) > 0 ||
                        !scene.gravity_keys.empty() || fastest_steady_wind(scene.wind) > 0;
    const StartBox within = reach_of(cloth, scene, driven);
    if (edge_within(box->half_extents, collider_pose(collider, 0), within)) return true;
    return std::ranges::any_of(collider.path.keys, [&](const MotionKey& key) {
        return edge_within(box->half_extents, collider_pose(collider, key.time), within);
    });
}

/// Particles far apart are caught by an edge, or slip over it.
void warn_of_edges(const SceneNode& cloths, const SceneDescription& scene) {
    for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
        const Cloth& cloth = scene.cloths[i];
        const double spacing = std::ranges::max(grid_spacing(cloth)), takes = widest_at_edge * least_thickness(cloth);
        const auto reaches = [&](const Collider& collider) { return may_reach_edge(cloth, collider, scene); };
        if (spacing <= takes || !std::ranges::any_of(scene.colliders, reaches)) continue;
        cloths.element(i).warn(fmt::format(
            "particles of cloth \"{}\" are {:.3g} m apart: over the edge of a box cloth slides as its friction says "
            "up to {:.3g} m, {} thicknesses; a finer grid, a larger thickness, or a capsule along the edge helps",
            cloth.name, spacing, takes, widest_at_edge));
    }
}

}  // namespace

void warn_of_doubts(const Members& members, const SceneDescription& scene) {
    if (members.fit({"cloths"}))
        for (std::size_t i = 0; i < scene.cloths.size(); ++i)
            warn_of_cloth(members["cloths"].element(i), scene.cloths[i]);
    if (members.fit({"colliders"})) {
        std::array<std::size_t, std::size(collider_lists)> places{};
        for (const Collider& collider : scene.colliders) {
            const std::size_t kind = collider.shape.index(), place = places[kind]++;
            warn_of_far(members["colliders"].member(collider_lists[kind]).element(place).member("path"), collider.path);
        }
    }
    const double wind = fastest_steady_wind(scene.wind);
    if (members.fit({"wind"}) && wind > fast)
        members["wind"]
            .member(scene.wind.keys.empty() ? "velocity" : "keys")
            .warn(fmt::format("a wind of {:.4g} m/s is faster than any storm's: divide km/h by 3.6", wind));
    if (members.fit({"camera"}) && scene.camera && scene.camera->fov < narrow)
        members["camera"].member("fov").warn(fmt::format(
            "a field of view of {:.3g} degrees shows next to nothing: angles are in degrees", scene.camera->fov));
    if (members.fit({"cloths", "cutters"})) warn_of_blades(members["cutters"], scene);
    if (members.fit({"cloths", "colliders", "wind"})) warn_of_edges(members["cloths"], scene);
    if (members.fit({"time", "cloths", "colliders", "solver"})) warn_of_held(members["cloths"], scene);
}

}  // namespace drape
