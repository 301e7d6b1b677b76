#include "judged_run.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "drape/error.h"
#include "world/seam_cover.h"

namespace drape::test {

namespace {

struct SeenFrame {
    std::uint32_t frame;
    std::set<std::array<std::uint32_t, 2>> crossed;  ///< pairs of cloths whose triangles cross, the lower index first
};

bool is_finite(const FinishedFrame& frame) {
    return std::ranges::all_of(frame.positions, [](std::span<const float> at) {
        return std::ranges::all_of(at, [](float x) { return std::isfinite(x); });
    });
}

SeenFrame see(const Simulation& simulation, const SeamCover& seams) {
    const FinishedFrame& frame = simulation.frame();
    std::vector<FloatMesh> meshes(frame.positions.size());
    for (std::size_t cloth = 0; cloth < meshes.size(); ++cloth) {
        const std::span<const float> at = frame.positions[cloth];
        for (std::size_t i = 0; i + 3 < at.size(); i += 4)
            meshes[cloth].points.push_back({at[i], at[i + 1], at[i + 2]});
        const std::vector<std::uint32_t> corners = seams.covered(cloth, simulation.triangles(cloth));
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
            meshes[cloth].triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
    SeenFrame seen{frame.frame, {}};
    for (const Crossing& each : find_crossings(meshes).pairs)
        seen.crossed.insert({std::min(each.mesh[0], each.mesh[1]), std::max(each.mesh[0], each.mesh[1])});
    return seen;
}

/// Two cloths meet where contact is on; those that started through each other once they are told to be apart.
bool meet(const SceneDescription& scene, const SelfContactReport& told, std::array<std::uint32_t, 2> pair,
          std::uint32_t frame) {
    if (pair[0] == pair[1]) return scene.cloths[pair[0]].self_collision.has_value();
    if (told.last_crossed && frame > *told.last_crossed) return true;
    return std::ranges::none_of(told.crossed, [&](const auto& each) {
        return std::min(each.first, each.second) == pair[0] && std::max(each.first, each.second) == pair[1];
    });
}

}  // namespace

JudgedRun judged_run(const SceneDescription& scene, const Device& device) {
    SimulationOptions options;
    options.timings = Timings::none;
    options.keep_promises = false;  // a cloth stretched beyond reason must not cross itself either
    Simulation simulation(scene, options, device);
    const SeamCover seams(simulation.scene());
    std::vector<SeenFrame> seen;
    JudgedRun judged;
    try {
        while (simulation.step() && is_finite(simulation.frame())) {
            seen.push_back(see(simulation, seams));
            judged.implausible |= simulation.frame().failure.has_value();
        }
    } catch (const Error& error) {
        judged.ended = error.what();
    }
    const std::optional<SelfContactReport> report = simulation.self_contact();
    const SelfContactReport told = report.value_or(SelfContactReport{.first_unproved = 0});
    judged.frames = seen.size();
    judged.most_pairs = told.most_pairs;
    judged.cut_short = told.truncated;
    judged.crossed_at_start = !told.crossed.empty();
    judged.came_apart = told.last_crossed && *told.last_crossed + 1 < judged.frames;
    for (const SeenFrame& each : seen) {
        const bool proved = !told.first_unproved || each.frame < *told.first_unproved;
        const bool crossed = std::ranges::any_of(
            each.crossed, [&](const auto& pair) { return !report || meet(scene, told, pair, each.frame); });
        judged.proved_frames += proved ? 1 : 0;
        judged.crossed_frames += crossed ? 1 : 0;
        if (proved && crossed) judged.contradictions.push_back(each.frame);
    }
    return judged;
}

}  // namespace drape::test
