#include "cloth/motion_error.h"

#include <algorithm>
#include <cmath>

#include "cloth/frame_judgement.h"

namespace drape {

std::uint32_t companion_substeps(const Method& method, std::uint32_t substeps) {
    const std::uint32_t more = (3 * substeps + 1) / 2;
    if (method.trust == Method::Trust::resolves && more <= method.most_substeps) return more;
    return substeps >= 8 ? substeps / 4 : std::max(substeps / 2, 1u);
}

double error_over_distance(const Method& method, std::uint32_t substeps) {
    constexpr double order = 1.4;
    return 1 / std::abs(std::pow(static_cast<double>(substeps) / companion_substeps(method, substeps), order) - 1);
}

MotionError::MotionError(const SimulationModel& model)
    : model_(model), distances_(model.cloths.size()), errors_(distances_), held_(distances_) {}

void MotionError::saw(std::uint32_t frame, std::span<const double> distances, std::uint32_t substeps) {
    constexpr double hold = 0.5;  // s, within which it falls to 1/e
    const double passed = (frame - last_frame_) / model_.scene.time.fps, kept = std::exp(-passed / hold);
    last_frame_ = frame;
    error_ = share_ = 0;
    for (std::size_t cloth = 0; cloth < distances.size(); ++cloth) {
        const double grown = distances[cloth] - distances_[cloth];
        // What was there before came about with other substeps; where the distance shrinks, all of it does alike.
        if (grown > 0)
            errors_[cloth] += grown * error_over_distance(row_of(model_.scene.solver.method), substeps);
        else if (grown < 0)
            errors_[cloth] *= distances[cloth] / distances_[cloth];
        distances_[cloth] = distances[cloth];
        held_[cloth] = std::max(errors_[cloth], kept * held_[cloth]);
        error_ = std::max(error_, held_[cloth]);
        share_ = std::max(share_, held_[cloth] / (motion_limit(model_, cloth) * frame / model_.scene.time.fps));
    }
}

}  // namespace drape
