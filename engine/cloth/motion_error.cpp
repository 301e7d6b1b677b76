#include "cloth/motion_error.h"

#include <algorithm>
#include <cmath>

#include "cloth/frame_judgement.h"

namespace drape {

namespace {

/// s, within which an error that is not seen any more falls to 1/e.
constexpr double hold = 1.5;
/// s, the shortest time for which an error is allowed.
constexpr double least_time = 0.5;
constexpr double least_order = 0.7, usual_order = 1.4, most_order = 3;

}  // namespace

Companions companions_of(const Method& method, std::uint32_t substeps) {
    const std::uint32_t more = (3 * substeps + 1) / 2;
    if (method.trust == Method::Trust::resolves && more <= method.most_substeps) return {more, 0};
    const std::uint32_t companion = substeps == 6 ? 2 : std::max(substeps / 4, 1u);
    return {companion, companion / 2};
}

double richardson_error(const Method& method, std::uint32_t substeps, double apart, double further) {
    const Companions with = companions_of(method, substeps);
    const auto fallen = [](double to, double p) { return std::pow(to, -p); };
    const double n = substeps, companion = with.companion, coarser = with.coarser;
    double order = usual_order;
    if (with.coarser > 0) {
        double low = least_order, high = most_order;  // the ratio of the two distances grows with the order
        for (int k = 0; k < 30; ++k) {
            order = 0.5 * (low + high);
            const double ratio =
                (fallen(coarser, order) - fallen(companion, order)) / (fallen(companion, order) - fallen(n, order));
            (ratio * apart < further ? low : high) = order;
        }
    }
    return apart * fallen(n, order) / std::abs(fallen(companion, order) - fallen(n, order));
}

bool compares_at(const SimulationModel& model, std::uint32_t last, bool probes) {
    return probes || last % probe_length(model) == 0;
}

MotionError::MotionError(const SimulationModel& model) : model_(model), held_(model.cloths.size()) {}

void MotionError::saw(std::uint32_t frame, std::uint32_t substeps, std::span<const double> apart,
                      std::span<const double> further) {
    const double passed = (frame - last_frame_) / model_.scene.time.fps, kept = std::exp(-passed / hold);
    const Method& method = row_of(model_.scene.solver.method);
    const double time = std::max(frame / model_.scene.time.fps, least_time);
    last_frame_ = frame;
    error_ = share_ = 0;
    for (std::size_t cloth = 0; cloth < apart.size(); ++cloth) {
        const double error = richardson_error(method, substeps, apart[cloth], further.empty() ? 0 : further[cloth]);
        held_[cloth] = std::max(error, kept * held_[cloth]);
        error_ = std::max(error_, held_[cloth]);
        share_ = std::max(share_, held_[cloth] / (motion_limit(model_, cloth) * time));
    }
}

}  // namespace drape
