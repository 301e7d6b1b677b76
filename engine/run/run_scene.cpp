#include <algorithm>
#include <memory>
#include <optional>

#include "base/printable_text.h"
#include "output/slow_notice.h"
#include "run/folder_run.h"
#include "run/run.h"

namespace drape {

RunSummary run_scene(const RunRequest& request) {
    std::optional<SlowNotice> starting;
    if (request.message && !request.quiet)
        starting.emplace(printable(request.scene.path) + ": still being read and prepared ...", request.message);
    FolderRun run(request);
    {
        Simulation simulation = run.simulation();
        run.begin(simulation);
        starting.reset();
        run.simulate();
        run.finish();
    }
    return run.end();  // includes the messages that came when the simulation was destroyed
}

namespace {

/// One of several runs that proceed together.
struct Together {
    std::size_t number;  ///< the number of its request
    std::unique_ptr<FolderRun> run;
    FrameRequest frames;
};

/// Calls `act` and reports a run that throws. Returns whether it did not throw.
template <class Act>
bool tells_failure(std::size_t number, const std::function<void(const RunEnd&)>& ended, const Act& act) {
    try {
        act();
        return true;
    } catch (const DeviceError&) {
        throw;
    } catch (...) {
        ended({number, false, std::current_exception()});
        return false;
    }
}

}  // namespace

void run_scenes_together(std::span<const RunRequest> requests, const std::function<void(const RunEnd&)>& ended) {
    std::vector<Together> all;
    std::vector<SceneDescription> scenes;
    std::vector<SimulationOptions> options;
    std::optional<Device> device;
    for (std::size_t k = 0; k < requests.size(); ++k)
        tells_failure(k, ended, [&] {
            if (!device) device = device_of(requests[k].scene, asked_scene(requests[k].scene), false);
            auto run = std::make_unique<FolderRun>(requests[k], device);
            scenes.push_back(run->scene());
            options.push_back(run->options());
            all.push_back({k, std::move(run), {}});
        });
    if (all.empty()) return;
    std::vector<Simulation> simulations = Simulation::together(scenes, options, *device);
    std::vector<FrameRequest> frames;
    for (std::size_t k = 0; k < all.size(); ++k) {
        Together& each = all[k];
        const bool begun = tells_failure(each.number, ended, [&] {
            each.run->begin(simulations[k]);
            frames.push_back(each.run->frames());
        });
        if (begun) continue;
        each.run.reset();
        frames.push_back(
            {.last = 0, .wanted = [](std::uint32_t) { return false; }, .finished = {}, .stop = [] { return true; }});
    }
    const std::vector<RequestEnd> ends = Simulation::run_together(simulations, frames);
    for (std::size_t k = 0; k < all.size(); ++k)
        if (all[k].run) {
            all[k].run->take_end(ends[k]);
            all[k].run->finish();
        }
    simulations.clear();
    for (const Together& each : all)
        if (each.run)
            tells_failure(each.number, ended, [&] {
                const bool complete = each.run->end().complete;
                ended({each.number, complete, nullptr});
            });
}

}  // namespace drape
