#include "bench/trial_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/measure.h"
#include "bench/scene_problem.h"
#include "cloth/solver_choice.h"
#include "drape/simulation.h"

namespace drape::bench {

namespace {

using Clock = std::chrono::steady_clock;

struct TrialFrame {
    std::uint32_t substeps = 0, attempts = 1;
    double motion_error = NAN;                   ///< m/s, where it was estimated
    double stretch_error = 0, worst_spring = 0;  ///< the worst cloth's
    std::vector<float> positions;                ///< x y z of every particle, where wanted
};

struct TrialRun {
    TrialOutcome outcome = TrialOutcome::kept;
    std::string reason, method;
    std::vector<TrialFrame> frames;  ///< after the first
    double wall = 0;                 ///< s, without set-up
};

TrialFrame frame_of(const FinishedFrame& frame, const Simulation& simulation, bool with_positions) {
    TrialFrame result;
    result.substeps = simulation.scene().solver.substeps;
    const ClothStatistics all = joined(frame.statistics);
    result.stretch_error = all.stretch_error_rms;
    result.worst_spring = all.stretch_error_max;
    if (with_positions)
        for (const std::span<const float> cloth : frame.positions)
            for (std::size_t i = 0; i + 3 < cloth.size(); i += 4)
                result.positions.insert(result.positions.end(), {cloth[i], cloth[i + 1], cloth[i + 2]});
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
        const auto start = Clock::now();
        const auto finished = [&](const FinishedFrame& frame) {
            if (frame.frame > 0) result.frames.push_back(frame_of(frame, simulation, with_positions));
            result.wall = std::chrono::duration<double>(Clock::now() - start).count();
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

SceneDescription fixed(SceneDescription scene, SolverMethod method, std::uint32_t substeps) {
    scene.solver.method = method;
    scene.solver.substeps = substeps;
    scene.solver.iterations = 1;
    scene.solver.tolerance = 0;
    return scene;
}

double rms_between(const TrialFrame& a, const TrialFrame& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.positions.size(); ++k) {
        const double difference = static_cast<double>(a.positions[k]) - static_cast<double>(b.positions[k]);
        sum += difference * difference;
    }
    return std::sqrt(3 * sum / std::max<double>(static_cast<double>(a.positions.size()), 1));
}

double size_of(const SceneDescription& scene) {
    double size = 0;
    for (const Cloth& cloth : scene.cloths) size = std::max({size, cloth.size[0], cloth.size[1]});
    return size;
}

double tolerance_of(const SceneDescription& scene) {
    return scene.solver.tolerance > 0 ? scene.solver.tolerance : default_tolerance;
}

void count_frames(const TrialRun& run, const SceneDescription& scene, Metrics& numbers) {
    const auto count = static_cast<double>(run.frames.size());
    const double tolerance = tolerance_of(scene);
    numbers = {{"frames", count},
               {"seconds", count / scene.time.fps},
               {"size", size_of(scene)},
               {"tolerance", tolerance},
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
        numbers["missed_frames"] += frame.stretch_error > tolerance ? 1 : 0;
        numbers["substeps_max"] = std::max<double>(numbers["substeps_max"], frame.substeps);
        numbers["substeps_mean"] += frame.substeps / count;
        numbers["redone_frames"] += frame.attempts > 1 ? 1 : 0;
        numbers["attempts"] += frame.attempts;
    }
}

/// m, over the first `frames`: a frame without an estimate has that of the frame before.
std::optional<double> motion_estimate(const TrialRun& run, std::size_t frames, double fps) {
    double sum = 0, rate = NAN;
    std::size_t before = 0;  // the first estimate stands for the frames before it
    for (std::size_t k = 0; k < frames; ++k) {
        if (std::isfinite(run.frames[k].motion_error)) rate = run.frames[k].motion_error;
        if (std::isfinite(rate))
            sum += rate / fps * static_cast<double>(1 + std::exchange(before, 0));
        else
            ++before;
    }
    return std::isfinite(rate) ? std::optional(sum) : std::nullopt;
}

/// Against `line` at four and eight times the most substeps that auto took.
void compare(const Device& device, const SceneDescription& scene, const TrialRun& own,
             const std::function<bool()>& stop, Metrics& numbers) {
    constexpr double fewest = 32, most = 640;
    const auto coarse_substeps = static_cast<std::uint32_t>(std::clamp(4 * numbers["substeps_max"], fewest, most));
    const TrialRun coarse = run(device, fixed(scene, SolverMethod::line, coarse_substeps), true, stop);
    const TrialRun fine = run(device, fixed(scene, SolverMethod::line, 2 * coarse_substeps), true, stop);
    const std::size_t count = std::min({own.frames.size(), coarse.frames.size(), fine.frames.size()});
    std::size_t compared = 0;
    double error = 0, worst = 0, at_end = 0, own_error = 0;
    for (; compared < count; ++compared) {
        // Of first order where there are contacts: the difference itself is the estimate.
        const double apart = rms_between(coarse.frames[compared], fine.frames[compared]);
        if (!(apart <= agreement_share * numbers["size"])) break;
        own_error += apart;
        at_end = rms_between(own.frames[compared], fine.frames[compared]);
        error += at_end;
        worst = std::max(worst, at_end);
    }
    numbers["reference_substeps"] = 2 * coarse_substeps;
    numbers["compared_s"] = static_cast<double>(compared) / scene.time.fps;
    if (compared == 0) return;
    numbers["reference_error"] = own_error / static_cast<double>(compared);
    numbers["error"] = error / static_cast<double>(compared);
    numbers["worst_error"] = worst;
    numbers["error_at_end"] = at_end;
    if (const auto estimate = motion_estimate(own, compared, scene.time.fps)) numbers["motion_estimate"] = *estimate;
}

bool keeps(const TrialFrame& frame, double tolerance) { return frame.stretch_error <= tolerance; }

/// The soonest setting of a method that keeps the limits, from the coarse ones on, if it is sooner than the best.
void sweep(const Device& device, const SceneDescription& scene, SolverMethod method,
           const std::vector<std::uint32_t>& counts, const std::function<bool()>& stop, TrialResult& result) {
    const double tolerance = tolerance_of(scene);
    for (const std::uint32_t substeps : counts) {
        const auto best = result.numbers.find("best_wall_s");
        const double limit = best == result.numbers.end() ? INFINITY : best->second;
        const auto enough = [&](const TrialRun& run) {
            return run.wall > limit || (!run.frames.empty() && !keeps(run.frames.back(), tolerance));
        };
        const TrialRun fixed_run = run(device, fixed(scene, method, substeps), false, stop, enough);
        if (fixed_run.wall > limit) return;
        const bool all = fixed_run.outcome == TrialOutcome::kept &&
                         fixed_run.frames.size() + 1 == scene.time.frame_count &&
                         keeps(fixed_run.frames.back(), tolerance);
        if (!all) continue;
        result.best = fmt::format("{}/{}", named(method).name, substeps);
        result.numbers["best_wall_s"] = fixed_run.wall;
        return;
    }
}

void time_fixed(const Device& device, const SceneDescription& scene, const std::function<bool()>& stop,
                TrialResult& result) {
    std::uint32_t links = 1;
    for (const Cloth& cloth : scene.cloths) links = std::max({links, cloth.grid[0] - 1, cloth.grid[1] - 1});
    sweep(device, scene, SolverMethod::line, {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128}, stop, result);
    std::vector<std::uint32_t> counts;
    for (const double per_link : {0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0}) {
        const auto count = static_cast<std::uint32_t>(std::lround(std::max(1.0, per_link * links)));
        if (counts.empty() || counts.back() != count) counts.push_back(count);
    }
    sweep(device, scene, SolverMethod::explicit_steps, counts, stop, result);
}

}  // namespace

TrialResult try_scene(const Device& device, const SceneDescription& scene, bool with_reference,
                      const std::function<bool()>& stop) {
    TrialResult result;
    result.tags = tags_of(scene);
    const TrialRun own = run(device, scene, with_reference, stop);
    result.outcome = own.outcome;
    result.reason = own.reason;
    result.method = own.method;
    count_frames(own, scene, result.numbers);
    if (const auto estimate = motion_estimate(own, own.frames.size(), scene.time.fps))
        result.numbers["motion_estimate"] = *estimate;
    if (!with_reference || own.outcome != TrialOutcome::kept) return result;
    compare(device, scene, own, stop, result.numbers);
    time_fixed(device, scene, stop, result);
    return result;
}

}  // namespace drape::bench
