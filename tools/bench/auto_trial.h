// `drape bench auto`: what method `auto` does with scenes drawn from a seed, judged from outside, by the library.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "bench/bench_request.h"
#include "bench/trial_result.h"
#include "drape/device.h"

namespace drape::bench {

struct TrialRequest : BenchRequest {
    std::string generator = "b";  ///< of `scene_generators`
    std::uint32_t seed = 1, first = 0, count = 100;
    double tolerance = 0;  ///< of every scene; 0: none is asked for
    bool reference = false;
    std::string folder = "bench_auto";  ///< finished scenes, a line each, kept for the next run
};

struct TrialSummary {
    std::string text;
    bool stopped = false;
    std::size_t run_count = 0, kept_count = 0;  ///< run now, kept from before
    bool fails = false;  ///< more than 1 % of the scenes were refused, or a frame was not kept and nothing said so
    std::uint64_t validation_count = 0;
};

/// A generator of scenes, told apart by its letter.
struct SceneGenerator {
    std::string name;
    SceneDescription (*scene)(std::uint32_t seed, std::uint32_t index);
};
const SceneGenerator* find_generator(const std::string& name);

/// Runs the scenes first .. first + count - 1 one after the other. Throws UsageError, OutputError, DeviceError.
TrialSummary run_trial(const TrialRequest& request);

}  // namespace drape::bench
