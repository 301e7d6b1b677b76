// The stability benchmark runs one small sheet with extremes put on it, alone and together.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "drape/kernels.h"
#include "drape/scene_reader.h"

namespace drape::bench {

/// A tier is what is promised of a scene.
enum class Tier {
    accurate,  ///< A: keeps the numbers
    bounded,   ///< B: nothing absurd, and it recovers
    refused,   ///< C: refused when it is read, with the reason
};
inline constexpr Spelling<Tier> tier_spellings[] = {{"A", Tier::accurate}, {"B", Tier::bounded}, {"C", Tier::refused}};

/// A change of the base scene, as `--set` makes it.
struct Extreme {
    const char *axis, *name;
    Tier tier;
    std::vector<const char*> overrides;
};

/// The first is the base scene itself. Two of the same axis cannot be in one scene.
std::span<const Extreme> extremes();

/// JSON of a sheet of 13 x 9 particles, 0.6 m x 0.4 m, that swings from its upper edge.
std::string base_scene();

/// Frames in which what disturbs a cloth must be over; those that a short run waits.
inline constexpr std::uint32_t recovery_frames = 600, short_recovery_frames = 60;

struct StabilityCase {
    std::string name;           ///< "single/start point/relax", "pair/...", "mix/7/auto", "soak/line", "random/12"
    Tier tier = Tier::bounded;  ///< the worst of its extremes; of several together never accurate
    std::vector<std::size_t> extremes;              ///< into extremes()
    SolverMethod method = SolverMethod::automatic;  ///< of a random scene: its own
    Kernels kernels = Kernels::automatic();
    std::uint32_t frames = 0;                  ///< that are run at least
    std::uint32_t recovery = recovery_frames;  ///< how many more may pass until it has recovered
    std::uint32_t seed = 0, index = 0;
    bool random = false;  ///< `index` of `seed`, of wild_scene
};

/// Returns what `drape simulate` takes to run the case on the base scene.
std::vector<std::string> overrides_of(const StabilityCase& each);

struct StabilityPlan {
    bool is_short = false;
    std::uint32_t seed = 1;
    std::uint32_t mixes = 0, randoms = 0;  ///< how many of each
};

/// Every extreme alone by every method (and every set of kernels, unless short), all pairs of different axes by every
/// method (unless short), mixes of 3 to 6, random scenes, and a soak by every method.
std::vector<StabilityCase> stability_cases(const StabilityPlan& plan);

/// The scene of a case; errors where it is refused.
SceneResult scene_of(const StabilityCase& each);

}  // namespace drape::bench
