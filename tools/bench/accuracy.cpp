#include "bench/accuracy.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <optional>

#include "bench/bisection.h"
#include "bench/measure.h"
#include "bench/report.h"
#include "bench/scene_problem.h"
#include "bench/store.h"
#include "output/atomic_file.h"
#include "output/manifest.h"
#include "run/run.h"

namespace drape::bench {

namespace {

namespace fs = std::filesystem;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

struct PlannedSweep {
    const Problem* problem;
    Sweep sweep;
};

/// The chosen cases. Throws UsageError when there is none.
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
          budget_(request.budget_minutes, first_rate) {
        for (const PlannedSweep& p : plan_)
            for (const Setting& setting : p.sweep.settings) {
                budget_.left(case_work(device_.info(), *p.problem, p.sweep.size, setting));
                ++case_count_;
            }
    }

    /// Throws Stopped.
    void run(AccuracySummary& summary) {
        for (const PlannedSweep& p : plan_) run_sweep(p, summary);
        if (!request_.is_short)
            for (const PlannedSweep& p : plan_)
                for (const Target& target : p.problem->targets) bisect(p, target, summary);
        for (const PlannedSweep& p : plan_)
            if (p.problem->about && !results_.empty()) notes_.emplace(p.problem->name, p.problem->about(references_));
        summary.computed_reference_count = references_.computed_count();
    }

    const std::vector<CaseResult>& results() const { return results_; }
    const std::map<std::string, std::string>& notes() const { return notes_; }

    void begin_reference(const std::string& what) {
        request_.say(what);
        reference_start_ = last_line_ = now();
        reference_before_ = reference_seconds_;
    }

    void show_reference(double fraction) {
        if (request_.stopped()) throw Stopped{};
        const double time = now(), spent = time - reference_start_;
        reference_seconds_ = reference_before_ + spent;
        if (time - last_line_ < 10 || fraction <= 0) return;
        last_line_ = time;
        request_.say(
            fmt::format("  reference {:.0f} %, {} left", 100 * fraction, duration_text(spent / fraction - spent)));
    }

  private:
    void run_sweep(const PlannedSweep& p, AccuracySummary& summary) {
        bool at_floor = false;
        for (const Setting& setting : p.sweep.settings) {
            budget_.left_out(case_work(device_.info(), *p.problem, p.sweep.size, setting));
            ++case_number_;
            if (!at_floor && run_setting(p, setting, summary)) at_floor = is_at_floor(*p.problem, results_.back());
        }
    }

    /// Whether there is a result.
    bool run_setting(const PlannedSweep& p, const Setting& setting, AccuracySummary& summary) {
        const double work = case_work(device_.info(), *p.problem, p.sweep.size, setting);
        const std::string key = case_key(device_.info(), *p.problem, p.sweep.size, setting);
        if (std::optional<CaseResult> kept = store_.find(key)) {
            ++summary.kept_count;
            results_.push_back(std::move(*kept));
        } else if (!budget_.allows(work)) {
            ++summary.left_out_count;
            return false;
        } else {
            measure(p, setting, work);
            ++summary.measured_count;
        }
        return true;
    }

