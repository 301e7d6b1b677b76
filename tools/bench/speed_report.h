// The results of `drape bench speed` for people and programs.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/speed_result.h"
#include "plot/plot.h"

namespace drape::bench {

struct SpeedReport {
    std::string program_version, created;  ///< UTC
    std::string device, driver;            ///< driver with its version
    int cores = 1;
    double copy_bandwidth = 0;  ///< bytes/s; 0: not known
    bool is_short = false;
    bool complete = true;  ///< false: cases were left out
    std::vector<SpeedResult> results{};
};

std::string speed_text(const SpeedReport& report);
std::string speed_json(const SpeedReport& report);
/// A row per case and time.
std::string speed_csv(const SpeedReport& report);
/// File names and plots: per group of sheets ns per particle and substep against particles, of cloths and colliders
/// ms per substep against their number. Only of what has two points or more.
plot::Plots speed_plots(const SpeedReport& report);

}  // namespace drape::bench
