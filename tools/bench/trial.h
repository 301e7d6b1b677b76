// One scene of a trial of `auto`, and the report on all of them.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/bench_run.h"
#include "drape/scene.h"

namespace drape::bench {

/// `impossible`: refused, and explicit micro-steps that soften nothing miss the limits there too: pins and colliders
/// stretch the cloth, whatever computes it.
enum class TrialOutcome { kept, tolerance, impossible, diverged, failed };
inline constexpr Spelling<TrialOutcome> trial_outcome_spellings[] = {{"kept", TrialOutcome::kept},
                                                                     {"tolerance missed", TrialOutcome::tolerance},
                                                                     {"impossible", TrialOutcome::impossible},
                                                                     {"diverged", TrialOutcome::diverged},
                                                                     {"failed", TrialOutcome::failed}};
constexpr const auto& spellings_of(TrialOutcome) { return trial_outcome_spellings; }

/// Numbers by name (SI units); those that could not be told are missing:
///   frames, seconds              finished frames after the first, and their simulated time
///   size                         m, the largest cloth's longer side
///   substeps_mean, substeps_max, redone_frames, attempts, sensitive_frames (positions are not promised)
///   tolerance, worst_stretch_error, worst_spring, wall_s
///   stated_error                 m, by the run itself, at the end or where the comparison with a reference ends; none
///                                where it is sensitive
///   missed_frames                above a limit of the stretch error, though handed out
/// with a reference:
///   reference_substeps, reference_error, compared_s (until the two references part), error, worst_error (RMS position,
///   mean over the frames and worst), error_at_end (of what is compared)
///   best_wall_s                  of the soonest fixed setting that keeps the same limits
struct TrialResult {
    std::string name;  ///< "b/1/17": generator, seed, index
    std::string key;   ///< hash of everything that decides the result
    TrialOutcome outcome = TrialOutcome::kept;
    std::string reason;  ///< why it was not kept
    std::string method;  ///< in use at the end
    std::string best;    ///< "line/8": the soonest fixed setting that keeps the same limits; empty: none, or not asked
    std::vector<std::string> tags;  ///< what the scene has: "wind", "release", ...
    Metrics numbers;
    bool operator==(const TrialResult&) const = default;

    template <class Self>
    static void members(Self& self, const auto& see) {
        see("name", self.name), see("key", self.key), see("outcome", self.outcome), see("reason", self.reason);
        see("method", self.method), see("best", self.best), see("tags", self.tags), see("numbers", self.numbers);
    }
};

/// The scene's features: "wind", "release", ...
std::vector<std::string> tags_of(const SceneDescription& scene);

/// Fills all of the result but name and key: the scene is run, compared with converged runs of itself and timed against
/// fixed settings. `stop` is asked before every frame. Throws Stopped when it said so.
TrialResult try_scene(const Device& device, const SceneDescription& scene, bool with_reference,
                      const std::function<bool()>& stop);

/// Whether more than 1 % were refused that are not impossible, or a frame was handed out that misses its limits.
bool trial_fails(std::span<const TrialResult> results);
std::string trial_text(std::span<const TrialResult> results);

}  // namespace drape::bench
