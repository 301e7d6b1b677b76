// Measures the cases of `drape bench speed`.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "bench/bench_run.h"
#include "bench/speed_report.h"
#include "drape/device.h"

namespace drape::bench {

/// How long each side of a comparison is measured. The sides take turns, so that what slows the machine for a while
/// slows all of them.
struct SpeedEffort {
    int rounds = 7;
    double seconds = 0.2;  ///< of each side in each round; two frames at least
};

/// A device as a run of a scene opens it, each kind once.
class SpeedDevices {
  public:
    explicit SpeedDevices(const BenchRequest& request) : request_(request) {}
    const Device& of(const SceneDescription& scene, bool draw);
    std::uint64_t validation_count() const;

  private:
    const BenchRequest& request_;
    /// By two facts: the calling thread does the work; the device draws.
    std::map<std::pair<bool, bool>, std::optional<Device>> devices_;
};

/// Throws Stopped, DeviceError.
SpeedResult measure_solver(SpeedDevices& devices, const SpeedCase& speed_case, const SpeedEffort& effort,
                           const BenchRequest& request);
SpeedResult measure_picture(SpeedDevices& devices, const SpeedCase& speed_case, const SpeedEffort& effort,
                            const BenchRequest& request);
/// Times every set of kernels that the device can run, by its name, and "frame", the set that is chosen by default,
/// which the note names.
SpeedResult measure_kernels(SpeedDevices& devices, const SpeedCase& speed_case, const SpeedEffort& effort,
                            const BenchRequest& request);
/// Times "frame", a step of an ensemble of so many members, and "alone", a frame of one by itself, on one thread.
SpeedResult measure_ensemble(SpeedDevices& devices, const SpeedCase& speed_case, const SpeedEffort& effort,
                             const BenchRequest& request);
/// `scene`: the shipped one.
SpeedResult measure_skip(SpeedDevices& devices, const SpeedCase& speed_case, const SkipCase& skip,
                         const SceneDescription& scene, const SpeedEffort& effort, const BenchRequest& request);
/// In processes of its own, forked: before any other thread runs. A Mesa driver's shader cache is empty at first (cold)
/// and then full (warm).
SpeedResult measure_start(const SpeedCase& speed_case, const SpeedEffort& effort, const BenchRequest& request);

/// Returns about how many seconds a case takes, at 0.5 us per particle and substep for all sides together.
double speed_work(const SpeedCase& speed_case, const SpeedEffort& effort);

}  // namespace drape::bench
