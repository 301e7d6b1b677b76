#include "bench/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include "bench/line_file.h"
#include "bench/measure.h"
#include "bench/stability_run.h"
#include "output/atomic_file.h"
#include "output/kept_frames.h"
#include "run/run.h"

namespace drape::bench {

namespace {

/// What a pipeline takes is given back with its device only: about 0.3 MB each on lavapipe.
constexpr std::size_t runs_per_device = 100;

std::vector<StabilityCase> chosen(const StabilityRequest& request) {
    const CaseFilter filter(request.filter);
    std::vector<StabilityCase> cases =
        stability_cases({request.is_short, request.seed, request.mixes.value_or(request.is_short ? 60 : 1000),
                         request.randoms.value_or(request.is_short ? 10 : 500)});
    std::erase_if(cases, [&](const StabilityCase& each) { return !filter.accepts(each.name); });
    if (cases.empty()) filter.refuse("pair/wind 50 + start line/relax");
    return cases;
}

class StabilityBench {
  public:
    StabilityBench(const StabilityRequest& request, std::vector<StabilityCase> cases)
        : request_(request),
          cases_(std::move(cases)),
          file_(std::filesystem::path(request.folder) / "stability.jsonl",
                [this](const std::string& line) {
                    if (auto result = parsed_stability(line)) known_[result->key] = std::move(*result);
                }),
          budget_(request.budget_minutes, 0.5) {
        renew();
        for (std::size_t k = 0; k < cases_.size(); ++k) budget_.left(work(cases_[k]));
    }

    /// Throws Stopped.
    void run(StabilitySummary& summary) {
        for (std::size_t k = 0; k < cases_.size(); ++k) {
            const std::string key = key_of(cases_[k]);
            const double cost = work(cases_[k]);
            budget_.left_out(cost);
            if (const auto known = known_.find(key); known != known_.end()) {
                ++summary.kept_count;
                add(k, known->second);
                continue;
            }
            if (request_.stopped()) throw Stopped{};
            if (!budget_.allows(cost)) {
                ++summary.left_out_count;
                continue;
            }
            const double before = budget_.spent();
            if (++since_renewed_ > runs_per_device) renew();
            StabilityResult result = run_stability_case(*device_, cases_[k], [this] { return request_.stopped(); });
            result.key = key;
            file_.add(stability_line(result));
            add(k, result);
            budget_.done(cost, budget_.spent() - before);
            ++summary.run_count;
            say(k, budget_.spent() - before);
        }
        renew();
        summary.validation_count = validation_count_;
    }

    StabilityReport report() const { return {program_version(), device_text_, done_, results_}; }

  private:
    static double work(const StabilityCase& each) { return std::max(each.frames, 60u) / 60.0; }

    void renew() {
        if (device_) validation_count_ += device_->validation_count();
        device_.reset();
        // All its sheets are as small.
        device_ = std::make_unique<Device>(
            Device::for_scene(parse_scene(base_scene()), false, request_.device, validation_if(request_.validate)));
        const DeviceInfo& info = device_->info();
        device_text_ = fmt::format("{} ({} {})", info.name, info.driver, info.driver_version);
        since_renewed_ = 0;
    }

    std::string key_of(const StabilityCase& each) const {
        std::vector<std::string> parts{program_hash(), device_->info().uuid_text(),   device_text_,
                                       each.name,      std::to_string(request_.seed), base_scene()};
        if (!each.random)
            for (const std::string& text : overrides_of(each)) parts.push_back(text);
        return run_key(parts);
    }

    void add(std::size_t k, const StabilityResult& result) {
        done_.push_back(cases_[k]);
        results_.push_back(result);
    }

    void say(std::size_t k, double seconds) const {
        const StabilityResult& result = results_.back();
        const std::string why = shortfall(done_.back(), result);
        request_.say(fmt::format("{}/{} {}: {}{}, {:.1f} s, ETA {}", k + 1, cases_.size(), result.name,
                                 spelling(verdict_spellings, result.verdict), why.empty() ? "" : " (" + why + ")",
                                 seconds, duration_text(budget_.seconds_left())));
    }

    const StabilityRequest& request_;
    std::vector<StabilityCase> cases_, done_;
    std::vector<StabilityResult> results_;
    std::map<std::string, StabilityResult> known_;
    LineFile file_;
    Budget budget_;
    std::unique_ptr<Device> device_;
    std::string device_text_;
    std::size_t since_renewed_ = 0;
    std::uint64_t validation_count_ = 0;
};

void write_files(const StabilityRequest& request, const StabilityReport& report) {
    if (!request.json.empty()) write_file(request.json, stability_json(report));
    if (!request.csv.empty()) write_file(request.csv, stability_csv(report));
    if (request.svg.empty()) return;
    make_folder(request.svg);
    for (const SolverMethodName& method : solver_method_names)
        write_file(std::filesystem::path(request.svg) / fmt::format("stability_{}.svg", method.name),
                   stability_map(report, method.method));
}

}  // namespace

StabilitySummary run_stability(const StabilityRequest& request) {
    std::vector<StabilityCase> cases = chosen(request);
    make_folder(request.folder);
    StabilityBench bench(request, std::move(cases));
    StabilitySummary summary;
    try {
        bench.run(summary);
    } catch (const Stopped&) {
        summary.stopped = true;
        return summary;
    }
    const StabilityReport report = bench.report();
    write_files(request, report);
    for (std::size_t k = 0; k < report.results.size(); ++k) {
        summary.short_count += !shortfall(report.cases[k], report.results[k]).empty();
        summary.garbage_count += !report.results[k].garbage.empty();
    }
    summary.text = stability_text(report);
    return summary;
}

}  // namespace drape::bench
