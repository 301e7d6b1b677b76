// Sheets of 1 m with wave speed 100 m/s and shear a tenth of stretch, the model of docs/solvers.md, against the
// converged double-precision network: swing, drum, drape, strip, the hanging sheet, the swing's energy.
#include <algorithm>
#include <cmath>

#include "bench/problem.h"
#include "reference/model_scenes.h"

namespace drape::bench {

namespace {

using namespace model_scenes;

constexpr double wave_speed = 100;
constexpr std::uint32_t largest_with_reference = 256;  // links; the reference's cost grows with their cube

double strain(const NetworkSpring& spring, std::span<const Vec3> x) {
    const Vec3 &a = x[spring.first], &b = x[spring.second];
    return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) / spring.rest_length - 1;
}

/// Means over the sampled times of RMS values over the stretch springs: the strain, the solver's stretch
/// error (strain that the tension it applied does not account for; its worst time and worst spring too), the
/// reference's strain, and the difference from it.
class StretchMeans {
  public:
    void add(const SpringNetwork& network, const Sample& sample, std::span<const Vec3> exact) {
        double own = 0, reference = 0, difference = 0, count = 0;
        for (const NetworkSpring& spring : network.springs) {
            if (spring.family != SpringFamily::stretch) continue;
            const double mine = strain(spring, sample.position),
                         true_strain = exact.empty() ? 0 : strain(spring, exact);
            own += mine * mine;
            reference += true_strain * true_strain;
            difference += (mine - true_strain) * (mine - true_strain);
            ++count;
        }
        own_ += std::sqrt(own / count);
        reference_ += std::sqrt(reference / count);
        difference_ += std::sqrt(difference / count);
        error_ += sample.statistics.stretch_error_rms;
        worst_error_ = std::max(worst_error_, sample.statistics.stretch_error_rms);
        worst_spring_ = std::max(worst_spring_, sample.statistics.stretch_error_max);
        ++times_;
    }
    void put(Metrics& metrics, bool with_reference) const {
        metrics["stretch_rms"] = own_ / times_;
        metrics["stretch_error"] = error_ / times_;
        metrics["worst_stretch_error"] = worst_error_;
        metrics["worst_spring"] = worst_spring_;
        if (!with_reference) return;
        metrics["stretch_rms_reference"] = reference_ / times_;
        metrics["strain_difference"] = difference_ / times_;
    }

