#include <fmt/format.h>

#include <algorithm>

#include "run/failure_capsule.h"
#include "run/run_statistics.h"
#include "simulation/frame_checks.h"

namespace drape {

namespace {

/// Returns the capsule's device where it is, unless another is asked for.
std::string device_for(const ReplayRequest& request, const FailureCapsule& capsule) {
    if (!request.device.empty()) return request.device;
    const std::vector<DeviceInfo> devices = Device::list();
    const auto same = std::ranges::find(devices, capsule.device.uuid, &DeviceInfo::uuid_text);
    return same == devices.end() ? std::string() : capsule.device.uuid;
}

/// Returns why bits may differ; empty: they may not.
std::string difference(const FailureCapsule& capsule, const DeviceInfo& device) {
    if (capsule.program_version != program_version())
        return fmt::format("the run was of version {}, this is {}", capsule.program_version, program_version());
    if (capsule.device.uuid != device.uuid_text()) return fmt::format("the run was on '{}'", capsule.device.name);
    if (capsule.device.driver_version != device.driver_version)
        return fmt::format("the run's driver was {} {}", capsule.device.driver, capsule.device.driver_version);
    return {};
}

/// Returns what is not as the capsule says of its last good frame.
std::string different_values(const FailureCapsule& capsule, const FrameValues& values) {
    for (const auto& [name, value] : capsule.last_frame->values) {
        const auto found = values.find(name);
        if (found == values.end() || found->second != value)
            return fmt::format("in frame {}, {} was {} and is {}", capsule.last_frame->frame, name, value,
                               found == values.end() ? std::string("missing") : fmt::format("{}", found->second));
    }
    return {};
}

/// Runs to the failure or the end.
Replay replayed(Simulation& simulation, const FailureCapsule& capsule, const ReplayRequest& request) {
    Replay replay;
    std::string different;
    const auto wanted = [&](std::uint32_t frame) {
        return frame >= capsule.start && (frame - capsule.start) % capsule.step == 0;
    };
    const auto finished = [&](const FinishedFrame& frame) {
        if (frame.failure) raise(*frame.failure);
        if (capsule.last_frame && capsule.last_frame->frame == frame.frame && different.empty())
            different = different_values(capsule, frame_values(simulation.scene(), frame));
    };
    std::string said;
    try {
        replay.stopped = !simulation.run(capsule.end, wanted, finished, request.stop);
    } catch (const FrameError& error) {
        said = error.what();
        replay.error = std::current_exception();
    }
    if (!replay.error)
        replay.text = fmt::format("no failure up to frame {}; the run said: {}", capsule.end, capsule.reason);
    else if (said != capsule.reason)
        replay.text = fmt::format("another failure: {}; the run said: {}", said, capsule.reason);
    else if (!different.empty())
        replay.text = fmt::format("the same failure, with other numbers before it: {}", different);
    else
        replay.reached = true;
    return replay;
}

}  // namespace

Replay replay_capsule(const ReplayRequest& request) {
    const auto say = [&](const std::string& text) {
        if (request.message) request.message(text);
    };
    FailureCapsule capsule = read_capsule(request.path);
    const LoadedScene scene = load_text(capsule.scene, capsule.scene_text);
    const Device device =
        Device::for_scene(scene.description, false, device_for(request, capsule), validation_if(request.validate));
    if (const std::string why = difference(capsule, device.info()); !why.empty())
        say("warning: the replay may differ: " + why);
    SimulationOptions options = simulation_options(capsule.scene, false, false, false);
    options.keep_promises = !capsule.keep_failed;
    Simulation simulation(scene.description, options, device);
    if (capsule.checkpoint) {
        try {
            simulation.restore(capsule.checkpoint->state);
        } catch (const DeviceError&) {
            throw;
        } catch (const Error& error) {
            throw OutputError(fmt::format("'{}': {}", request.path, error.what()));
        }
    }
    say(fmt::format("replays from frame {}", simulation.next_frame()));
    Replay replay = replayed(simulation, capsule, request);
    if (device.validation_count() > 0) say(fmt::format("{} validation messages", device.validation_count()));
    return replay;
}

}  // namespace drape
