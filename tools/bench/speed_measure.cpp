#include "bench/speed_measure.h"

#include <algorithm>
#include <cmath>

#include "bench/measure.h"
#include "solver/cloth_solver.h"
#include "solver/kernel_choice.h"

namespace drape::bench {

namespace {

using Times = std::vector<double>;

int frames_of(double milliseconds, const SpeedEffort& effort) {
    return static_cast<int>(std::clamp(1e3 * effort.seconds / std::max(milliseconds, 1e-3), 2.0, 200.0));
}

/// Means of the rounds of what a side takes, ms per frame. Single frames would tell less: a host may hear of several at
/// once.
struct RoundMeans {
    std::string name;
    Times milliseconds{};
};

/// Drape's side: frames go on from round to round, each of which begins and ends with an idle device.
class DeviceSide {
  public:
    DeviceSide(const Device& device, const SceneDescription& scene, const SimulationOptions& options,
               const BenchRequest& request, std::uint32_t every = 1, std::uint32_t warm_up = SkipCase{}.warm_up)
        : request_(request), every_(every), simulation_(scene, options, device) {
        run(warm_up);
        means_.clear();
        run(2);
        estimate_ = means_[0].milliseconds[0];
        means_.clear();
    }

    void round(const SpeedEffort& effort) {
        const auto count = static_cast<std::uint32_t>(frames_of(estimate_, effort));
        run((count + every_ - 1) / every_ * every_);
    }
    /// "frame", "device" where there are timestamps, then the stages.
    const std::vector<RoundMeans>& means() const { return means_; }
    const Simulation& simulation() const { return simulation_; }

  private:
    void run(std::uint32_t count) {
        std::vector<StageTime> stages{{"device"}};
        const auto finished = [&](const FinishedFrame& frame) {
            for (const StageTime& time : frame.timings) {
                auto stage = std::ranges::find(stages, time.name, &StageTime::name);
                if (stage == stages.end()) stage = stages.insert(stage, {time.name});
                stage->milliseconds += time.milliseconds;
                stages[0].milliseconds += time.milliseconds;
            }
        };
        const Stopwatch watch;
        last_ += count;
        const bool complete = simulation_.run(
            last_, [this](std::uint32_t frame) { return frame % every_ == 0; }, finished,
            [this] { return request_.stopped(); });
        if (!complete) throw Stopped{};
        put("frame", 1e3 * watch.seconds() / count);
        if (stages.size() == 1) return;
        for (const StageTime& stage : stages) put(stage.name, stage.milliseconds / count);
    }
    void put(const std::string& name, double milliseconds) {
        auto found = std::ranges::find(means_, name, &RoundMeans::name);
        if (found == means_.end()) found = means_.insert(found, {name});
        found->milliseconds.push_back(milliseconds);
    }

