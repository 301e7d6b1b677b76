#include "run/verify.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "control/motion_watch.h"
#include "run/scene_oracles.h"
#include "simulation/frame_checks.h"
#include "solver/kernel_choice.h"
#include "vulkan/device.h"
#include "vulkan/instance.h"

namespace drape::verify {

namespace {

/// The largest value in any frame and cloth, and its place.
struct Worst {
    double value = 0;
    std::uint32_t frame = 0;
    std::string cloth;
    bool known = false;

    void see(double now, std::uint32_t at, const std::string& name) {
        if (known && !(now > value)) return;
        *this = {now, at, name, true};
    }
    std::string place() const { return fmt::format("frame {}, cloth '{}'", frame, cloth); }
};

/// Keeps the values of frames that are judged in the end.
class FrameWatch {
  public:
    explicit FrameWatch(const SimulationModel& model) : motion(model), model_(model), watch_(model) {}

    void see(const FinishedFrame& frame) {
        ++count_;
        motion.look(frame.frame, frame.effort);
        for (std::size_t cloth = 0; cloth < frame.statistics.size(); ++cloth) {
            const ClothStatistics& statistics = frame.statistics[cloth];
            const std::string& name = model_.cloths[cloth].name;
            if (statistics.stretch.spring_count > 0) {
                stretch.see(statistics.stretch.rms, frame.frame, name);
                error.see(statistics.stretch_error_rms, frame.frame, name);
            }
            if (statistics.penetration) penetration.see(*statistics.penetration, frame.frame, name);
        }
        const auto failure = frame_failure(model_, watch_, frame);
        if (!failure) return;
        const bool tolerance = failure->kind == FrameFailure::Kind::tolerance;
        std::string& first = tolerance ? missed : nonsense;
        if (first.empty()) first = failure->reason;
        finite = finite && failure->kind != FrameFailure::Kind::not_finite;
    }
    std::uint32_t count() const { return count_; }

    Worst stretch, error, penetration;
    MotionWatch motion;
    std::string nonsense,
        missed;  ///< the first frame that is not plausible, and the first that misses its tolerance; empty: none
    bool finite = true;

