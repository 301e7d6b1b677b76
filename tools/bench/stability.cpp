#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "bench/benchmarks.h"
#include "bench/measure.h"
#include "bench/stability_judge.h"
#include "bench/stability_result.h"
#include "output/kept_frames.h"
#include "run/run.h"

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

/// Fills all but the key. `stop` is asked before every frame. Throws Stopped when it said so, and DeviceError.
StabilityResult run_stability_case(const Device& device, const StabilityCase& each, const std::function<bool()>& stop) {
    StabilityResult result;
    result.name = each.name;
    const Stopwatch watch;
    const SceneResult scene = scene_of(each);
    if (!scene.scene) {
        refuse(result, scene.errors.front().text());
    } else {
        simulate(device, each, *scene.scene, stop, result);
    }
    result.numbers["wall_s"] = watch.seconds();
    return result;
}

/// The memory of a pipeline is given back with its device only: about 0.3 MB each on lavapipe.
constexpr std::size_t runs_per_device = 100;

class StabilityBench {
  public:
    StabilityBench(const StabilityRequest& request, std::vector<StabilityCase> cases)
        : request_(request),
          cases_(std::move(cases)),
          store_(std::filesystem::path(request.folder) / "stability.jsonl"),
          loop_(request, request.budget_minutes, 0.5) {
        renew();
        for (const StabilityCase& each : cases_) loop_.plan(work(each));
    }

    /// Throws Stopped.
    void run() {
        for (const StabilityCase& each : cases_) {
            const auto run_case = [&] {
                if (++since_renewed_ > runs_per_device) renew();
                return run_stability_case(*device_, each, [this] { return request_.stopped(); });
            };
            const auto text = [&](const StabilityResult& result) {
                const std::string why = shortfall(each, result);
                return fmt::format("{}: {}{}", result.name, spelling(verdict_spellings, result.verdict),
                                   why.empty() ? "" : " (" + why + ")");
            };
            auto result = loop_.next(store_, key_of(each), work(each), run_case, text);
            if (!result) continue;
            report_.cases.push_back(each);
            report_.results.push_back(std::move(*result));
        }
        renew();
    }

    const StabilityReport& report() const { return report_; }
    BenchSummary summary() const {
        BenchSummary summary = loop_.summary();
        summary.validation_count = validation_count_;
        return summary;
    }

  private:
    static double work(const StabilityCase& each) { return std::max(each.frames, 60u) / 60.0; }

    void renew() {
        if (device_) validation_count_ += device_->validation_count();
        device_.reset();
        // All its sheets are as small.
        device_ = std::make_unique<Device>(
            Device::for_scene(parse_scene(base_scene()), false, request_.device, validation_if(request_.validate)));
        static_cast<ReportHead&>(report_) = report_head(device_->info(), request_.is_short);
        since_renewed_ = 0;
    }

    std::string key_of(const StabilityCase& each) const {
        std::vector<std::string> parts{program_hash(), device_->info().uuid_text(),   report_.device, report_.driver,
                                       each.name,      std::to_string(request_.seed), base_scene()};
        if (!each.random)
            for (const std::string& text : overrides_of(each)) parts.push_back(text);
        return run_key(parts);
    }

    const StabilityRequest& request_;
    std::vector<StabilityCase> cases_;
    ResultStore<StabilityResult> store_;
    CaseLoop loop_;
    StabilityReport report_;
    std::unique_ptr<Device> device_;
    std::size_t since_renewed_ = 0;
    std::uint64_t validation_count_ = 0;
};

}  // namespace

BenchSummary run_stability(const StabilityRequest& request) {
    const StabilityPlan plan{request.is_short, request.seed, request.mixes.value_or(request.is_short ? 60 : 1000),
                             request.randoms.value_or(request.is_short ? 10 : 500)};
    std::vector<StabilityCase> cases =
        CaseFilter(request.filter).chosen(stability_cases(plan), "pair/wind 50 + start line/relax");
    make_folder(request.folder);
    StabilityBench bench(request, std::move(cases));
    bench.run();
    BenchSummary summary = bench.summary();
    StabilityReport report = bench.report();
    report.complete = summary.left_out_count == 0;
    std::map<std::string, std::string> maps;
    for (const SolverMethodName& method : solver_method_names)
        maps[fmt::format("stability_{}.svg", method.name)] = stability_map(report, method.method);
    write_results(request, stability_json(report), stability_csv(report), maps);
    summary.text = stability_text(report);
    const auto garbage_count =
        std::ranges::count_if(report.results, [](const StabilityResult& result) { return !result.garbage.empty(); });
    if (garbage_count > 0)
        summary.missed = fmt::format("{} runs ended as done with what the judge calls garbage", garbage_count);
    return summary;
}

}  // namespace drape::bench
