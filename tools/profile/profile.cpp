#include "profile/profile.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "output/manifest.h"

namespace drape::profile {

namespace {

using Clock = std::chrono::steady_clock;

void add(std::vector<StageTime>& times, const StageTime& time) {
    const auto found = std::ranges::find(times, time.name, &StageTime::name);
    if (found == times.end())
        times.push_back(time);
    else
        found->milliseconds += time.milliseconds;
}

double in_order(const std::vector<double>& sorted, double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

void describe(const ProfileRequest& request, const Simulation& simulation, const Device& device, Profile& profile) {
    const SimulationFacts facts = simulation.facts();
    profile.program_version = program_version();
    profile.scene = request.scene.path;
    profile.device = device.info().name;
    profile.driver = device.info().driver + " " + device.info().driver_version;
    profile.solver = facts.method;
    profile.kernels = facts.kernels;
    profile.created = utc_timestamp();
    profile.draw = request.draw;
    profile.passes = request.passes;
    profile.substeps_vary = facts.limits_are_kept;
    profile.work = simulation.work();
    profile.memory = simulation.memory();
    profile.memory_used = device.memory_used();
}

}  // namespace

Profile run_profile(const ProfileRequest& request) {
    const SceneDescription scene = asked_scene(request.scene);
    const Device device =
        Device::for_scene(scene, request.draw, request.scene.device, validation_if(request.scene.validate));
    Profile profile;
    profile.copy_bandwidth = device.copy_bandwidth();
    SimulationOptions options;
    options.draw = request.draw;
    options.positions = !request.draw;
    options.skip = request.scene.skip;
    options.kernels = request.scene.kernels;
    options.keep_promises = false;
    options.timings = request.passes ? Timings::passes : Timings::stages;
    Simulation simulation(scene, options, device);
    describe(request, simulation, device, profile);
    Clock::time_point start, before;
    const auto seconds = [&](Clock::time_point time) { return std::chrono::duration<double>(time - start).count(); };
    const auto finished = [&](const FinishedFrame& frame) {
        const Clock::time_point now = Clock::now();
        if (frame.failure && profile.failure.empty()) profile.failure = frame.failure->reason;
        if (frame.frame == request.warm_up) start = now;
        if (frame.frame > request.warm_up) {
            profile.frames.push_back({frame.frame, seconds(before), seconds(now), frame.effort, {}});
            ProfiledFrame& one = profile.frames.back();
            for (const StageTime& time : frame.timings) add(one.device, time);
        }
        before = now;
    };
    const auto stop = [&] { return request.stop && request.stop(); };
    const auto always = [](std::uint32_t) { return true; };
    profile.stopped = !simulation.run(request.warm_up + request.frame_count, always, finished, stop);
    return profile;
}

std::vector<Row> rows_of(const Profile& profile) {
    std::vector<Row> rows{{"frame", {}}, {"device", {}}};
    for (std::size_t k = 0; k < profile.frames.size(); ++k) {
        const ProfiledFrame& frame = profile.frames[k];
        rows[0].milliseconds.push_back(1e3 * (frame.end - frame.begin));
        double all = 0;
        for (const StageTime& time : frame.device) {
            all += time.milliseconds;
            auto row = std::ranges::find(rows, time.name, &Row::name);
            if (row == rows.end()) row = rows.insert(rows.end(), {time.name, std::vector<double>(k, 0.0)});
            row->milliseconds.resize(k, 0.0);
            row->milliseconds.push_back(time.milliseconds);
        }
        rows[1].milliseconds.push_back(all);
    }
    for (Row& row : rows) row.milliseconds.resize(profile.frames.size(), 0.0);
    if (rows.size() == 2) rows.pop_back();
    if (profile.substeps_vary) rows.erase(rows.begin());
    return rows;
}

double mean_frame(const Profile& profile) {
    if (profile.frames.empty()) return 0;
    return 1e3 * (profile.frames.back().end - profile.frames.front().begin) /
           static_cast<double>(profile.frames.size());
}

Statistics statistics_of(std::vector<double> values) {
    std::ranges::sort(values);
    const double median = in_order(values, 0.5);
    const double range = in_order(values, 0.75) - in_order(values, 0.25);
    return {values.front(), median, in_order(values, 0.95), in_order(values, 0.99), median > 0 ? range / median : 0};
}

}  // namespace drape::profile
