// What commands with a scene have in common: the scene as it is asked for, its device, what a run of it is known by.
#pragma once

#include <string>
#include <vector>

#include "drape.h"
#include "drape/simulation.h"

namespace drape {

struct LoadedScene {
    SceneDescription description;
    std::string text;  ///< of the file
    std::string hash;  ///< of the text and the overrides: what decides the result besides program and device
    std::vector<std::string> warnings;
};

/// Throws SceneFailure.
LoadedScene load(const SceneRequest& request);
/// The same of a text that was read before.
LoadedScene load_text(const SceneRequest& request, std::string text);

/// Two runs with the same key give the same bytes for the same frame.
std::string key_of(const RunRequest& request, const LoadedScene& scene, const DeviceInfo& device);

SimulationOptions simulation_options(const SceneRequest& request, bool draw, bool positions, bool velocities);
/// To run the scene with.
Device device_of(const SceneRequest& request, const SceneDescription& scene, bool draws);

}  // namespace drape
