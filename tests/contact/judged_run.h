// Simulates a scene, has the exact checker judge every frame, and holds what the run says of itself against that.
#pragma once

#include <string>
#include <vector>

#include "crossing_checker.h"
#include "drape/simulation.h"

namespace drape::test {

struct JudgedRun {
    std::size_t frames = 0;          ///< frames that were handed out
    std::size_t proved_frames = 0;   ///< frames before the first in which something was not proved
    std::size_t crossed_frames = 0;  ///< frames in which some of what meets crosses
    std::uint32_t most_pairs = 0;    ///< largest number of pairs near each other
    std::uint64_t cut_short = 0;
    bool crossed_at_start = false;  ///< some cloths cross at the start, and do not meet before they have come apart
    bool came_apart = false;        ///< all cloths that crossed at the start have come apart
    bool implausible = false;       ///< some frame was no result by the run's own judgement
    std::string ended;              ///< text of the exception that ended the run
    /// Frames in which triangles cross that were proved not to; must be none.
    std::vector<std::uint32_t> contradictions;
};

/// Runs to the scene's last frame, or to the first that is not finite or for which there is no memory.
JudgedRun judged_run(const SceneDescription& scene, const Device& device);

}  // namespace drape::test