    /// A sweep's steps are wide, and who happens to have a setting just fine enough would win: the fewest substeps (or
    /// iterations of one substep) that keep the target are looked for, among all settings like the sweep's.
    void bisect(const PlannedSweep& p, const Target& target, AccuracySummary& summary) {
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
                if (cannot_tell(*p.problem, target, result)) return;
                const auto found = result.metrics.find(target.metric);
                points.push_back({by_iterations ? result.iterations : result.substeps,
                                  found != result.metrics.end() && found->second <= target.limit});
            }
            const std::optional<std::uint32_t> count = next_count(points);
            if (!count) return;
            (by_iterations ? setting.iterations : setting.substeps) = *count;
            if (!filter_.accepts(case_name(*p.problem, p.sweep.size, setting))) return;
            ++case_number_, ++case_count_;
            if (!run_setting(p, setting, summary)) return;
        }
    }

    void measure(const PlannedSweep& p, const Setting& setting, double work) {
        if (request_.stopped()) throw Stopped{};
        const double start = now(), before = reference_seconds_;
        results_.push_back(
            run_case(device_, *p.problem, p.sweep.size, setting, references_, [this] { return request_.stopped(); }));
        store_.add(results_.back());
        budget_.done(work, now() - start - (reference_seconds_ - before));
        const CaseResult& result = results_.back();
        const auto error = result.metrics.find(p.problem->metric);
        request_.say(fmt::format("{}/{} {}: {:.3g} ms/frame, {}; {:.1f} s, ETA {}", case_number_, case_count_,
                                 result.name, case_milliseconds(result),
                                 error == result.metrics.end()
                                     ? std::string(result.diverged ? "diverged" : "no reference")
                                     : fmt::format("{} {:.2e}", p.problem->metric, error->second),
                                 result.seconds, duration_text(budget_.seconds_left())));
    }

    /// The reference is farther off than what is wanted.
    static bool cannot_tell(const Problem& problem, const Target& target, const CaseResult& result) {
        const auto own = result.metrics.find("reference_error");
        return target.metric == problem.metric && own != result.metrics.end() && own->second > target.limit;
    }

    static bool is_at_floor(const Problem& problem, const CaseResult& result) {
        const auto error = result.metrics.find(problem.metric), own = result.metrics.find("reference_error");
        const double floor = std::max(problem.floor, own == result.metrics.end() ? 0 : 1.5 * own->second);
        return error != result.metrics.end() && error->second < floor;
    }

    const AccuracyRequest& request_;
    CaseFilter filter_;
    Device device_;
    std::vector<PlannedSweep> plan_;
    ResultStore store_;
    References references_;
    Budget budget_;
    std::vector<CaseResult> results_;
    std::map<std::string, std::string> notes_;
    std::size_t case_number_ = 0, case_count_ = 0;
    double reference_start_ = 0, reference_before_ = 0, reference_seconds_ = 0, last_line_ = 0;
};

void write_files(AccuracyRequest request, const Report& report, const std::vector<Problem>& problems) {
    if (!request.scene.empty()) {
        const fs::path folder = request.folder;
        if (request.json.empty()) request.json = folder / "accuracy.json";
        if (request.csv.empty()) request.csv = folder / "accuracy.csv";
        if (request.svg.empty()) request.svg = folder;
    }
    if (!request.json.empty()) write_file(request.json, report_json(report));
    if (!request.csv.empty()) write_file(request.csv, report_csv(report));
    if (request.svg.empty()) return;
    make_folder(request.svg);
    for (const auto& [name, plot] : report_plots(report, problems))
        write_file(fs::path(request.svg) / name, plot::svg_of(plot));
}

/// The benchmark's, or the user's scene, whose reference tells `run` what it does once there is one.
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

AccuracySummary run_accuracy(const AccuracyRequest& request) {
    std::optional<UserScene> user;
    if (!request.scene.empty()) user = read_user_scene(request.scene, request.overrides, request.frames);
    const CaseFilter filter(request.filter);
    if (!user) planned(filter, all_problems(request.is_short));  // a filter that matches nothing needs no device
    const Device device(request.device, validation_if(request.validate));
    const auto current = std::make_shared<AccuracyRun*>();
    const std::vector<Problem> problems = problems_of(request, user, device, current);
    std::vector<PlannedSweep> plan = planned(filter, problems);
    make_folder(request.folder);
    AccuracySummary summary;
    AccuracyRun run(request, device, filter, std::move(plan));
    *current = &run;
    try {
        run.run(summary);
    } catch (const Stopped&) {
        summary.stopped = true;
        return summary;
    }
    const DeviceInfo& info = device.info();
    Report report;
    report.program_version = program_version();
    report.created = utc_timestamp();
    report.device = info.name;
    report.driver = info.driver + " " + info.driver_version;
    report.is_short = request.is_short;
    report.complete = summary.left_out_count == 0;
    report.results = run.results();
    report.notes = run.notes();
    for (const Problem& problem : problems)
        if (problem.timed) report.targets[problem.name] = problem.targets;
    evaluate(report);
    write_files(request, report, problems);
    summary.text = report_text(report, problems);
    summary.missed_count = missed_count(report);
    summary.validation_count = device.validation_count();
    return summary;
}

}  // namespace drape::bench