    const BenchRequest& request_;
    std::uint32_t every_, last_ = 0;
    Simulation simulation_;
    std::vector<RoundMeans> means_;
    double estimate_ = 0;
};

SimulationOptions plain_options(bool draw) {
    SimulationOptions options;
    options.draw = draw;
    options.positions = options.statistics = options.keep_promises = false;
    return options;
}

void put(SpeedResult& result, const RoundMeans& means) {
    result.times.push_back({means.name, profile::statistics_of(means.milliseconds)});
}

void put_work(const Simulation& simulation, SpeedResult& result) {
    for (const PassWork& work : simulation.work()) {
        if (work.stage != "simulate") continue;
        result.bytes += static_cast<double>(work.bytes);
        result.flops += work.flops;
    }
}

}  // namespace

const Device& SpeedDevices::of(const SceneDescription& scene, bool draw) {
    std::optional<Device>& device = devices_[{prefers_calling_thread(scene), draw}];
    if (!device) device = Device::for_scene(scene, draw, request_.device, validation_if(request_.validate));
    return *device;
}

std::uint64_t SpeedDevices::validation_count() const {
    std::uint64_t count = 0;
    for (const auto& [kind, device] : devices_) count += device->validation_count();
    return count;
}

SpeedResult measure_solver(SpeedDevices& devices, const SpeedCase& speed_case, const SpeedEffort& effort,
                           const BenchRequest& request) {
    const SceneDescription scene = scene_of(speed_case);
    DeviceSide side(devices.of(scene, false), scene, plain_options(false), request);
    for (int round = 0; round < effort.rounds; ++round) side.round(effort);
    SpeedResult result{speed_case};
    for (const RoundMeans& means : side.means())
        if (means.name == "frame" || means.name == "device") put(result, means);
    put_work(side.simulation(), result);
    return result;
}

SpeedResult measure_picture(SpeedDevices& devices, const SpeedCase& speed_case, const SpeedEffort& effort,
                            const BenchRequest& request) {
    const SceneDescription scene = scene_of(speed_case);
    DeviceSide side(devices.of(scene, true), scene, plain_options(true), request);
    for (int round = 0; round < effort.rounds; ++round) side.round(effort);
    SpeedResult result{speed_case};
    for (const RoundMeans& means : side.means()) put(result, means);
    return result;
}

SpeedResult measure_kernels(SpeedDevices& devices, const SpeedCase& speed_case, const SpeedEffort& effort,
                            const BenchRequest& request) {
    const SceneDescription scene = scene_of(speed_case);
    std::vector<std::pair<std::string, std::unique_ptr<DeviceSide>>> sides;
    SimulationOptions options = plain_options(false);
    const auto add = [&](std::string_view name) {
        sides.emplace_back(name, std::make_unique<DeviceSide>(devices.of(scene, false), scene, options, request));
    };
    add("frame");
    for (const KernelSet& set : all_kernel_sets) {
        if (!concerns(set, speed_case.method)) continue;
        options.kernels = set.kernels;
        try {
            add(set.name);
        } catch (const DeviceError&) {  // the device has not what these kernels need
        }
    }
    for (int round = 0; round < effort.rounds; ++round)
        for (const auto& [name, side] : sides) side->round(effort);
    SpeedResult result{speed_case, sides[0].second->simulation().facts().kernels};
    for (const auto& [name, side] : sides) put(result, {name, side->means()[0].milliseconds});
    return result;
}

SpeedResult measure_skip(SpeedDevices& devices, const SpeedCase& speed_case, const SkipCase& skip,
                         const SceneDescription& scene, const SpeedEffort& effort, const BenchRequest& request) {
    std::vector<std::unique_ptr<DeviceSide>> sides;
    for (const auto change : {skip.set, skip.undo}) {
        SceneDescription asked = scene;
        asked.time.frame_count = 1'000'000;
        // Every frame does the same work: contact between cloths, of which later frames have more, would be measured
        // on other frames with the skip than without.
        if (asked.solver.method == SolverMethod::automatic) asked.solver.method = SolverMethod::line;
        for (Cloth& cloth : asked.cloths) cloth.self_collision.reset();
        SimulationOptions options = plain_options(false);
        std::uint32_t every = 1;
        change(asked, options, every);
        sides.push_back(
            std::make_unique<DeviceSide>(devices.of(asked, true), asked, options, request, every, skip.warm_up));
    }
    for (int round = 0; round < effort.rounds; ++round)
        for (const std::unique_ptr<DeviceSide>& side : sides) side->round(effort);
    SpeedResult result{speed_case, skip.scene + ": " + skip.saved};
    put(result, sides[0]->means()[0]);
    put(result, {"without", sides[1]->means()[0].milliseconds});
    return result;
}

double speed_work(const SpeedCase& speed_case, const SpeedEffort& effort) {
    constexpr double particle_step = 5e-7;  // s
    const double sides = speed_case.kind == SpeedKind::solve ? 1 : speed_case.kind == SpeedKind::kernels ? 4 : 2;
    const double least = 3 * speed_case.particles() * speed_case.substeps() * particle_step;
    return 1 + effort.rounds * std::max(sides * effort.seconds, least);
}

}  // namespace drape::bench
