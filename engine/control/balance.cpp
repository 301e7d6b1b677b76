#include "control/balance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/vectors.h"
#include "world/collider_pose.h"
#include "world/weather.h"

namespace drape {

namespace {

constexpr double slight = 1e-6;  ///< relative to lengths
/// A strip of rigidity B (N m) and weight w (N/m^2) that is clamped at its foot stands up to the height (greenhill
/// B/w)^(1/3) (Greenhill 1881).
constexpr double greenhill = 7.837;

Vec3 place_of(const ClothModel& cloth, std::size_t particle) {
    const glsl::vec4& at = cloth.position[particle];
    return {at.x, at.y, at.z};
}

/// Returns the unit normal of a cloth that starts flat.
std::optional<Vec3> normal_of(const ClothModel& cloth) {
    if (cloth.is_given) return std::nullopt;
    const Vec3 normal = unit_of(cross(cloth.placement.u, cloth.placement.v));
    const double first = dot(place_of(cloth, 0), normal);
    for (std::size_t k = 0; k < cloth.position.size(); ++k)
        if (std::abs(dot(place_of(cloth, k), normal) - first) > slight * cloth.reach()) return std::nullopt;
    return normal;
}

/// Returns whether pins move against each other, or against what is held.
bool pins_may_meet(const ClothModel& cloth) {
    const auto moves = [](const DynamicPin& pin) { return pin.path.moves(); };
    const auto moving = std::ranges::count_if(cloth.dynamic_pins, moves);
    const auto held = std::ranges::count_if(cloth.position, [](const glsl::vec4& at) { return !(at.w > 0); });
    return moving > 1 || (moving == 1 && held > static_cast<std::ptrdiff_t>(cloth.pinned.size()));
}

/// Returns how far cloth reaches above all that is held, m; infinite where nothing is.
double height_above_held(const ClothModel& cloth, const Vec3& gravity) {
    double highest_held = -std::numeric_limits<double>::infinity(), highest = highest_held;
    for (std::size_t k = 0; k < cloth.position.size(); ++k) {
        const double height = -dot(place_of(cloth, k), gravity) / length(gravity);
        double& most = cloth.position[k].w > 0 ? highest : highest_held;
        most = std::max(most, height);
    }
    return highest - highest_held;
}

/// Returns whether cloth in a plane that gravity does not leave may be pushed together: some of it is above all that is
/// held, or stands on a collider, its pins move, or it starts shorter than it is.
bool is_pushed(const SimulationModel& model, const ClothModel& cloth, const Vec3& gravity) {
    if (std::ranges::min(cloth.placement.scale) < 1 || pins_may_meet(cloth)) return true;
    if (length(gravity) == 0) return false;
    const double height = height_above_held(cloth, gravity);
    return std::isinf(height) ? !model.scene.colliders.empty() : height > slight * cloth.reach();
}

/// Returns whether gravity lies in the plane with this normal.
bool is_upright(const Vec3& normal, const Vec3& gravity) {
    return std::abs(dot(gravity, normal)) <= slight * length(gravity);
}

/// Returns whether level cloth that nothing holds is above the middle of a collider.
bool falls_on_a_middle(const SimulationModel& model, const ClothModel& cloth, const Vec3& gravity) {
    constexpr double near = 0.1;
    if (std::ranges::any_of(cloth.position, [](const glsl::vec4& at) { return !(at.w > 0); })) return false;
    Vec3 sum{};
    for (std::size_t k = 0; k < cloth.position.size(); ++k) sum = plus(sum, place_of(cloth, k));
    const Vec3 middle = times(1.0 / static_cast<double>(cloth.position.size()), sum);
    return std::ranges::any_of(model.scene.colliders, [&](const Collider& collider) {
        if (std::holds_alternative<Plane>(collider.shape)) return false;
        const Vec3 way = minus(collider_pose(collider, 0).center, middle);
        return length(cross(way, gravity)) < near * cloth.reach() * length(gravity);
    });
}

}  // namespace

bool starts_in_balance(const SimulationModel& model) {
    if (model.windy) return false;
    const Vec3 gravity = gravity_at(model.scene, 0);
    return std::ranges::any_of(model.cloths, [&](const ClothModel& cloth) {
        const std::optional<Vec3> normal = normal_of(cloth);
        if (!normal) return false;
        if (is_upright(*normal, gravity)) return is_pushed(model, cloth, gravity);
        return length(cross(gravity, *normal)) <= slight * length(gravity) && falls_on_a_middle(model, cloth, gravity);
    });
}

std::optional<Vec3> stands_upright(const SimulationModel& model, std::size_t index) {
    const ClothModel& cloth = model.cloths[index];
    const Vec3 gravity = gravity_at(model.scene, 0);
    if (model.windy || length(gravity) == 0) return std::nullopt;
    const std::optional<Vec3> normal = normal_of(cloth);
    if (!normal || !is_upright(*normal, gravity)) return std::nullopt;
    const Cloth& described = model.scene.cloths[index];
    const double weight = described.areal_density * length(gravity);
    const double stands = std::cbrt(greenhill * described.stiffness.bend.largest() / weight);
    const double height = height_above_held(cloth, gravity);
    const bool falls = std::isinf(height) ? !model.scene.colliders.empty() : height > stands;
    return falls ? normal : std::nullopt;
}

}  // namespace drape
