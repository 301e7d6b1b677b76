#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "bench/benchmarks.h"
#include "bench/measure.h"
#include "bench/report.h"
#include "bench/scene_problem.h"

namespace drape::bench {

namespace {

namespace fs = std::filesystem;

struct PlannedSweep {
    const Problem* problem;
    Sweep sweep;
};

/// Returns the chosen cases. Throws UsageError when there is none.
std::vector<PlannedSweep> planned(const CaseFilter& filter, const std::vector<Problem>& problems) {
    std::vector<PlannedSweep> plan;
    for (const Problem& problem : problems)
        for (const Sweep& sweep : problem.sweeps) {
            Sweep chosen{sweep.size, {}, sweep.priority};
            for (const Setting& setting : sweep.settings)
                if (filter.accepts(case_name(problem, sweep.size, setting))) chosen.settings.push_back(setting);
            if (!chosen.settings.empty()) plan.push_back({&problem, chosen});
        }
    if (plan.empty()) filter.refuse("swing/64/relax/20");
    std::ranges::stable_sort(plan, {}, [](const PlannedSweep& p) { return p.sweep.priority; });
    return plan;
}

constexpr double first_rate = 5e-9;  // s per particle and pass, before anything is measured

class AccuracyRun {
  public:
    AccuracyRun(const AccuracyRequest& request, const Device& device, CaseFilter filter, std::vector<PlannedSweep> plan)
        : request_(request),
          filter_(std::move(filter)),
          device_(device),
          plan_(std::move(plan)),
          store_(fs::path(request.folder) / "results.jsonl"),
          references_(
              fs::path(request.folder) / "references", [this](const std::string& what) { begin_reference(what); },
              [this](double fraction) { show_reference(fraction); }),
          loop_(request, request.budget_minutes, first_rate) {
        for (const PlannedSweep& p : plan_)
            for (const Setting& setting : p.sweep.settings) loop_.plan(work(p, setting));
    }

    /// Throws Stopped.
    void run() {
        for (const PlannedSweep& p : plan_) run_sweep(p);
        if (!request_.is_short)
            for (const PlannedSweep& p : plan_)
                for (const Target& target : p.problem->targets) bisect(p, target);
        for (const PlannedSweep& p : plan_)
            if (p.problem->about && !results_.empty()) notes_.emplace(p.problem->name, p.problem->about(references_));
    }

    const std::vector<CaseResult>& results() const { return results_; }
    const std::map<std::string, std::string>& notes() const { return notes_; }
    const BenchSummary& summary() const { return loop_.summary(); }

    void begin_reference(const std::string& what) {
        request_.say(what);
        reference_start_ = reference_seen_ = last_line_ = watch_.seconds();
    }

    void show_reference(double fraction) {
        if (request_.stopped()) throw Stopped{};
        const double time = watch_.seconds(), spent = time - reference_start_;
        loop_.put_aside(time - std::exchange(reference_seen_, time));
        if (time - last_line_ < 10 || fraction <= 0) return;
        last_line_ = time;
        request_.say(
            fmt::format("  reference {:.0f} %, {} left", 100 * fraction, duration_text(spent / fraction - spent)));
    }

  private:
    double work(const PlannedSweep& p, const Setting& setting) const {
        return case_work(device_.info(), *p.problem, p.sweep.size, setting);
    }

    void run_sweep(const PlannedSweep& p) {
        bool at_floor = false;
        for (const Setting& setting : p.sweep.settings)
            if (at_floor)
                loop_.skip(work(p, setting));
            else if (run_setting(p, setting))
                at_floor = is_at_floor(*p.problem, results_.back());
    }

    /// Runs a setting. Returns whether there is a result.
    bool run_setting(const PlannedSweep& p, const Setting& setting) {
        const auto measure = [&] {
            return run_case(device_, *p.problem, p.sweep.size, setting, references_,
                            [this] { return request_.stopped(); });
        };
        const auto text = [&](const CaseResult& result) {
            const std::optional<double> error = result.metric(p.problem->metric);
            return fmt::format("{}: {:.3g} ms/frame, {}", result.name, case_milliseconds(result),
                               error             ? fmt::format("{} {:.2e}", p.problem->metric, *error)
                               : result.diverged ? "diverged"
                                                 : "no reference");
        };
        const std::string key = case_key(device_.info(), *p.problem, p.sweep.size, setting);
        std::optional<CaseResult> result = loop_.next(store_, key, work(p, setting), measure, text);
        if (result) results_.push_back(std::move(*result));
        return result.has_value();
    }

