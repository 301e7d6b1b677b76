#pragma once

#include "drape/scene.h"

namespace drape {

/// The laws of the methods' stretch errors depend on how a cloth hangs.
struct Hang {
    double length;        ///< m below the pins
    double spacing;       ///< m, the finer links'
    double gravity;       ///< m/s^2
    double acceleration;  ///< m/s^2, gravity and the wind's share
    bool by_an_edge;      ///< a held edge carries it, and nothing stands in its way
    double edge_spacing;  ///< m, that of the links that lead away from that edge
    bool by_lone_pins;    ///< particles held alone carry it, and nothing stands in its way
    bool calm;            ///< besides, no wind blows and gravity stays
    std::size_t particle_count;
};

/// Returns m/s^2 of wind at a speed (m/s): its pressure on a plate across it. It is 0 without wind.
double most_wind_acceleration(const SceneDescription& scene, const Cloth& cloth, double speed);
/// Returns the share of it that stretches a cloth.
double wind_acceleration(const SceneDescription& scene, const Cloth& cloth, double speed);

Hang hang_of(const SceneDescription& scene, const Cloth& cloth);

/// The worst frame of a moving cloth errs by so much more than a hanging one.
double motion_factor(const Hang& hang);

}  // namespace drape
