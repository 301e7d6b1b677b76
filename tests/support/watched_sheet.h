// A sheet that hangs, statistics of it at rest, and what the watch says of others.
#pragma once

#include <cstdint>
#include <string>

#include "control/watch.h"
#include "support/sheets.h"

namespace drape::test {

/// A sheet of 1 m and 1 kg hangs by its top from the origin, in 60 frames a second.
inline SceneDescription hanging() {
    SceneDescription scene = test::sheet(5, 5, 1, 1, 4);
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    scene.cloths[0].areal_density = 1;
    scene.time.frame_count = 100;
    return scene;
}

/// Statistics at rest where the cloth started: the centre of mass is 0.5 m below the origin.
inline ClothStatistics resting() {
    ClothStatistics statistics;
    statistics.mass = 1;
    statistics.potential_energy = -9.81 * 0.5;
    statistics.largest_distance = 1.5;
    statistics.stretch = {40, 0.001, 0.01, -0.01};
    return statistics;
}

inline std::string said(const SceneDescription& scene, std::uint32_t frame, const ClothStatistics& statistics) {
    const SimulationModel model(scene);
    const auto found = Watch(model).implausible(frame, {statistics});
    return found ? found->what : std::string();
}

}  // namespace drape::test