  private:
    const SimulationModel& model_;
    Watch watch_;
    std::uint32_t count_ = 0;
};

Finding limit(const char* name, const char* what, const Worst& worst, double allowed, const char* unit) {
    if (!worst.known) return {name, true, fmt::format("{}: nothing to measure", what)};
    // `<=` is false for a NaN, so a NaN fails.
    return {name, worst.value <= allowed,
            fmt::format("{} at most {:.3g}{} ({}), allowed {:.3g}{}", what, worst.value, unit, worst.place(), allowed,
                        unit)};
}

/// Returns a judgement of the worst frame's position error, but for what of it is excused.
Finding motion_finding(const MotionWatch& watch) {
    const MotionWatch::Position& worst = *watch.worst();
    std::string text =
        fmt::format("positions at most about {:.2g} m from the exact motion (frame {}), allowed {:.2g} m", worst.error,
                    worst.frame, worst.allowed);
    if (worst.excused > 0)
        text += fmt::format(" beside {:.2g} m by which equally exact runs had parted", worst.excused);
    if (watch.parting()) text += fmt::format("; sensitive from frame {} on", watch.parting()->frame);
    return {"motion", worst.share() <= 1, text};
}

/// The limits that every run must keep.
std::vector<Finding> common_findings(const Request& request, const SimulationModel& model, const FrameWatch& frames) {
    std::vector<Finding> findings;
    findings.push_back({"plausible", frames.nonsense.empty(),
                        frames.nonsense.empty() ? fmt::format("{} frames are finite and plausible", frames.count())
                                                : frames.nonsense});
    const double tolerance = model.stretch_limits().rms;
    if (!frames.missed.empty())
        findings.push_back({"tolerance", false, frames.missed});
    else if (model.asked_tolerance > 0 || model.closed_loop())
        findings.push_back(limit("tolerance", "stretch error", frames.error,
                                 model.closed_loop() ? tolerance : model.asked_tolerance, ""));
    if (frames.motion.worst()) findings.push_back(motion_finding(frames.motion));
    if (request.stretch) findings.push_back(limit("limit/stretch", "RMS strain", frames.stretch, *request.stretch, ""));
    if (request.stretch_error)
        findings.push_back(limit("limit/stretch_error", "RMS stretch error", frames.error, *request.stretch_error, ""));
    if (request.penetration)
        findings.push_back(limit("limit/penetration", "penetration", frames.penetration, *request.penetration, " m"));
    return findings;
}

/// Returns "oracle/stretch", or "oracle/falls[2]" where the scene has several oracles of this kind.
std::string oracle_name(const SceneDescription& scene, std::size_t index) {
    const std::string& check = scene.oracles[index].check;
    const auto same = [&](const Oracle& oracle) { return oracle.check == check; };
    if (std::ranges::count_if(scene.oracles, same) == 1) return "oracle/" + check;
    return fmt::format("oracle/{}[{}]", check, index);
}

std::vector<Finding> oracle_findings(const SceneRun& run, bool finite) {
    std::vector<Finding> findings;
    for (std::size_t i = 0; i < run.scene.oracles.size(); ++i) {
        const std::string name = oracle_name(run.scene, i);
        if (!finite) {
            findings.push_back({name, false, "not judged: there are positions that are not finite"});
            continue;
        }
        const Verdict verdict = judge(run, run.scene.oracles[i]);
        findings.push_back({name, verdict.met, verdict.text});
    }
    return findings;
}

/// Oracles look at all frames at once, which must fit into memory together.
void check_memory(const SceneDescription& scene) {
    double particles = 0;
    for (const Cloth& cloth : scene.cloths) particles += static_cast<double>(cloth.grid[0]) * cloth.grid[1];
    const double wanted = particles * scene.time.frame_count * sizeof(glsl::vec4),
                 there = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    if (wanted > 0.75 * there)
        throw DeviceError(
            fmt::format("the positions of all frames, which oracles are judged by, take {:.1f} GiB; the "
                        "machine has {:.1f}: fewer frames (--set /time/frames=N) or no oracles (--set "
                        "/oracles=[]) would do",
                        wanted / (1 << 30), there / (1 << 30)));
}

void run_and_judge(const SceneDescription& scene, const Request& request, Report& report) {
    if (!scene.oracles.empty()) check_memory(scene);
    const vulkan::Instance instance({.validation = request.validate, .print_messages = true});
    const vulkan::Device device(instance, request.device);
    const SimulationModel model(scene, {.device = device_kind(device.info())});
    FrameWatch frames(model);
    const RunOptions options{.last = scene.time.frame_count - 1,
                             .positions = !scene.oracles.empty(),
                             .frame = [&](const FinishedFrame& frame) { frames.see(frame); },
                             .stop = [&] { return !frames.finite || (request.stop && request.stop()); }};
    const SceneRun run = run_frames(device, scene, model, options);
    report.frame_count = frames.count();
    report.stopped = frames.finite && report.frame_count < scene.time.frame_count;
    if (report.stopped) return;
    report.findings = common_findings(request, model, frames);
    std::ranges::move(oracle_findings(run, frames.finite), std::back_inserter(report.findings));
    if (!request.validate) return;
    const std::uint64_t messages = instance.validation_log().count();
    report.findings.push_back({"validation", messages == 0, fmt::format("{} validation messages", messages)});
}

}  // namespace

bool Report::met() const { return errors.empty() && !stopped && std::ranges::all_of(findings, &Finding::met); }

Report verify_scene(const std::string& path, const Request& request) {
    Report report;
    report.file = path;
    const auto start = std::chrono::steady_clock::now();
    SceneResult read = read_scene(path, request.overrides);
    report.errors = std::move(read.errors);
    report.unreadable = read.unreadable;
    if (read.scene) run_and_judge(*read.scene, request, report);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
}

}  // namespace drape::verify
