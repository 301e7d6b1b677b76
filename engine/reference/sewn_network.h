// The spring network of all cloths of a scene, in which what seams join is one particle. Pure.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/spring_network.h"

namespace drape {

struct SewnNetwork {
    SpringNetwork network;
    /// By cloth and its particle, row by row, the particle of the network.
    std::vector<std::vector<std::uint32_t>> particle;
};

/// Joins the networks of a scene's cloths: a sewn particle has the masses, springs and quarters of air of all
/// its copies, their mean velocity by mass, and the pin of one of them; gas is closed in as in the scene. Throws
/// std::invalid_argument as SpringNetwork does, and where cloths are loaded, or damped unlike each other.
SewnNetwork sewn_network(const SceneDescription& scene, const NetworkOptions& options = {});

}  // namespace drape
