#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bench/measure.h"
#include "bench/scene_problem.h"
#include "bench/trial.h"
#include "cloth/solver_choice.h"
#include "drape/simulation.h"

namespace drape::bench {

namespace {

struct TrialFrame {
    FrameEffort effort;
    double stretch_error = 0, worst_spring = 0;  ///< the worst cloth's
    std::vector<float> positions;                ///< x y z of every particle, where wanted
};

struct TrialRun {
    TrialOutcome outcome = TrialOutcome::kept;
    std::string reason, method;
    std::vector<TrialFrame> frames;  ///< after the first
    double wall = 0;                 ///< s, without set-up
};

TrialFrame frame_of(const FinishedFrame& frame, bool with_positions) {
    TrialFrame result;
    result.effort = frame.effort;
    const ClothStatistics all = joined(frame.statistics);
    result.stretch_error = all.stretch_error_rms;
    result.worst_spring = all.stretch_error_max;
    if (with_positions) result.positions = positions_of(frame);
    return result;
}

/// `enough` is told of every frame; true ends the run, which is then one of fewer frames.
TrialRun run(const Device& device, const SceneDescription& scene, bool with_positions,
             const std::function<bool()>& stop, const std::function<bool(const TrialRun&)>& enough = {}) {
    TrialRun result;
    try {
        SimulationOptions options;
        options.positions = with_positions;
        Simulation simulation(scene, options, device);
        bool is_enough = false;
        const Stopwatch watch;
        const auto finished = [&](const FinishedFrame& frame) {
            if (frame.frame > 0) result.frames.push_back(frame_of(frame, with_positions));
            result.wall = watch.seconds();
            is_enough = is_enough || (enough && enough(result));
        };
        const auto always = [](std::uint32_t) { return true; };
        const bool complete =
            simulation.run(scene.time.frame_count - 1, always, finished, [&] { return is_enough || stop(); });
        if (!complete && !is_enough) throw Stopped{};
        result.method = simulation.facts().method;
    } catch (const ToleranceMissed& error) {
        result.outcome = TrialOutcome::tolerance;
        result.reason = error.what();
    } catch (const Diverged& error) {
        result.outcome = TrialOutcome::diverged;
        result.reason = error.what();
    } catch (const std::exception& error) {
        result.outcome = TrialOutcome::failed;
        result.reason = error.what();
    }
    return result;
}

double rms_between(const TrialFrame& a, const TrialFrame& b) { return bench::rms_between(a.positions, b.positions); }

/// The errors that `auto` promises to keep.
struct Limits {
    explicit Limits(const SceneDescription& scene)
        : stretch(or_default(scene.solver.tolerance, default_tolerance)),
          spring(or_default(scene.solver.tolerance_worst, default_tolerance_worst)),
          motion(or_default(scene.solver.tolerance_motion, default_motion_limit(largest_side(scene)))) {}

    bool keeps(const TrialFrame& frame) const { return frame.stretch_error <= stretch && frame.worst_spring <= spring; }

    double stretch, spring;  ///< RMS and largest stretch error
    double motion;           ///< m/s

