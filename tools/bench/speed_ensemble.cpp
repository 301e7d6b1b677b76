// Ensembles against one simulation after the other, as processes on all cores run them.
#include <algorithm>
#include <thread>

#include "bench/measure.h"
#include "bench/speed_measure.h"
#include "drape/ensemble.h"

namespace drape::bench {

namespace {

/// Runs `step` for a while and returns the milliseconds of one.
template <class Step>
double mean_of_round(const SpeedEffort& effort, const BenchRequest& request, const Step& step) {
    const Stopwatch watch;
    int count = 0;
    do {
        if (request.stopped()) throw Stopped{};
        step();
        ++count;
    } while (watch.seconds() < effort.seconds || count < 2);
    return 1e3 * watch.seconds() / count;
}

}  // namespace

SpeedResult measure_ensemble(SpeedDevices& devices, const SpeedCase& speed_case, const SpeedEffort& effort,
                             const BenchRequest& request) {
    SpeedCase one = speed_case;
    one.cloths = 1;
    std::vector<SceneDescription> members(speed_case.cloths, scene_of(one));
    for (std::size_t k = 0; k < members.size(); ++k)
        members[k].cloths[0].areal_density *= 1 + 0.5 * static_cast<double>(k) / static_cast<double>(members.size());
    // A scene alone runs without worker threads on a CPU; an ensemble has work for all cores.
    const Device& threaded = devices.of(scene_of({.size = 256}), false);
    const Device& single = devices.of(members[0], false);
    Simulation alone(members[0], {.keep_promises = false, .timings = Timings::none}, single);
    Ensemble ensemble(members, {}, threaded);
    for (std::uint32_t frame = 0; frame < SkipCase{}.warm_up; ++frame) {
        alone.step();
        ensemble.step();
    }
    std::vector<double> together, device, by_itself;
    for (int round = 0; round < effort.rounds; ++round) {
        double on_device = 0;
        int steps = 0;
        together.push_back(mean_of_round(effort, request, [&] {
            ensemble.step();
            on_device += ensemble.device_milliseconds();
            ++steps;
        }));
        device.push_back(on_device / steps);
        by_itself.push_back(mean_of_round(effort, request, [&] { alone.step(); }));
    }
    SpeedResult result{speed_case};
    result.times.push_back({"frame", profile::statistics_of(together)});
    if (std::ranges::max(device) > 0) result.times.push_back({"device", profile::statistics_of(device)});
    result.times.push_back({"alone", profile::statistics_of(by_itself)});
    return result;
}

}  // namespace drape::bench
