// A scene simulated, every frame judged by the exact checker, and what the run says of itself held against that.
#pragma once

#include <string>
#include <vector>

#include "crossing_checker.h"
#include "drape/simulation.h"

namespace drape::test {

struct JudgedRun {
    std::size_t frames = 0;          ///< that were handed out
    std::size_t proved_frames = 0;   ///< before the first in which something was not proved
    std::size_t crossed_frames = 0;  ///< in which some of what meets crosses
    std::uint32_t most_pairs = 0;    ///< that were near each other
    std::uint64_t cut_short = 0;
    bool crossed_at_start = false;  ///< cloths, which therefore do not meet before they have come apart
    bool came_apart = false;        ///< all of those
    bool implausible = false;       ///< some frame was no result, by the run's own judgement
    std::string ended;              ///< by an exception: its text
    /// Frames in which triangles cross that were proved not to; must be none.
    std::vector<std::uint32_t> contradictions;
};

/// To its last frame, or to the first that is not finite or for which there is no memory.
JudgedRun judged_run(const SceneDescription& scene, const Device& device);

}  // namespace drape::test
