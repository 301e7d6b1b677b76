// Makes small scenes of everything that a scene may hold, for the targets that simulate.
#pragma once

#include <cstdint>
#include <string>

#include "fuzz.h"

namespace drape::fuzz {

struct SmallScene {
    std::uint32_t longest_side = 9;  ///< particles
    std::uint32_t cloths = 2, frames = 3, substeps = 4;
    bool cutters = true;
};

/// Returns a scene file's text. Most values are everyday ones, some extreme; the reader refuses some of the scenes.
std::string small_scene(Dice& dice, const SmallScene& limits);

}  // namespace drape::fuzz
