#include "cloth/substep_change.h"

#include <algorithm>
#include <cmath>

namespace drape {

namespace {

/// In damped flight d = v h + w (e^(c h) - 1)/c, with v the terminal velocity and w what the velocity at the end has
/// beside it, so its excess is e = -w (e^(c h) - 1)^2/(2 c). Substeps W times as long have G = (e^(c W h) - 1)/(e^(c h)
/// - 1): d' = W (d + e) - e (W + 2 (G - W)/(e^(c h) - 1)), e' = G^2 e, and that of the substep before is e^(c W h)
/// times as much. Without damping all three weights are W^2.
glsl::SubstepChange substep_change(double damping, double substep, double ratio) {
    const double ch = damping * substep, growth = std::expm1(ch);
    const auto rounded = [](double value) { return static_cast<float>(value); };
    // At larger values the rest of a velocity would be scaled up without bound.
    if (ch < 1e-6 || ch * std::max(ratio, 1.0) > 1)
        return {rounded(ratio), rounded(ratio * ratio), rounded(ratio * ratio), rounded(ratio * ratio)};
    const double G = std::expm1(ch * ratio) / growth;
    return {rounded(ratio), rounded(ratio + 2 * (G - ratio) / growth), rounded(G * G),
            rounded(G * G * std::exp(ch * ratio))};
}

}  // namespace

std::vector<glsl::SubstepChange> substep_changes(const SimulationModel& model, std::uint32_t before,
                                                 std::uint32_t after) {
    const double substep = 1 / (model.scene.time.fps * before), ratio = static_cast<double>(before) / after;
    std::vector<glsl::SubstepChange> changes;
    for (const ClothModel& cloth : model.cloths) changes.push_back(substep_change(cloth.damping, substep, ratio));
    return changes;
}

}  // namespace drape
