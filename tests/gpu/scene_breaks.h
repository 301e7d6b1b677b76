// For every oracle of every shipped scene there is one way to break the program that the oracle must notice.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cloth/frame_steps.h"

namespace drape::test {

/// The break runs as far as the scene goes.
inline constexpr std::uint32_t to_the_end = 0xffffffff;

struct SceneBreak {
    std::string scene;   ///< file name without .json; empty: every scene that has the oracle
    std::string check;   ///< the oracle that must go red
    std::string what;    ///< what is wrong
    std::uint32_t last;  ///< frame by which it shows
    /// Breaks the scene before it is run, or its model; the other is null. The oracle judges by the file.
    void (*break_scene)(SceneDescription&);
    void (*break_model)(SimulationModel&) = nullptr;

    SimulationModel model_of(SceneDescription whole) const {
        if (break_scene) break_scene(whole);
        SimulationModel model(whole);
        if (break_model) break_model(model);
        return model;
    }

    bool concerns(const std::string& scene_name, const std::string& oracle) const {
        return (scene.empty() || scene == scene_name) && check == oracle;
    }
};

const std::vector<SceneBreak>& scene_breaks();

}  // namespace drape::test