  private:
    double own_ = 0, error_ = 0, worst_error_ = 0, worst_spring_ = 0, reference_ = 0, difference_ = 0, times_ = 0;
};

/// Errors of a motion at every sample after frame 0: strain over all of them, positions at 0.25 and 0.5 s.
Metrics motion_errors(const Recording& run, References& references) {
    const SpringNetwork network(run.scene, 0);
    const bool with_reference = run.scene.cloths[0].grid[1] - 1 <= largest_with_reference;
    std::vector<double> times;
    for (const Sample& sample : run.samples)
        if (sample.frame > 0) times.push_back(sample.frame / run.scene.time.fps);
    const ReferenceRun* reference = with_reference ? &references.motion(network, times) : nullptr;
    Metrics metrics;
    StretchMeans stretch;
    for (std::size_t k = 1; k < run.samples.size(); ++k) {
        const Sample& sample = run.samples[k];
        if (!reference) {
            stretch.add(network, sample, {});
            continue;
        }
        const std::vector<Vec3>& exact = reference->states[k - 1].position;
        stretch.add(network, sample, exact);
        const double rms = position_rms(sample.position, exact);
        if (sample.frame != 15 && sample.frame != 30) continue;
        metrics[sample.frame == 15 ? "position_rms_0.25" : "position_rms_0.5"] = rms;
        metrics["position_rms"] = std::max(metrics["position_rms"], rms);
        metrics["reference_error"] = std::max(metrics["reference_error"], reference->error_estimate[k - 1]);
    }
    stretch.put(metrics, with_reference);
    return metrics;
}

Metrics static_errors(const Recording& run, References& references) {
    const SpringNetwork network(run.scene, 0);
    const ReferenceRun& reference = references.equilibrium(network);
    const std::vector<Vec3>& x = run.samples.back().position;
    Metrics metrics{{"position_rms", position_rms(x, reference.states[0].position)},
                    {"reference_error", reference.error_estimate[0]}};
    StretchMeans stretch;
    stretch.add(network, run.samples.back(), reference.states[0].position);
    stretch.put(metrics, true);
    return metrics;
}

/// 1 % as a mean over the times and at the worst one are two targets.
std::vector<Target> sheet_targets() {
    return {{"stretch_error", 0.01}, {"worst_stretch_error", 0.01}, {"position_rms", 1e-3}};
}

Problem motion(const char* name, const char* title, std::function<SceneDescription(std::uint32_t)> scene) {
    Problem problem{.name = name, .title = title, .metric = "position_rms", .unit = "m", .floor = 5e-7, .timed = true};
    problem.record_every = 3;
    problem.targets = sheet_targets();
    problem.scene = [scene = std::move(scene)](std::uint32_t size, const Setting&) {
        SceneDescription result = scene(size);
        result.time.frame_count = 31;
        return result;
    };
    problem.evaluate = motion_errors;
    return problem;
}

/// Three seconds with damping 6/s: everything that moves has died away to 1e-4.
Problem statics(const char* name, const char* title, std::function<SceneDescription(std::uint32_t)> scene) {
    Problem problem{.name = name, .title = title, .metric = "position_rms", .unit = "m", .floor = 5e-7, .timed = true};
    problem.record_every = 180;
    problem.targets = sheet_targets();
    problem.scene = [scene = std::move(scene)](std::uint32_t size, const Setting&) {
        SceneDescription result = scene(size);
        result.time.frame_count = 181;
        result.cloths[0].damping = 6;
        return result;
    };
    problem.evaluate = static_errors;
    return problem;
}

SceneDescription drum(std::uint32_t links) {
    SceneDescription scene = swing(links, wave_speed, 90);
    scene.cloths[0].pins = {pin_box(0, 0, links, 0), pin_box(0, links, links, links), pin_box(0, 1, 0, links - 1),
                            pin_box(links, 1, links, links - 1)};
    return scene;
}

SceneDescription drape(std::uint32_t links) {
    SceneDescription scene = swing(links, wave_speed, 90);
    scene.cloths[0].pins = {pin_box(0, 0, 0, 0), pin_box(links, 0, links, 0)};
    return scene;
}

/// Eight cells wide.
SceneDescription strip(std::uint32_t links) {
    SceneDescription scene = sheet(9, links + 1, 8.0 / links, 1, 1);
    Cloth& cloth = scene.cloths[0];
    set_wave_speed(cloth, wave_speed);
    cloth.pins = {pin_top(cloth)};
    return scene;
}

/// Energy above the equilibrium's that is left after 10 s without damping, over that at the start: the mean
/// of a whole swing (100 frames), since the kinetic energy is that of the middle of the last substep. Springs
/// that a solver leaves far too long hold more energy than the start had; motion_kept, the kinetic energy of
/// the last swing over that of the first, tells of those.
Metrics kept_energy(const Recording& run, References& references) {
    const SpringNetwork network(run.scene, 0);
    const double least = network.potential_energy(references.equilibrium(network).states[0].position);
    const auto energy = [&](const Sample& sample) {
        return sample.statistics.kinetic_energy + network.potential_energy(sample.position) - least;
    };
    constexpr std::size_t swing_frames = 100;
    double sum = 0, motion_sum = 0, first_motion_sum = 0;
    for (std::size_t k = run.samples.size() - swing_frames; k < run.samples.size(); ++k) {
        sum += energy(run.samples[k]);
        motion_sum += run.samples[k].statistics.kinetic_energy;
    }
    for (std::size_t k = 1; k <= swing_frames; ++k) first_motion_sum += run.samples[k].statistics.kinetic_energy;
    const double start = network.potential_energy(run.samples.front().position) - least;
    const double kept = sum / swing_frames / start;
    return {
        {"energy_kept", kept}, {"energy_error", std::abs(1 - kept)}, {"motion_kept", motion_sum / first_motion_sum}};
}

Problem swing_energy(bool is_short) {
    Problem problem{.name = "swing energy",
                    .title = "Energy of the undamped swing after 10 s",
                    .metric = "energy_error",
                    .unit = "1"};
    problem.scene = [](std::uint32_t size, const Setting&) {
        SceneDescription scene = swing(size, wave_speed, 30);
        scene.time.frame_count = 601;
        return scene;
    };
    problem.evaluate = kept_energy;
    if (is_short) {
        problem.sweeps = {{16, substep_settings(SolverMethod::relax, {1, 10}), 3},
                          {16, substep_settings(SolverMethod::line, {4, 10}), 3},
                          {16, explicit_settings(16, {2.65}), 3}};
    } else {
        problem.sweeps = {{32, substep_settings(SolverMethod::relax, {1, 4, 10, 20, 40, 80}), 3},
                          {32, substep_settings(SolverMethod::line, {4, 8, 20, 40}), 3},
                          {32, explicit_settings(32, {0.5, 1, 2, 2.65, 3.2}), 3}};
    }
    return problem;
}

}  // namespace

std::vector<Problem> sheet_problems(bool is_short) {
    std::vector<Problem> problems = {
        motion("swing", "Swing from 30 degrees", [](std::uint32_t n) { return swing(n, wave_speed, 30); }),
        motion("drum", "Drum: all edges held", drum), motion("drape", "Drape from two corners", drape),
        statics("strip", "Hanging strip", strip),
        statics("hanging sheet", "Hanging sheet", [](std::uint32_t n) { return swing(n, wave_speed, 0); })};
    for (std::size_t k = 0; k < problems.size(); ++k) {
        const bool is_sheet = problems[k].name == "hanging sheet", is_drape = problems[k].name == "drape";
        if (is_short) {
            // Statics take three seconds of motion; the strip stands for both.
            if (problems[k].name == "strip")
                problems[k].sweeps = {{16, explicit_settings(16, {1, 2.61}), 3},
                                      {16, substep_settings(SolverMethod::line, {4, 20}), 3},
                                      {16, substep_settings(SolverMethod::relax, {5, 20}), 3}};
            else if (!is_sheet)
                problems[k].sweeps = short_sweeps(32, static_cast<int>(k));
            continue;
        }
        // The claims are about 64, 128 and 256.
        const int rank = is_drape ? 2 : static_cast<int>(k);
        for (const auto& [links, importance] : {std::pair{128u, 0}, {64u, 0}, {256u, 3}, {32u, 6}, {512u, 9}}) {
            if (is_sheet && links > 64) continue;
            const std::vector<Sweep> sweeps = work_sweeps(links, importance + rank, importance + rank + 4);
            problems[k].sweeps.insert(problems[k].sweeps.end(), sweeps.begin(), sweeps.end());
        }
    }
    problems.push_back(swing_energy(is_short));
    return problems;
}

}  // namespace drape::bench