    /// A sweep's steps are wide, and chance would favour the method that has a setting just fine enough. So this
    /// searches for the fewest substeps (or iterations of one substep) that keep the target, among all settings like
    /// the sweep's.
    void bisect(const PlannedSweep& p, const Target& target) {
        if (p.sweep.settings.size() < 2) return;
        Setting setting = p.sweep.settings[0];
        const bool by_iterations = setting.substeps == p.sweep.settings[1].substeps;
        const auto is_like = [&](const CaseResult& result) {
            return result.problem == p.problem->name && result.size == p.sweep.size &&
                   result.method == setting.method &&
                   (by_iterations ? result.substeps == setting.substeps : result.iterations == setting.iterations);
        };
        while (true) {
            std::vector<SweepPoint> points;
            for (const CaseResult& result : results_) {
                if (!is_like(result)) continue;
                // The reference's error exceeds the target, so nothing can be concluded.
                if (target.metric == p.problem->metric && result.metric("reference_error") > target.limit) return;
                const std::optional<double> found = result.metric(target.metric);
                points.push_back(
                    {by_iterations ? result.iterations : result.substeps, found && *found <= target.limit});
            }
            const std::optional<std::uint32_t> count = next_count(points);
            if (!count) return;
            (by_iterations ? setting.iterations : setting.substeps) = *count;
            if (!filter_.accepts(case_name(*p.problem, p.sweep.size, setting))) return;
            loop_.plan(work(p, setting));
            if (!run_setting(p, setting)) return;
        }
    }

    static bool is_at_floor(const Problem& problem, const CaseResult& result) {
        const double floor = std::max(problem.floor, 1.5 * result.metric("reference_error").value_or(0));
        return result.metric(problem.metric).value_or(INFINITY) < floor;
    }

    const AccuracyRequest& request_;
    CaseFilter filter_;
    Device device_;
    std::vector<PlannedSweep> plan_;
    ResultStore<CaseResult> store_;
    References references_;
    CaseLoop loop_;
    std::vector<CaseResult> results_;
    std::map<std::string, std::string> notes_;
    Stopwatch watch_;
    double reference_start_ = 0, reference_seen_ = 0, last_line_ = 0;
};

/// The benchmark's problems, or the user's scene, whose reference tells `run` what it does once there is one.
std::vector<Problem> problems_of(const AccuracyRequest& request, const std::optional<UserScene>& user,
                                 const Device& device, const std::shared_ptr<AccuracyRun*>& run) {
    if (!user) return all_problems(request.is_short);
    RefinementOptions options;
    if (!request.errors.empty()) options.wanted_error = std::ranges::min(request.errors) / 4;
    options.most_substeps = request.reference_substeps;
    options.say = [run](const std::string& text) { (*run)->begin_reference(text); };
    options.progress = [run](double fraction) { (*run)->show_reference(fraction); };
    return {user_problem(*user, device, options, request.errors, request.is_short)};
}

}  // namespace

BenchSummary run_accuracy(const AccuracyRequest& request) {
    std::optional<UserScene> user;
    if (!request.scene.empty()) user = read_user_scene(request.scene, request.overrides, request.frames);
    const CaseFilter filter(request.filter);
    if (!user) planned(filter, all_problems(request.is_short));  // a filter that matches nothing needs no device
    const Device device(request.device, validation_if(request.validate));
    const auto current = std::make_shared<AccuracyRun*>();
    const std::vector<Problem> problems = problems_of(request, user, device, current);
    std::vector<PlannedSweep> plan = planned(filter, problems);
    make_folder(request.folder);
    AccuracyRun run(request, device, filter, std::move(plan));
    *current = &run;
    run.run();
    BenchSummary summary = run.summary();
    Report report{report_head(device.info(), request.is_short, summary.left_out_count == 0)};
    report.results = run.results();
    report.notes = run.notes();
    for (const Problem& problem : problems)
        if (problem.timed) report.targets[problem.name] = problem.targets;
    evaluate(report);
    SelectedCases files = request;
    if (user) {
        const fs::path folder = request.folder;
        if (files.json.empty()) files.json = folder / "accuracy.json";
        if (files.csv.empty()) files.csv = folder / "accuracy.csv";
        if (files.svg.empty()) files.svg = folder;
    }
    write_results(files, report_json(report), report_csv(report), plot::svg_of(report_plots(report, problems)));
    summary.text = report_text(report, problems);
    if (const std::size_t count = missed_count(report); count > 0)
        summary.missed = fmt::format("{} of the benchmark's limits, orders and promises not met", count);
    summary.validation_count = device.validation_count();
    return summary;
}

}  // namespace drape::bench
