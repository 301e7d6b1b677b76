#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/scene_problem.h"
#include "cloth/simulation_model.h"

namespace drape::bench {

namespace {

/// Returns x y z of every particle of a frame.
std::vector<float> positions_of(const FinishedFrame& frame) {
    std::vector<float> all;
    for (const std::span<const float> cloth : frame.positions)
        for (std::size_t i = 0; i + 3 < cloth.size(); i += 4)
            all.insert(all.end(), {cloth[i], cloth[i + 1], cloth[i + 2]});
    return all;
}

/// Returns the RMS distance between two frames' particles, m.
double rms_between(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (double(a[k]) - b[k]) * (double(a[k]) - b[k]);
    return std::sqrt(3 * sum / std::max<double>(static_cast<double>(a.size()), 1));
}

/// Returns the scene with a method, so many substeps of one iteration, and no tolerance.
SceneDescription fixed(SceneDescription scene, SolverMethod method, std::uint32_t substeps) {
    scene.solver.method = method;
    scene.solver.substeps = substeps;
    scene.solver.iterations = 1;
    scene.solver.tolerance = 0;
    return scene;
}

using Frames = std::vector<std::vector<float>>;  ///< per frame after the first: x y z of every particle

/// Returns the frames of a run; nothing when a value is no longer finite.
std::optional<Frames> frames_of(const Device& device, SceneDescription scene, SolverMethod method,
                                std::uint32_t substeps, const ReferenceProgress& progress) {
    scene = fixed(std::move(scene), method, substeps);
    scene.solver.strain_damping = 0;  // it is not a property of the cloth
    Simulation simulation(scene, {}, device);
    Frames frames;
    const std::uint32_t last = scene.time.frame_count - 1;
    try {
        simulation.run(
            last, [](std::uint32_t frame) { return frame > 0; },
            [&](const FinishedFrame& frame) {
                frames.push_back(positions_of(frame));
                progress(static_cast<double>(frame.frame) / last);
            });
    } catch (const Diverged&) {
        return std::nullopt;
    }
    return frames;
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / std::max<double>(static_cast<double>(values.size()), 1);
}

/// A method's runs at doubled substeps; the last three are kept.
class Refinement {
  public:
    Refinement(const Device& device, const SceneDescription& scene, SolverMethod method, std::uint32_t coarsest,
               const RefinementOptions& options)
        : device_(device), scene_(scene), method_(method), substeps_(coarsest), options_(options) {
        is_finite_ = run(coarsest);
        for (int level = 0; level < 2 && is_finite_; ++level) refine();
    }

    /// Doubles the substeps.
    void refine() {
        substeps_ *= 2;
        is_finite_ = run(substeps_);
        if (!is_finite_ || runs_.size() < 3) return;
        estimate_.clear();
        order_.clear();
        for (std::size_t frame = 0; frame < finest().size(); ++frame) {
            const double first = rms_between(runs_[0][frame], runs_[1][frame]);
            const double second = rms_between(runs_[1][frame], runs_[2][frame]);
            order_.push_back(first > 0 && second > 0 ? std::log2(first / second) : 0);
            estimate_.push_back(second / (std::exp2(std::clamp(order_.back(), 0.5, 2.0)) - 1));
        }
    }

    bool is_finite() const { return is_finite_; }
    const Frames& finest() const { return runs_.back(); }
    const std::vector<double>& estimate() const { return estimate_; }
    const std::vector<double>& order() const { return order_; }
    std::uint32_t substeps() const { return substeps_; }
    SolverMethod method() const { return method_; }
    std::string name() const { return fmt::format("{} at {} substeps", named(method_).name, substeps_); }

  private:
    bool run(std::uint32_t substeps) {
        options_.say(fmt::format("reference: {} at {} substeps", named(method_).name, substeps));
        std::optional<Frames> frames = frames_of(device_, scene_, method_, substeps, options_.progress);
        if (!frames) return false;
        runs_.push_back(std::move(*frames));
        if (runs_.size() > 3) runs_.erase(runs_.begin());
        return true;
    }

