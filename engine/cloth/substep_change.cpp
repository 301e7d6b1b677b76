#include "cloth/substep_change.h"

#include <algorithm>
#include <cmath>

namespace drape {

namespace {

/// In damped flight d = v h + w (e^(c h) - 1)/c, with v the terminal velocity and w what the velocity at the end has
/// beside it, so half of its last change is e = -w (e^(c h) - 1)^2/(2 c), and h times the velocity at the end is d + s
/// e (excess_share). Substeps W times as long have G = (e^(c W h) - 1)/(e^(c h) - 1): e' = G^2 e, of which s' counts,
/// and that of the substep before is e^(c W h) times as much. Without damping G is W.
glsl::SubstepChange substep_change(double damping, double substep, double ratio) {
    const double ch = damping * substep, share = excess_share(damping, substep);
    const auto rounded = [](double value) { return static_cast<float>(value); };
    // At larger values the rest of a velocity would be scaled up without bound.
    const bool simple = ch < 1e-6 || ch * std::max(ratio, 1.0) > 1;
    const double G = simple ? ratio : std::expm1(ch * ratio) / std::expm1(ch);
    const double changed = G * G / share, earlier = simple ? 1 : std::exp(ch * ratio);
    return {rounded(ratio), rounded(changed * excess_share(damping, substep * ratio)), rounded(2 * changed),
            rounded(changed * earlier)};
}

}  // namespace

double excess_share(double damping, double substep) {
    const double ch = damping * substep, growth = std::expm1(ch);
    if (ch > 1) return 1;
    if (ch < 1e-3) return 1 - ch * (2.0 / 3 - ch / 6);  // its series
    return 2 * (growth - ch) / (growth * growth);
}

std::vector<glsl::SubstepChange> substep_changes(const SimulationModel& model, std::uint32_t before,
                                                 std::uint32_t after) {
    const double substep = 1 / (model.scene.time.fps * before), ratio = static_cast<double>(before) / after;
    std::vector<glsl::SubstepChange> changes;
    for (const ClothModel& cloth : model.cloths) changes.push_back(substep_change(cloth.damping, substep, ratio));
    return changes;
}

}  // namespace drape
