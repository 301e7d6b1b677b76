// The scenes that the program is shipped with are found when the tests run.
#pragma once

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "drape/scene_reader.h"

namespace drape::test {

inline std::filesystem::path scene_folder() { return std::filesystem::path(DRAPE_SOURCE_DIR) / "scenes"; }

/// Returns file names without .json, sorted.
inline std::vector<std::string> shipped_scene_names() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(scene_folder()))
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    std::ranges::sort(names);
    return names;
}

inline SceneDescription shipped_scene(const std::string& name) {
    SceneResult result = read_scene((scene_folder() / (name + ".json")).string());
    if (!result.scene) throw std::runtime_error(result.errors.at(0).text());
    return std::move(*result.scene);
}

}  // namespace drape::test
