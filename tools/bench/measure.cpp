#include "bench/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numeric>

#include "cloth/frame_inputs.h"
#include "cloth/frame_steps.h"
#include "drape/simulation.h"
#include "output/manifest.h"
#include "run/run.h"
#include "solver/cloth_solver.h"
#include "solver/kernel_choice.h"
#include "spirv_modules.h"

namespace drape::bench {

namespace {

/// Raise when the same run would be measured differently, so that kept results are not mixed with new ones.
constexpr int measuring_version = 4;

constexpr int repetition_count = 5;
constexpr double repetition_seconds = 0.6;   // about as long is measured at a time
constexpr std::uint32_t warm_up_frames = 2;  // compile shaders, fill caches

SceneDescription scene_of(const Problem& problem, std::uint32_t size, const Setting& setting) {
    SceneDescription scene = problem.scene(size, setting);
    scene.solver.method = setting.method;
    scene.solver.substeps = setting.substeps;
    scene.solver.iterations = setting.iterations;
    scene.solver.strain_damping = problem.strain_damping;
    return scene;
}

StrainStatistics joined_strains(const StrainStatistics& a, const StrainStatistics& b) {
    if (a.spring_count == 0) return b;
    if (b.spring_count == 0) return a;
    const double first = a.spring_count, second = b.spring_count;
    return {a.spring_count + b.spring_count,
            std::sqrt((first * a.rms * a.rms + second * b.rms * b.rms) / (first + second)),
            std::max(a.largest, b.largest), std::min(a.smallest, b.smallest)};
}

/// Steps that read and write every particle; the others touch a few, or only look.
double passes_of(const SimulationModel& model) {
    double passes = 0;
    for (const Step& step : frame_steps(model)) switch (step.kind) {
            case StepKind::release:
            case StepKind::pin:
            case StepKind::residual:
            case StepKind::decide:
            case StepKind::nested:
            case StepKind::advance:
                break;
            default:
                ++passes;
        }
    return passes;
}

double simulate_ms(const std::vector<StageTime>& timings) {
    double sum = 0;
    for (const StageTime& timing : timings)
        if (timing.name == "simulate") sum += timing.milliseconds;
    return sum;
}

struct RecordedRun {
    std::vector<Sample> samples;
    std::vector<double> device_ms;
    bool diverged = false;
    double wall_ms = 0;  ///< per frame
};

double sum_of(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

RecordedRun record(const Device& device, const Problem& problem, const SceneDescription& scene,
                   const std::function<bool()>& stop) {
    SimulationOptions options;
    options.keep_promises = false;
    Simulation simulation(scene, options, device);
    RecordedRun run;
    const std::uint32_t last = scene.time.frame_count - 1;
    const auto wanted = [&](std::uint32_t frame) { return frame == last || frame % problem.record_every == 0; };
    const Stopwatch watch;
    const auto finished = [&](const FinishedFrame& frame) {
        Sample sample{frame.frame, {}, joined(frame.statistics), frame.effort};
        run.diverged = run.diverged || sample.statistics.non_finite_count > 0;
        for (const std::span<const float> cloth : frame.positions)
            for (std::size_t i = 0; i + 3 < cloth.size(); i += 4)
                sample.position.push_back({cloth[i], cloth[i + 1], cloth[i + 2]});
        run.samples.push_back(std::move(sample));
        if (frame.frame > warm_up_frames) run.device_ms.push_back(simulate_ms(frame.timings));
    };
    const bool complete = simulation.run(last, wanted, finished, [&] { return run.diverged || stop(); });
    if (!complete && !run.diverged) throw Stopped{};
    run.wall_ms = 1000 * watch.seconds() / std::max(last, 1u);
    return run;
}

/// A repetition's frames on the device: frames of a fixed setting do the same work; those of `auto` need not.
double typical(const std::vector<double>& milliseconds, bool frames_differ) {
    if (milliseconds.empty()) return 0;
    return frames_differ ? sum_of(milliseconds) / static_cast<double>(milliseconds.size())
                         : timing_of(milliseconds).median;
}

/// Repetitions without statistics and readbacks, of as many frames as a repetition's time allows; of `auto` all frames.
void measure_time(const Device& device, const SceneDescription& scene, const std::function<bool()>& stop,
                  double estimate_ms, CaseResult& result) {
    const bool frames_differ = scene.solver.method == SolverMethod::automatic;
    const auto all_frames = static_cast<double>(std::max(scene.time.frame_count - 1, 5u));
    const double affordable = 1000 * repetition_seconds / std::max(estimate_ms, 1e-3);
    const auto frames =
        static_cast<std::uint32_t>(frames_differ ? all_frames : std::clamp(affordable, 5.0, all_frames));
    const bool is_long = frames * estimate_ms > 5000 * repetition_seconds;
    SimulationOptions options;
    options.positions = options.statistics = options.keep_promises = false;
    std::vector<double> on_device, on_wall;
    for (int repetition = 0; repetition < (is_long ? 2 : repetition_count); ++repetition) {
        Simulation simulation(scene, options, device);
        std::vector<double> device_ms;
        Stopwatch watch;
        const bool complete = simulation.run(
            frames + warm_up_frames, [](std::uint32_t frame) { return frame > 0; },
            [&](const FinishedFrame& frame) {
                if (frame.frame == warm_up_frames) watch = Stopwatch();
                if (frame.frame > warm_up_frames) device_ms.push_back(simulate_ms(frame.timings));
            },
            stop);
        if (!complete) throw Stopped{};
        on_wall.push_back(1000 * watch.seconds() / frames);
        on_device.push_back(typical(device_ms, frames_differ));
    }
    result.device = timing_of(on_device);
    result.wall = timing_of(on_wall);
}

template <class T>
std::string hash_of(const std::vector<T>& values) {
    return xxh3_128_hex(std::as_bytes(std::span(values)));
}
template <class T>
std::string hash_of(const T& value) {
    return xxh3_128_hex(std::as_bytes(std::span(&value, 1)));
}

/// Everything that the device is given of a model's frames.
std::vector<std::string> hashes_of(const SimulationModel& model) {
    std::vector<std::string> parts;
    for (const ClothModel& cloth : model.cloths)
        parts.insert(parts.end(), {hash_of(cloth.position), hash_of(cloth.start_displacement()),
                                   hash_of(cloth.grid.cells()), hash_of(cloth.pinned), hash_of(cloth.tethers),
                                   hash_of(bytes_of(cloth.scheme)), hash_of(cloth.wind), hash_of(cloth.collision),
                                   hash_of(cloth.residual), hash_of(model.iteration_limit())});
    std::string order;
    for (const Step& step : frame_steps(model))
        order += fmt::format("{} {} {} {}{} ", static_cast<int>(step.kind), step.cloth, step.substep, step.last ? 1 : 0,
                             step.conditional ? 1 : 0);
    parts.push_back(order);
    for (std::uint32_t frame = 1; frame < model.scene.time.frame_count; ++frame) {
        const FrameInputs inputs = frame_inputs(model, frame);
        parts.push_back(hash_of(inputs.wind));
        for (const auto& colliders : inputs.colliders) parts.push_back(hash_of(colliders));
        for (const auto& pins : inputs.pins) parts.push_back(hash_of(pins));
    }
    return parts;
}

/// `auto` chooses for the device that is measured.
SimulationModel model_of(const DeviceInfo& device, const Problem& problem, std::uint32_t size, const Setting& setting) {
    return SimulationModel(scene_of(problem, size, setting), {.device = device_kind(device)});
}

/// A hash of the program itself, which changes without a new version where what `auto` decides does.
const std::string& program_hash() {
    static const std::string hash = [] {
        std::ifstream file("/proc/self/exe", std::ios::binary);
        return xxh3_128_hex(std::string(std::istreambuf_iterator<char>(file), {}));
    }();
    return hash;
}

}  // namespace

std::string shaders_hash() {
    std::vector<std::string> parts;
    for (const SpirvModule& module : spirv_modules()) parts.push_back(xxh3_128_hex(std::as_bytes(module.words)));
    return run_key(parts);
}

ClothStatistics joined(std::span<const ClothStatistics> cloths) {
    ClothStatistics all = cloths[0];
    for (const ClothStatistics& cloth : cloths.subspan(1)) {
        const double mass = all.mass + cloth.mass;
        for (std::size_t k = 0; k < 3; ++k)
            all.center_of_mass[k] =
                (all.mass * all.center_of_mass[k] + cloth.mass * cloth.center_of_mass[k]) / std::max(mass, 1e-300);
        all.mass = mass;
        all.stretch = joined_strains(all.stretch, cloth.stretch);
        all.shear = joined_strains(all.shear, cloth.shear);
        all.stretch_error_rms = std::max(all.stretch_error_rms, cloth.stretch_error_rms);
        all.stretch_error_max = std::max(all.stretch_error_max, cloth.stretch_error_max);
        all.kinetic_energy += cloth.kinetic_energy;
        all.potential_energy += cloth.potential_energy;
        all.elastic_energy += cloth.elastic_energy;
        all.largest_distance = std::max(all.largest_distance, cloth.largest_distance);
        all.largest_speed = std::max(all.largest_speed, cloth.largest_speed);
        all.non_finite_count += cloth.non_finite_count;
        if (cloth.penetration) all.penetration = std::max(all.penetration.value_or(0), *cloth.penetration);
        if (cloth.iteration_count) all.iteration_count = all.iteration_count.value_or(0) + *cloth.iteration_count;
    }
    return all;
}

void put_substeps(std::span<const Sample> samples, Metrics& metrics) {
    double sum = 0, most = 0, count = 0;
    for (const Sample& sample : samples) {
        if (sample.frame == 0) continue;
        sum += sample.effort.substeps;
        most = std::max<double>(most, sample.effort.substeps);
        ++count;
    }
    metrics["substeps_used"] = count > 0 ? sum / count : 0;
    metrics["substeps_most"] = most;
}

std::string case_name(const Problem& problem, std::uint32_t size, const Setting& setting) {
    return fmt::format("{}/{}/{}/{}", problem.name, size, named(setting.method).name, setting_name(setting));
}

std::string case_key(const DeviceInfo& device, const Problem& problem, std::uint32_t size, const Setting& setting) {
    const SimulationModel model = model_of(device, problem, size, setting);
    std::vector<std::string> parts{
        program_version(),     fmt::format("{}", measuring_version), device.uuid_text(), device.driver,
        device.driver_version, case_name(problem, size, setting),    problem.identity};
    const std::vector<std::string> given = hashes_of(model);
    parts.insert(parts.end(), given.begin(), given.end());
    parts.push_back(fmt::format("{} frames, {}/s, every {}", model.scene.time.frame_count, model.scene.time.fps,
                                problem.record_every));
    parts.push_back(shaders_hash());
    if (setting.method == SolverMethod::automatic) parts.push_back(program_hash());
    return run_key(parts);
}

double case_work(const DeviceInfo& device, const Problem& problem, std::uint32_t size, const Setting& setting) {
    const SceneDescription scene = scene_of(problem, size, setting);
    double particle_count = 0;
    for (const Cloth& cloth : scene.cloths) particle_count += double(cloth.grid[0]) * cloth.grid[1];
    const SolverSettings solver = choose_solver(scene, device_kind(device)).settings;
    const Method& method = row_of(solver.method);
    // With a tolerance few of the iterations are run.
    const double iterations = solver.tolerance > 0 ? std::min(solver.iterations, 2u) : solver.iterations;
    const double passes = solver.substeps * (method.passes_per_substep + method.passes_per_iteration * iterations);
    constexpr double dispatch_share = 5000;  // particles whose pass takes as long as an empty dispatch
    const double frames = scene.time.frame_count + (problem.timed ? repetition_count * 10.0 : 0);
    return passes * frames * (particle_count + dispatch_share * static_cast<double>(scene.cloths.size()));
}

CaseResult run_case(const Device& device, const Problem& problem, std::uint32_t size, const Setting& setting,
                    References& references, const std::function<bool()>& stop) {
    const Stopwatch watch;
    const SimulationModel model = model_of(device.info(), problem, size, setting);
    CaseResult result;
    result.name = case_name(problem, size, setting);
    result.key = case_key(device.info(), problem, size, setting);
    result.problem = problem.name;
    result.size = size;
    result.method = setting.method;
    result.substeps = setting.substeps;
    result.iterations = setting.iterations;
    result.passes = setting.method == SolverMethod::automatic ? 0 : passes_of(model);
    result.stiffness_share = 1;
    for (const ClothModel& cloth : model.cloths)
        for (std::size_t axis = 0; axis < 2; ++axis)
            if (cloth.stiffness_constant.spring[axis] > 0 && std::isfinite(cloth.scheme.used_stiffness[axis]))
                result.stiffness_share = std::min(
                    result.stiffness_share, cloth.scheme.used_stiffness[axis] / cloth.stiffness_constant.spring[axis]);

    const SceneDescription scene = scene_of(problem, size, setting);
    RecordedRun run = record(device, problem, scene, stop);
    result.device = timing_of({typical(run.device_ms, setting.method == SolverMethod::automatic)});
    result.wall = timing_of({run.wall_ms});
    result.diverged = run.diverged;
    if (!run.diverged) {
        if (problem.timed) measure_time(device, scene, stop, run.wall_ms, result);
        result.metrics = problem.evaluate({model.scene, std::move(run.samples)}, references);
        for (const auto& [name, value] : result.metrics) result.diverged = result.diverged || !std::isfinite(value);
        if (result.diverged) result.metrics.clear();
    }
    result.seconds = watch.seconds();
    return result;
}

}  // namespace drape::bench
