#include <fmt/format.h>

#include <algorithm>

#include "run/reproducer.h"
#include "run/run_statistics.h"
#include "simulation/frame_checks.h"

namespace drape {

namespace {

/// Returns the reproducer's device if it exists, unless another one is requested.
std::string device_for(const ReplayRequest& request, const Reproducer& reproducer) {
    if (!request.device.empty()) return request.device;
    const std::vector<DeviceInfo> devices = Device::list();
    const auto same = std::ranges::find(devices, reproducer.device.uuid, &DeviceInfo::uuid_text);
    return same == devices.end() ? std::string() : reproducer.device.uuid;
}

/// Returns why bits may differ; empty: there is no reason.
std::string difference(const Reproducer& reproducer, const DeviceInfo& device) {
    if (reproducer.program_version != program_version())
        return fmt::format("the run was of version {}, this is {}", reproducer.program_version, program_version());
    if (reproducer.device.uuid != device.uuid_text()) return fmt::format("the run was on '{}'", reproducer.device.name);
    if (reproducer.device.driver_version != device.driver_version)
        return fmt::format("the run's driver was {} {}", reproducer.device.driver, reproducer.device.driver_version);
    return {};
}

/// Returns which values of the last good frame differ from the reproducer's.
std::string different_values(const Reproducer& reproducer, const FrameValues& values) {
    for (const auto& [name, value] : reproducer.last_frame->values) {
        const auto found = values.find(name);
        if (found == values.end() || found->second != value)
            return fmt::format("in frame {}, {} was {} and is {}", reproducer.last_frame->frame, name, value,
                               found == values.end() ? std::string("missing") : fmt::format("{}", found->second));
    }
    return {};
}

/// Simulates to the failure or the end.
Replay replayed(Simulation& simulation, const Reproducer& reproducer, const ReplayRequest& request) {
    Replay replay;
    std::string different;
    const auto wanted = [&](std::uint32_t frame) {
        return frame >= reproducer.start && (frame - reproducer.start) % reproducer.step == 0;
    };
    const auto finished = [&](const FinishedFrame& frame) {
        if (frame.failure) raise(*frame.failure);
        if (reproducer.last_frame && reproducer.last_frame->frame == frame.frame && different.empty())
            different = different_values(reproducer, frame_values(simulation.scene(), frame));
    };
    std::string said;
    try {
        replay.stopped = !simulation.run(reproducer.end, wanted, finished, request.stop);
    } catch (const FrameError& error) {
        said = error.what();
        replay.error = std::current_exception();
    }
    if (!replay.error)
        replay.text = fmt::format("no failure up to frame {}; the run said: {}", reproducer.end, reproducer.reason);
    else if (said != reproducer.reason)
        replay.text = fmt::format("another failure: {}; the run said: {}", said, reproducer.reason);
    else if (!different.empty())
        replay.text = fmt::format("the same failure, with other numbers before it: {}", different);
    else
        replay.reached = true;
    return replay;
}

}  // namespace

Replay replay_reproducer(const ReplayRequest& request) {
    const auto say = [&](const std::string& text) {
        if (request.message) request.message(text);
    };
    Reproducer reproducer = read_reproducer(request.path);
    const LoadedScene scene = load_text(reproducer.scene, reproducer.scene_text);
    const Device device =
        Device::for_scene(scene.description, false, device_for(request, reproducer), validation_if(request.validate));
    if (const std::string why = difference(reproducer, device.info()); !why.empty())
        say("warning: the replay may differ: " + why);
    SimulationOptions options = simulation_options(reproducer.scene, false, false, false);
    options.keep_promises = !reproducer.keep_failed;
    Simulation simulation(scene.description, options, device);
    if (reproducer.checkpoint) {
        try {
            simulation.restore(reproducer.checkpoint->state);
        } catch (const DeviceError&) {
            throw;
        } catch (const Error& error) {
            throw OutputError(fmt::format("'{}': {}", request.path, error.what()));
        }
    }
    say(fmt::format("replays from frame {}", simulation.next_frame()));
    Replay replay = replayed(simulation, reproducer, request);
    if (device.validation_count() > 0) say(fmt::format("{} validation messages", device.validation_count()));
    return replay;
}

}  // namespace drape
