#include "cloth/hang.h"

#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "cloth/loads.h"
#include "world/gust.h"
#include "world/weather.h"

namespace drape {

namespace {

/// This share of the wind's pressure on a plate stretches a cloth, measured on the flag scene; the rest is lost because
/// cloth turns with the wind.
constexpr double wind_share = 0.3;

/// Returns the largest straight distance, m, of a particle from the nearest pin on the flat cloth, by sampling; without
/// pins, half the cloth's size.
double hanging_length(const Cloth& cloth) {
    const auto [dx, dy] = grid_spacing(cloth);
    if (cloth.pins.empty()) return 0.5 * std::max(cloth.size[0], cloth.size[1]);
    constexpr std::uint32_t samples = 33;
    double longest = 0;
    for (std::uint32_t j = 0; j < samples; ++j)
        for (std::uint32_t i = 0; i < samples; ++i) {
            const double x = i * (cloth.grid[0] - 1.0) / (samples - 1), y = j * (cloth.grid[1] - 1.0) / (samples - 1);
            double nearest = INFINITY;
            for (const Pin& pin : cloth.pins) {
                const auto outside = [](double at, double first, double last) {
                    return std::max({first - at, at - last, 0.0});
                };
                const IndexBox& box = pin.particles;
                nearest = std::min(nearest, std::hypot(dx * outside(x, box.first[0], box.last[0]),
                                                       dy * outside(y, box.first[1], box.last[1])));
            }
            longest = std::max(longest, nearest);
        }
    return longest;
}

/// Returns the axis (0: rows, 1: columns) of the links that lead away from a whole edge that is held for good; -1: no
/// edge is.
int axis_from_held_edge(const Cloth& cloth) {
    for (const Pin& pin : cloth.pins) {
        const IndexBox& box = pin.particles;
        if (!pin.path.keys.empty() || pin.release) continue;
        if (box.first[0] == 0 && box.last[0] + 1 == cloth.grid[0]) return 1;
        if (box.first[1] == 0 && box.last[1] + 1 == cloth.grid[1]) return 0;
    }
    return -1;
}

/// Returns whether every pin holds one particle, and no two are neighbours.
bool held_by_lone_pins(const Cloth& cloth) {
    const auto apart = [](const Pin& a, const Pin& b) {
        for (std::size_t k = 0; k < 2; ++k) {
            const double distance = static_cast<double>(a.particles.first[k]) - b.particles.first[k];
            if (std::abs(distance) > 1) return true;
        }
        return false;
    };
    for (std::size_t i = 0; i < cloth.pins.size(); ++i) {
        if (cloth.pins[i].particles.first != cloth.pins[i].particles.last) return false;
        for (std::size_t k = 0; k < i; ++k)
            if (!apart(cloth.pins[i], cloth.pins[k])) return false;
    }
    return !cloth.pins.empty();
}

/// Returns the acceleration, m/s^2, by wind of a speed (m/s): its pressure on a plate that faces it.
double most_wind_acceleration(const SceneDescription& scene, const Cloth& cloth, double speed) {
    if (!scene.wind.blows()) return 0;
    const double pressure = 0.5 * scene.wind.air_density * std::max(scene.wind.drag, scene.wind.lift) * (speed * speed);
    return pressure / cloth.areal_density;
}

/// Returns the share of this acceleration that stretches a cloth.
double wind_acceleration(const SceneDescription& scene, const Cloth& cloth, double speed) {
    return wind_share * most_wind_acceleration(scene, cloth, speed);
}

}  // namespace

double most_weather_acceleration(const SceneDescription& scene, const Cloth& cloth) {
    // What pulls at a corner strains the springs there as four times its share of the cloth's weight would.
    return length(strongest_gravity(scene)) + most_wind_acceleration(scene, cloth, fastest_wind(scene.wind)) +
           4 * most_load_acceleration(cloth);
}

double weather_acceleration(const SceneDescription& scene, const Cloth& cloth, double time) {
    return length(gravity_at(scene, time)) + wind_acceleration(scene, cloth, length(wind_velocity(scene.wind, time))) +
           load_acceleration(cloth, time);
}

Hang hang_of(const SceneDescription& scene, const Cloth& cloth) {
    Hang hang{};
    hang.length = hanging_length(cloth);
    hang.spacing = least_spacing(cloth);
    const Vec3 gravity = strongest_gravity(scene);
    hang.gravity = std::hypot(gravity[0], gravity[1], gravity[2]);
    hang.acceleration =
        hang.gravity + wind_acceleration(scene, cloth, fastest_wind(scene.wind)) + most_load_acceleration(cloth);
    const int axis = axis_from_held_edge(cloth);
    hang.by_an_edge = axis >= 0 && scene.colliders.empty() && !scene.comes_apart();
    hang.by_lone_pins = held_by_lone_pins(cloth) && scene.colliders.empty() && !scene.comes_apart();
    hang.edge_spacing = grid_spacing(cloth)[axis == 0 ? 0 : 1];
    hang.calm = hang.by_an_edge && !has_weather(scene);
    hang.particle_count = std::size_t{cloth.grid[0]} * cloth.grid[1];
    return hang;
}

double motion_factor(const Hang& hang) { return hang.calm ? 1.7 : 5; }

}  // namespace drape
