// How long a program that uses Drape takes to its first frame: measured in child processes.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>

#include "base/output_error.h"
#include "bench/measure.h"
#include "bench/speed_measure.h"

namespace drape::bench {

namespace {

constexpr const char* part_names[] = {"instance and device", "pipelines and memory", "first frames", "all",
                                      "a later frame"};
using Parts = std::array<double, std::size(part_names)>;  // ms

constexpr int most_rounds = 3;  // a cold start takes a second or two

/// To frame 1, the first that is simulated, and the one after it.
Parts start(const SpeedCase& speed_case, const BenchRequest& request) {
    Stopwatch watch;
    const auto lap = [&watch] { return 1e3 * std::exchange(watch, Stopwatch()).seconds(); };
    const SceneDescription scene = scene_of(speed_case);
    Parts parts{};
    const Device device(request.device, validation_if(request.validate));
    parts[0] = lap();
    SimulationOptions options;
    options.draw = speed_case.draw;
    Simulation simulation(scene, options, device);
    parts[1] = lap();
    simulation.step();
    simulation.step();
    parts[2] = lap();
    parts[3] = parts[0] + parts[1] + parts[2];
    simulation.step();
    parts[4] = lap();
    return parts;
}

/// The same in a process of its own.
Parts start_alone(const SpeedCase& speed_case, const BenchRequest& request, const std::string& cache) {
    int ends[2];
    if (pipe(ends) != 0) throw OutputError("cannot make a pipe");
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        setenv("MESA_SHADER_CACHE_DIR", cache.c_str(), 1);
        try {
            const Parts parts = start(speed_case, request);
            _exit(write(ends[1], parts.data(), sizeof parts) == sizeof parts ? 0 : 1);
        } catch (...) {  // the parent opens the same device, and says what is wrong
            _exit(1);
        }
    }
    close(ends[1]);
    Parts parts{};
    const ssize_t count = child < 0 ? -1 : read(ends[0], parts.data(), sizeof parts);
    close(ends[0]);
    if (child > 0) waitpid(child, nullptr, 0);
    return count == sizeof parts ? parts : Parts{};
}

/// A folder that goes when this does.
struct CacheFolder {
    CacheFolder() : path((std::filesystem::temp_directory_path() / "drape_start_XXXXXX").string()) {
        if (!mkdtemp(path.data())) throw OutputError("cannot make a folder for a cold start");
    }
    ~CacheFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    CacheFolder(const CacheFolder&) = delete;
    CacheFolder& operator=(const CacheFolder&) = delete;
    std::string path;
};

}  // namespace

SpeedResult measure_start(const SpeedCase& speed_case, const SpeedEffort& effort, const BenchRequest& request) {
    std::array<std::vector<Parts>, 2> runs;  // cold, warm
    for (int round = 0; round < std::min(effort.rounds, most_rounds); ++round) {
        const CacheFolder cache;
        for (std::vector<Parts>& run : runs) {
            if (request.stopped()) throw Stopped{};
            const Parts parts = start_alone(speed_case, request, cache.path);
            if (parts[3] > 0) run.push_back(parts);
        }
    }
    SpeedResult result{speed_case};
    for (std::size_t warm = 0; warm < runs.size(); ++warm)
        for (std::size_t part = 0; part < std::size(part_names) && !runs[warm].empty(); ++part) {
            std::vector<double> milliseconds;
            for (const Parts& parts : runs[warm]) milliseconds.push_back(parts[part]);
            result.times.push_back({fmt::format("{}: {}", warm ? "warm" : "cold", part_names[part]),
                                    profile::statistics_of(milliseconds)});
        }
    return result;
}

}  // namespace drape::bench
