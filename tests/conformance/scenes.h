// Scenes that between them have every kind of step, on small cloths.
#pragma once

#include <string>
#include <vector>

#include "drape/scene.h"

namespace drape::test {

struct ConformanceScene {
    std::string name;
    SceneDescription scene;
    std::uint32_t lead;  ///< frames that the twin simulates alone before the first that is compared
};

const std::vector<ConformanceScene>& conformance_scenes();

}  // namespace drape::test
