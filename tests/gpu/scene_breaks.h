// One way to break the program for every oracle of every shipped scene: the oracle must notice.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cloth/schedule.h"

namespace drape::test {

/// As far as the scene goes.
inline constexpr std::uint32_t to_the_end = 0xffffffff;

struct SceneBreak {
    std::string scene;   ///< file name without .json; empty: every scene that has the oracle
    std::string check;   ///< the oracle that must go red
    std::string what;    ///< what is wrong
    std::uint32_t last;  ///< frame by which it shows
    void (*apply)(SimulationModel&);

    bool concerns(const std::string& scene_name, const std::string& oracle) const {
        return (scene.empty() || scene == scene_name) && check == oracle;
    }
};

const std::vector<SceneBreak>& scene_breaks();

}  // namespace drape::test
