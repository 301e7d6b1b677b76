// What was put into a frame, as numbers beside what came out of it: wind, gravity, loads, stiffness, and where pins and
// colliders were.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "drape/scene.h"
#include "output/kept_frames.h"

namespace drape {

/// Returns what changes in a scene at a frame's time, with `given_` in its names. What nothing changes is in the scene.
FrameValues given_values(const SceneDescription& scene, std::uint32_t frame);

/// Returns the values that overrides ("/pointer=value") give to a scene as NPY arrays, each with its name, "set" and
/// the pointer: a number or an array of numbers as float64, all else as a JSON text. The last of equal pointers counts.
std::vector<std::pair<std::string, std::string>> set_arrays(const std::vector<std::string>& overrides);

}  // namespace drape