  private:
    static double or_default(double asked, double otherwise) { return asked > 0 ? asked : otherwise; }
};

void count_frames(const TrialRun& run, const SceneDescription& scene, Metrics& numbers) {
    const auto count = static_cast<double>(run.frames.size());
    const Limits limits(scene);
    numbers = {{"frames", count},
               {"seconds", count / scene.time.fps},
               {"size", largest_side(scene)},
               {"tolerance", limits.stretch},
               {"worst_stretch_error", 0},
               {"worst_spring", 0},
               {"missed_frames", 0},
               {"substeps_max", 0},
               {"substeps_mean", 0},
               {"redone_frames", 0},
               {"attempts", 0},
               {"wall_s", run.wall}};
    for (const TrialFrame& frame : run.frames) {
        numbers["worst_stretch_error"] = std::max(numbers["worst_stretch_error"], frame.stretch_error);
        numbers["worst_spring"] = std::max(numbers["worst_spring"], frame.worst_spring);
        numbers["missed_frames"] += limits.keeps(frame) ? 0 : 1;
        numbers["substeps_max"] = std::max<double>(numbers["substeps_max"], frame.effort.substeps);
        numbers["substeps_mean"] += frame.effort.substeps / count;
        numbers["redone_frames"] += frame.effort.attempts > 1 ? 1 : 0;
        numbers["sensitive_frames"] += frame.effort.sensitive ? 1 : 0;
        numbers["attempts"] += frame.effort.attempts;
    }
}

/// The position error that the run itself states at the end of its first `frames`.
void note_stated_error(const TrialRun& run, std::size_t frames, Metrics& numbers) {
    numbers.erase("stated_error");
    const double stated = frames > 0 ? run.frames[frames - 1].effort.position_error : NAN;
    if (std::isfinite(stated)) numbers["stated_error"] = stated;
}

/// The scene by `line` at four and eight times the most substeps that auto took.
struct Reference {
    TrialRun fine;
    std::size_t compared = 0;  ///< frames until which both agree
    double own_error = 0;      ///< m, mean over these: of first order where there are contacts, so their difference
};

Reference converged(const Device& device, const SceneDescription& scene, const TrialRun& own,
                    const std::function<bool()>& stop, Metrics& numbers) {
    constexpr double fewest = 32, most = 640;
    const auto substeps = static_cast<std::uint32_t>(std::clamp(4 * numbers["substeps_max"], fewest, most));
    const TrialRun coarse = run(device, fixed(scene, SolverMethod::line, substeps), true, stop);
    Reference reference{run(device, fixed(scene, SolverMethod::line, 2 * substeps), true, stop)};
    const std::size_t count = std::min({own.frames.size(), coarse.frames.size(), reference.fine.frames.size()});
    for (; reference.compared < count; ++reference.compared) {
        const double apart = rms_between(coarse.frames[reference.compared], reference.fine.frames[reference.compared]);
        if (!(apart <= agreement_share * numbers["size"])) break;
        reference.own_error += apart;
    }
    reference.own_error /= std::max<double>(static_cast<double>(reference.compared), 1);
    numbers["reference_substeps"] = 2 * substeps;
    numbers["compared_s"] = static_cast<double>(reference.compared) / scene.time.fps;
    return reference;
}

void compare(const TrialRun& own, const Reference& reference, Metrics& numbers) {
    if (reference.compared == 0) return;
    double sum = 0, worst = 0, last = 0;
    for (std::size_t k = 0; k < reference.compared; ++k) {
        last = rms_between(own.frames[k], reference.fine.frames[k]);
        sum += last;
        worst = std::max(worst, last);
    }
    numbers["reference_error"] = reference.own_error;
    numbers["error"] = sum / static_cast<double>(reference.compared);
    numbers["worst_error"] = worst;
    numbers["error_at_end"] = last;
    note_stated_error(own, reference.compared, numbers);
}

/// The soonest setting of a method that keeps the limits, from the coarse ones on, if it is sooner than the best. Its
/// motion may be as wrong as the limit allows over the time that is compared, or as that of auto.
void sweep(const Device& device, const SceneDescription& scene, SolverMethod method,
           const std::vector<std::uint32_t>& counts, const Reference& reference, const std::function<bool()>& stop,
           std::optional<SceneDescription>& best, TrialResult& result) {
    const Limits limits(scene);
    for (const std::uint32_t substeps : counts) {
        const double soonest = best ? result.numbers["best_wall_s"] : INFINITY;
        const auto enough = [&](const TrialRun& run) {
            return run.wall > soonest || (!run.frames.empty() && !limits.keeps(run.frames.back()));
        };
        const TrialRun own = run(device, fixed(scene, method, substeps), true, stop, enough);
        if (own.wall > soonest) return;
        if (own.outcome != TrialOutcome::kept || own.frames.size() + 1 != scene.time.frame_count ||
            !limits.keeps(own.frames.back()))
            continue;
        if (reference.compared > 0) {
            const double error =
                rms_between(own.frames[reference.compared - 1], reference.fine.frames[reference.compared - 1]);
            if (error > std::max(limits.motion * result.numbers["compared_s"], result.numbers["error_at_end"]))
                continue;
        }
        best.emplace(fixed(scene, method, substeps));
        result.best = fmt::format("{}/{}", named(method).name, substeps);
        result.numbers["best_wall_s"] = own.wall;
        return;
    }
}

/// Once more, after the one that compiled its shaders.
double least_wall(const Device& device, const SceneDescription& scene, double wall, const std::function<bool()>& stop) {
    const TrialRun again = run(device, scene, true, stop);
    return again.outcome == TrialOutcome::kept ? std::min(wall, again.wall) : wall;
}

/// The soonest fixed setting that keeps the limits, and the times of both, each the least of two runs.
void time_fixed(const Device& device, const SceneDescription& scene, const Reference& reference,
                const std::function<bool()>& stop, TrialResult& result) {
    std::optional<SceneDescription> best;
    const std::uint32_t links = largest_links(scene);
    sweep(device, scene, SolverMethod::line, {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128}, reference, stop, best,
          result);
    std::vector<std::uint32_t> counts;
    for (const double per_link : {0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0}) {
        const auto count = static_cast<std::uint32_t>(std::lround(std::max(1.0, per_link * links)));
        if (counts.empty() || counts.back() != count) counts.push_back(count);
    }
    sweep(device, scene, SolverMethod::explicit_steps, counts, reference, stop, best, result);
    if (!best) return;
    const auto time_again = [&](const char* name, const SceneDescription& timed) {
        result.numbers[name] = least_wall(device, timed, result.numbers[name], stop);
    };
    time_again("wall_s", scene);
    time_again("best_wall_s", *best);
}

/// Whether explicit micro-steps, twice as many as soften nothing, stretch the cloth as far in the frames after those
/// that were kept.
bool is_impossible(const Device& device, const SceneDescription& scene, std::size_t kept,
                   const std::function<bool()>& stop) {
    const std::vector<SolverCandidate> candidates = SimulationModel(scene).choice.candidates;
    const auto steps = std::ranges::find(candidates, SolverMethod::explicit_steps, &SolverCandidate::method);
    if (steps == candidates.end()) return false;
    SceneDescription shortened = fixed(scene, SolverMethod::explicit_steps, 2 * steps->substeps);
    shortened.time.frame_count = static_cast<std::uint32_t>(
        std::min<double>(scene.time.frame_count, std::ceil(static_cast<double>(kept) + 2 + 0.1 * scene.time.fps)));
    const TrialRun run = bench::run(device, shortened, false, stop);
    const Limits limits(scene);
    const auto missed = std::ranges::find_if(run.frames, [&](const auto& frame) { return !limits.keeps(frame); });
    // Micro-steps that miss them before do not tell anything.
    return missed != run.frames.end() && missed - run.frames.begin() >= static_cast<std::ptrdiff_t>(kept);
}

}  // namespace

std::vector<std::string> tags_of(const SceneDescription& scene) {
    std::vector<std::string> tags;
    const auto add = [&tags](bool has, const char* tag) {
        if (has) tags.emplace_back(tag);
    };
    const auto any_cloth = [&](auto is) { return std::ranges::any_of(scene.cloths, is); };
    const auto any_pin = [&](auto is) {
        return any_cloth([&](const Cloth& cloth) { return std::ranges::any_of(cloth.pins, is); });
    };
    const auto moves = [](const auto& each) { return each.path.moves(); };
    const auto longest = [](const Cloth& cloth) { return std::max(cloth.grid[0], cloth.grid[1]); };
    add(scene.wind.blows(), "wind");
    add(scene.gravity == Vec3{0, 0, 0}, "weightless");
    add(any_pin([](const Pin& pin) { return pin.release.has_value(); }), "release");
    add(any_pin(moves), "moving pins");
    add(any_cloth([](const Cloth& cloth) { return cloth.pins.empty(); }), "no pins");
    add(any_cloth([](const Cloth& cloth) { return cloth.stiffness.rigid; }), "rigid");
    add(any_cloth([](const Cloth& cloth) { return cloth.stiffness.bend > 0; }), "bending");
    add(!scene.colliders.empty(), "colliders");
    add(std::ranges::any_of(scene.colliders, moves), "moving colliders");
    add(!scene.cutters.empty(), "cutters");
    add(scene.cloths.size() > 1, "several cloths");
    add(any_cloth([&](const Cloth& cloth) { return longest(cloth) <= 8; }), "at most 8 a side");
    add(any_cloth([&](const Cloth& cloth) { return longest(cloth) >= 64; }), "at least 64 a side");
    return tags;
}

TrialResult try_scene(const Device& device, const SceneDescription& scene, bool with_reference,
                      const std::function<bool()>& stop) {
    TrialResult result;
    result.tags = tags_of(scene);
    const TrialRun own = run(device, scene, with_reference, stop);
    result.outcome = own.outcome;
    result.reason = own.reason;
    result.method = own.method;
    count_frames(own, scene, result.numbers);
    if (own.outcome == TrialOutcome::tolerance && is_impossible(device, scene, own.frames.size(), stop))
        result.outcome = TrialOutcome::impossible;
    note_stated_error(own, own.frames.size(), result.numbers);
    if (!with_reference || own.outcome != TrialOutcome::kept) return result;
    const Reference reference = converged(device, scene, own, stop, result.numbers);
    compare(own, reference, result.numbers);
    time_fixed(device, scene, reference, stop, result);
    return result;
}

}  // namespace drape::bench
