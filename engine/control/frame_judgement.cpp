#include "control/frame_judgement.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/vectors.h"
#include "cloth/cut_topology.h"

namespace drape {

namespace {

/// The error per second is this share of the distance, per second, from the run with half the substeps. An error that
/// falls with the square of the substep is a third of this distance; one that falls with the substep is all of it.
constexpr double estimate_share = 0.5;

}  // namespace

std::uint32_t probe_length(const SimulationModel& model) {
    return static_cast<std::uint32_t>(std::clamp(std::round(0.1 * model.scene.time.fps), 2.0, 12.0));
}

double motion_error(const SimulationModel& model, double difference, std::uint32_t frame_count) {
    return estimate_share * difference * model.scene.time.fps / frame_count;
}

double motion_limit(const SimulationModel& model, std::size_t cloth) {
    const SolverSettings& solver = model.scene.solver;
    const std::array<double, 2>& size = model.scene.cloths[cloth].size;
    return solver.tolerance_motion > 0 ? solver.tolerance_motion : default_motion_limit(std::max(size[0], size[1]));
}

double stretch_judgement(const SimulationModel& model, const std::vector<ClothStatistics>& cloths) {
    const auto [rms_limit, worst_limit] = model.stretch_limits();
    double worst = 0;
    for (const ClothStatistics& cloth : cloths) {
        const double error = std::max(cloth.stretch_error_rms / rms_limit, cloth.stretch_error_max / worst_limit);
        if (cloth.non_finite_count > 0 || !std::isfinite(error)) return std::numeric_limits<double>::infinity();
        worst = std::max(worst, error);
    }
    return worst;
}

double lag_limit(const SimulationModel& model) {
    double least = std::numeric_limits<double>::infinity();
    for (const ClothModel& cloth : model.cloths) least = std::min({least, cloth.spacing[0], cloth.spacing[1]});
    return 0.5 * least;
}

double lag_judgement(const SimulationModel& model, const glsl::SelfRecord& record) {
    return double{std::bit_cast<float>(record.most_lag)} / lag_limit(model);
}

double turning_judgement(const SimulationModel& model, const std::vector<ClothStatistics>& cloths) {
    constexpr double time = 0.1;
    double worst = 0;
    for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth) {
        const std::array<double, 2>& size = model.scene.cloths[cloth].size;
        const double made = length(cloths[cloth].angular_error) * model.scene.time.fps * time,
                     allowed = cloths[cloth].mass * 0.5 * std::max(size[0], size[1]) * motion_limit(model, cloth);
        worst = std::max(worst, made / allowed);
    }
    return worst;
}

std::uint32_t probe_room(const SimulationModel& model, std::uint32_t frame) {
    // Each frame of a scene that tears ends with a search; what actions do in the next is not known yet.
    if (model.scene.tears() || model.options.acts) return 0;
    const double fps = model.scene.time.fps;
    const std::uint32_t end = std::max(model.scene.time.frame_count, frame + 1);
    std::uint32_t room = 0;
    for (; frame + room < end && room < probe_length(model); ++room) {
        const std::uint32_t each = frame + room;
        if (cutters_active(model.scene.cutters, (each - 1) / fps, each / fps)) break;
        if (room > 0 && releases(model, each)) break;
    }
    return room;
}

bool releases(const SimulationModel& model, std::uint32_t frame) {
    const double end = frame / model.scene.time.fps, start = end - 1 / model.scene.time.fps;
    for (const ClothModel& cloth : model.cloths)
        for (const DynamicPin& pin : cloth.dynamic_pins)
            if (pin.release && *pin.release > start - 1e-9 && *pin.release <= end - 1e-9) return true;
    return false;
}

}  // namespace drape
