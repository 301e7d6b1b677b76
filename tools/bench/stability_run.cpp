#include "bench/stability_run.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "bench/measure.h"
#include "bench/stability_judge.h"

namespace drape::bench {

namespace {

/// Largest stretch error and penetration (over an edge) that an accurate cloth may show.
constexpr double accurate_stretch = 0.06, accurate_penetration = 1e-3;
constexpr double bounded_penetration = 0.05;

void judge(StabilityResult& result) {
    const Metrics& numbers = result.numbers;
    result.garbage = garbage(numbers);
    result.verdict = Verdict::holds;
    result.reason = breach(numbers, accurate_stretch, accurate_penetration);
    if (result.reason.empty()) return;
    result.verdict = Verdict::bends;
    const std::string unbounded = breach(numbers, numbers.at("stretch_law"), bounded_penetration);
    if (unbounded.empty()) return;
    result.reason = unbounded;
    const bool only_late = breach(numbers, INFINITY, INFINITY).empty();
    result.verdict = only_late ? Verdict::unsettled : Verdict::fails;
}

void refuse(StabilityResult& result, const std::string& reason) {
    result.verdict = Verdict::refuses;
    result.reason = reason;
}

void simulate(const Device& device, const StabilityCase& each, const SceneDescription& scene,
              const std::function<bool()>& stop, StabilityResult& result) {
    const SimulationModel model(scene);
    StabilityJudge judge_of_run(model);
    SimulationOptions options;
    options.kernels = each.kernels;
    options.timings = Timings::none;
    Simulation simulation(scene, options, device);
    result.method = simulation.facts().method;
    bool is_over = false;
    const auto finished = [&](const FinishedFrame& frame) {
        if (is_over) return;  // one that was under way already
        judge_of_run.see(frame);
        // Random scenes are run to their end; others until what disturbed them is over.
        is_over = !each.random && frame.frame >= each.frames && judge_of_run.recovered();
    };
    try {
        const bool complete = simulation.run(
            scene.time.frame_count - 1, [](std::uint32_t) { return true; }, finished,
            [&] { return is_over || stop(); });
        if (!complete && !is_over) throw Stopped{};
    } catch (const Diverged& error) {
        result.numbers = judge_of_run.numbers();
        return refuse(result, error.what());
    } catch (const ToleranceMissed& error) {
        result.numbers = judge_of_run.numbers();
        return refuse(result, error.what());
    }
    result.numbers = judge_of_run.numbers();
    judge(result);
}

}  // namespace

StabilityResult run_stability_case(const Device& device, const StabilityCase& each, const std::function<bool()>& stop) {
    using Clock = std::chrono::steady_clock;
    StabilityResult result;
    result.name = each.name;
    const auto start = Clock::now();
    const SceneResult scene = scene_of(each);
    if (!scene.scene) {
        refuse(result, scene.errors.front().text());
    } else {
        simulate(device, each, *scene.scene, stop, result);
    }
    result.numbers["wall_s"] = std::chrono::duration<double>(Clock::now() - start).count();
    return result;
}

}  // namespace drape::bench
