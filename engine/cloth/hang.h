#pragma once

#include "drape/scene.h"

namespace drape {

/// How a cloth hangs, on which the laws of the methods' stretch errors depend.
struct Hang {
    double length;        ///< m below the pins
    double spacing;       ///< m, of the finer links
    double gravity;       ///< m/s^2
    double acceleration;  ///< m/s^2, gravity and the wind's share
    bool by_an_edge;      ///< a held edge carries it, and no collider is in its way
    double edge_spacing;  ///< m, of the links that lead away from that edge
    bool by_lone_pins;    ///< lone held particles carry it, and no collider is in its way
    bool calm;            ///< it hangs by an edge, no wind blows and gravity stays constant
    std::size_t particle_count;
};

/// Returns the largest acceleration, m/s^2, by all weather: gravity, loads, and the wind's pressure on a
/// plate that faces it.
double most_weather_acceleration(const SceneDescription& scene, const Cloth& cloth);

/// Returns the acceleration, m/s^2, by which the weather of a time (s) stretches a cloth.
double weather_acceleration(const SceneDescription& scene, const Cloth& cloth, double time);

Hang hang_of(const SceneDescription& scene, const Cloth& cloth);

/// The factor by which the worst frame of a moving cloth errs more than a hanging one.
double motion_factor(const Hang& hang);

}  // namespace drape