    const Device& device_;
    const SceneDescription& scene_;
    SolverMethod method_;
    std::uint32_t substeps_;
    const RefinementOptions& options_;
    bool is_finite_ = true;
    std::vector<Frames> runs_;
    std::vector<double> estimate_, order_;
};

/// Returns the fewest substeps, at least `least`, with which the method follows everything that the scene asks for;
/// nothing if these are more than `most`, or no number is enough.
std::optional<std::uint32_t> full_substeps(SceneDescription scene, SolverMethod method, std::uint32_t least,
                                           std::uint32_t most) {
    scene = fixed(std::move(scene), method, least);
    scene.solver.strain_damping = 0;
    std::uint32_t enough = least;
    for (const Compromise& each : SimulationModel(scene).compromises()) {
        if (each.enough_substeps == 0) return std::nullopt;
        enough = std::max(enough, each.enough_substeps);
    }
    return enough > most ? std::nullopt : std::optional(enough);
}

std::vector<Refinement> candidates(const Device& device, const SceneDescription& scene,
                                   const RefinementOptions& options) {
    const std::uint32_t coarsest = std::max(options.most_substeps / 16, 1u);
    std::vector<Refinement> all;
    for (const SolverMethod method : {SolverMethod::line, SolverMethod::explicit_steps}) {
        std::optional<std::uint32_t> start = full_substeps(scene, method, coarsest, options.most_substeps / 4);
        // Stiffness that no allowed run of `line` follows is left out of the reference too, as a last resort.
        if (!start && method == SolverMethod::line) {
            options.say("reference: no allowed substeps follow all of the scene's stiffness and bending");
            start = options.most_substeps / 4;
        }
        if (!start) continue;
        Refinement refinement(device, scene, method, std::max(*start, 1u), options);
        if (refinement.is_finite()) all.push_back(std::move(refinement));
    }
    return all;
}

/// Returns the best method's estimated error, raised by the distance of the other methods' finest runs beyond their own
/// estimates, which their own errors cannot explain.
std::vector<double> honest_estimate(const Refinement& best, const std::vector<Refinement>& all) {
    std::vector<double> estimate = best.estimate();
    for (const Refinement& other : all)
        if (&other != &best)
            for (std::size_t k = 0; k < estimate.size(); ++k)
                estimate[k] =
                    std::max(estimate[k], rms_between(best.finest()[k], other.finest()[k]) - other.estimate()[k]);
    return estimate;
}

NetworkState state_of(const std::vector<float>& frame) {
    NetworkState state;
    for (std::size_t i = 0; i + 2 < frame.size(); i += 3)
        state.position.push_back({frame[i], frame[i + 1], frame[i + 2]});
    state.velocity.resize(state.position.size());
    return state;
}

}  // namespace

ReferenceRun refined_scene(const Device& device, const SceneDescription& scene, const RefinementOptions& options) {
    std::vector<Refinement> all = candidates(device, scene, options);
    if (all.empty()) throw Diverged("no refined run of the scene stays finite, so there is nothing to compare with");
    const auto best = std::ranges::min_element(all, {}, [](const Refinement& r) { return mean(r.estimate()); });
    while (mean(best->estimate()) > options.wanted_error && 2 * best->substeps() <= options.most_substeps) {
        best->refine();
        if (!best->is_finite()) throw Diverged(best->name() + " is no longer finite, though fewer substeps were");
    }
    ReferenceRun run{best->name(), 1 / (scene.time.fps * best->substeps()), {}, {}, honest_estimate(*best, all),
                     best->order()};
    for (const Refinement& other : all)
        if (&other != &*best)
            run.method +=
                fmt::format("; {} ends {:.2g} m from it, its own estimate {:.2g} m", other.name(),
                            rms_between(best->finest().back(), other.finest().back()), other.estimate().back());
    for (std::size_t k = 0; k < best->finest().size(); ++k) {
        run.times.push_back(static_cast<double>(k + 1) / scene.time.fps);
        run.states.push_back(state_of(best->finest()[k]));
    }
    return run;
}

std::size_t agreeing_count(const ReferenceRun& run, double distance) {
    std::size_t count = 0;
    while (count < run.times.size() &&
           run.error_estimate[count] * (std::exp2(std::clamp(run.observed_order[count], 0.5, 2.0)) - 1) <= distance)
        ++count;
    return count;
}

double mean_error(const ReferenceRun& run, std::size_t count) {
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += run.error_estimate[k];
    return sum / std::max<double>(static_cast<double>(count), 1);
}

}  // namespace drape::bench
