#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "bench/benchmarks.h"
#include "bench/speed_measure.h"
#include "bench/speed_report.h"
#include "run/run.h"

namespace drape::bench {

namespace {

class SpeedRun {
  public:
    SpeedRun(const SpeedRequest& request, std::vector<SpeedCase> cases)
        : request_(request),
          cases_(std::move(cases)),
          effort_(request.is_short ? SpeedEffort{5, 0.03} : SpeedEffort{}),
          devices_(request),
          loop_(request, request.budget_minutes, 1) {
        for (const SpeedCase& each : cases_) loop_.plan(speed_work(each, effort_));
    }

    /// Throws Stopped.
    void run() {
        for (const SpeedCase& each : cases_) {
            if (!loop_.begin(speed_work(each, effort_))) continue;
            if (measure(each))
                loop_.done(speed_work(each, effort_), each.name);
            else
                loop_.leave_out();
        }
    }

    SpeedReport report() {
        const Device& device = devices_.of(scene_of({.size = 64}), true);
        return {report_head(device.info(), request_.is_short, loop_.summary().left_out_count == 0),
                static_cast<int>(std::thread::hardware_concurrency()), device.copy_bandwidth(), results_};
    }

    BenchSummary summary() const {
        BenchSummary summary = loop_.summary();
        summary.validation_count = devices_.validation_count();
        return summary;
    }

  private:
    /// Measures a case. Returns whether it could be measured.
    bool measure(const SpeedCase& each) {
        switch (each.kind) {
            case SpeedKind::solve:
                results_.push_back(measure_solver(devices_, each, effort_, request_));
                return true;
            case SpeedKind::picture:
                results_.push_back(measure_picture(devices_, each, effort_, request_));
                return true;
            case SpeedKind::kernels:
                results_.push_back(measure_kernels(devices_, each, effort_, request_));
                return true;
            case SpeedKind::ensemble:
                results_.push_back(measure_ensemble(devices_, each, effort_, request_));
                return true;
            case SpeedKind::skip:
                return measure_skip_of(each);
            case SpeedKind::start:
                results_.push_back(measure_start(each, effort_, request_));
                return true;
        }
        return false;
    }

    bool measure_skip_of(const SpeedCase& each) {
        const auto skip = std::ranges::find(skip_cases(), each.name, &SkipCase::name);
        const std::filesystem::path path = std::filesystem::path(request_.scenes) / skip->scene;
        if (!std::filesystem::exists(path)) return false;
        SceneRequest asked;
        asked.path = path.string();
        const SceneDescription scene = asked_scene(asked);
        results_.push_back(measure_skip(devices_, each, *skip, scene, effort_, request_));
        return true;
    }

    const SpeedRequest& request_;
    std::vector<SpeedCase> cases_;
    SpeedEffort effort_;
    SpeedDevices devices_;
    CaseLoop loop_;
    std::vector<SpeedResult> results_;
};

}  // namespace

BenchSummary run_speed(const SpeedRequest& request) {
    SpeedRun run(request, CaseFilter(request.filter)
                              .chosen(request.tune ? kernel_cases(request.is_short) : speed_cases(request.is_short),
                                      request.tune ? "kernels/line/256" : "line/256"));
    run.run();
    const SpeedReport report = run.report();
    BenchSummary summary = run.summary();
    write_results(request, speed_json(report), speed_csv(report), plot::svg_of(speed_plots(report)));
    summary.text = speed_text(report);
    return summary;
}

}  // namespace drape::bench
