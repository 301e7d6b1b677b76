#include "control/sleep.h"

#include <algorithm>
#include <cmath>

#include "cloth/cut_topology.h"
#include "control/frame_judgement.h"
#include "world/collider_pose.h"
#include "world/motion.h"
#include "world/weather.h"

namespace drape {

namespace {

/// Cloth counts as still below this share of motion_limit.
constexpr double still_share = 0.01;
constexpr double rounding = 4 * 0x1p-24;  ///< relative to coordinates

}  // namespace

bool quiet(const SimulationModel& model, std::uint32_t frame) {
    const SceneDescription& scene = model.scene;
    const double to = frame / scene.time.fps, from = to - 1 / scene.time.fps;
    if (body_count(model) > 0) return false;  // one may fly while the cloth hangs still, and only the device knows
    if (!weather_stays(scene, from, to)) return false;
    const auto keeps_stiffness = [&](const Cloth& cloth) {
        return frame == 0 || stiffness_factor(scene, cloth, frame) == stiffness_factor(scene, cloth, frame - 1);
    };
    if (!std::ranges::all_of(scene.cloths, keeps_stiffness)) return false;
    if (releases(model, frame) || cutters_active(scene.cutters, from, to)) return false;
    // After the last key, the velocities of pins and surfaces still contain its motion for one step.
    const auto still = [&](const MotionPath& path) { return rests(path, from - 1 / scene.time.fps, to); };
    const auto rests_too = [&](const Collider& each) { return rests(each, from - 1 / scene.time.fps, to); };
    return std::ranges::all_of(scene.colliders, rests_too) &&
           std::ranges::all_of(model.cloths, [&](const ClothModel& cloth) {
               return std::ranges::all_of(cloth.dynamic_pins, still, &DynamicPin::path);
           });
}

std::size_t Sleep::remembered() const {
    return static_cast<std::size_t>(std::max(std::ceil(model_.scene.time.fps), 10.0));
}

void Sleep::saw(const std::vector<ClothStatistics>& cloths, std::uint32_t substeps) {
    double worst = 0;
    for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth) {
        // The rounding of a substep's displacements may look like this speed.
        const double noise = rounding * cloths[cloth].largest_distance * substeps * model_.scene.time.fps;
        const double speed = std::max(cloths[cloth].largest_speed - noise, 0.0);
        worst = std::max(worst, speed / (still_share * motion_limit(model_, cloth)));
    }
    speeds_.push_back(worst);
    if (speeds_.size() > remembered()) speeds_.pop_front();
}

bool Sleep::asleep(std::uint32_t frame) {
    if (!quiet(model_, frame)) {
        speeds_.clear();
        return false;
    }
    return speeds_.size() == remembered() && speeds_.back() <= speeds_.front() &&
           std::ranges::all_of(speeds_, [](double speed) { return speed <= 1; });
}

}  // namespace drape
