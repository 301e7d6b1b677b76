#include "bench/speed.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "bench/measure.h"
#include "bench/speed_measure.h"
#include "bench/speed_report.h"
#include "output/atomic_file.h"
#include "output/manifest.h"
#include "run/run.h"

namespace drape::bench {

namespace {

std::vector<SpeedCase> chosen(const SpeedRequest& request) {
    const CaseFilter filter(request.filter);
    std::vector<SpeedCase> cases = request.tune ? schedule_cases(request.is_short) : speed_cases(request.is_short);
    std::erase_if(cases, [&](const SpeedCase& each) { return !filter.accepts(each.name); });
    if (cases.empty()) filter.refuse(request.tune ? "schedule/line/256" : "line/256");
    return cases;
}

class SpeedRun {
  public:
    SpeedRun(const SpeedRequest& request, std::vector<SpeedCase> cases)
        : request_(request),
          cases_(std::move(cases)),
          effort_(request.is_short ? SpeedEffort{5, 0.03} : SpeedEffort{}),
          devices_(request),
          budget_(request.budget_minutes, 1) {
        for (const SpeedCase& each : cases_) budget_.left(speed_work(each, effort_));
    }

    /// Throws Stopped.
    void run(SpeedSummary& summary) {
        for (std::size_t k = 0; k < cases_.size(); ++k) {
            const double work = speed_work(cases_[k], effort_), before = budget_.spent();
            budget_.left_out(work);
            if (request_.stopped()) throw Stopped{};
            if (!budget_.allows(work) || !measure(cases_[k])) {
                ++summary.left_out_count;
                continue;
            }
            budget_.done(work, budget_.spent() - before);
            ++summary.measured_count;
            request_.say(fmt::format("{}/{} {}: {:.1f} s, ETA {}", k + 1, cases_.size(), cases_[k].name,
                                     budget_.spent() - before, duration_text(budget_.seconds_left())));
        }
        summary.validation_count = devices_.validation_count();
    }

    SpeedReport report(bool complete) {
        const Device& device = devices_.of(scene_of({.size = 64}), true);
        const DeviceInfo& info = device.info();
        return {program_version(),
                utc_timestamp(),
                info.name,
                info.driver + " " + info.driver_version,
                static_cast<int>(std::thread::hardware_concurrency()),
                device.copy_bandwidth(),
                request_.is_short,
                complete,
                results_};
    }

  private:
    /// Whether it could be.
    bool measure(const SpeedCase& each) {
        switch (each.kind) {
            case SpeedKind::solve:
                results_.push_back(measure_solver(devices_, each, effort_, request_));
                return true;
            case SpeedKind::picture:
                results_.push_back(measure_picture(devices_, each, effort_, request_));
                return true;
            case SpeedKind::schedule:
                results_.push_back(measure_schedules(devices_, each, effort_, request_));
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
    Budget budget_;
    std::vector<SpeedResult> results_;
};

}  // namespace

SpeedSummary run_speed(const SpeedRequest& request) {
    SpeedRun run(request, chosen(request));
    SpeedSummary summary;
    try {
        run.run(summary);
    } catch (const Stopped&) {
        summary.stopped = true;
        return summary;
    }
    const SpeedReport report = run.report(summary.left_out_count == 0);
    if (!request.json.empty()) write_file(request.json, speed_json(report));
    if (!request.csv.empty()) write_file(request.csv, speed_csv(report));
    if (!request.svg.empty()) {
        make_folder(request.svg);
        for (const auto& [name, plot] : speed_plots(report))
            write_file(std::filesystem::path(request.svg) / name, plot::svg_of(plot));
    }
    summary.text = speed_text(report);
    return summary;
}

}  // namespace drape::bench
