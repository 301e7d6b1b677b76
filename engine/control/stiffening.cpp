#include "control/stiffening.h"

#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "world/weather.h"

namespace drape {

namespace {

bool rises(const Cloth& cloth) {
    return std::ranges::adjacent_find(cloth.stiffness_keys, std::ranges::less(), &FactorKey::factor) !=
           cloth.stiffness_keys.end();
}

}  // namespace

Stiffening::Stiffening(const SimulationModel& model) : model_(model) {
    if (std::ranges::none_of(model.scene.cloths, rises)) return;
    done_.assign(model.cloths.size(), 0);
    kept_.assign(model.cloths.size(), 0);
}

double Stiffening::recoil(std::size_t index) const {
    const Cloth& cloth = model_.scene.cloths[index];
    if (!rises(cloth)) return 0;
    const double softest = std::ranges::min(cloth.stiffness_keys, {}, &FactorKey::factor).factor;
    return length(strongest_gravity(model_.scene)) * std::max(cloth.size[0], cloth.size[1]) *
           std::sqrt(cloth.areal_density / cloth.stiffness.stretch) / softest;
}

void Stiffening::begin(std::uint32_t frame) {
    for (std::size_t k = 0; k < done_.size(); ++k) {
        if (frame == 0) done_[k] = kept_[k] = 0;
        if (frame == 0) continue;
        const double before = stiffness_factor(model_.scene, model_.scene.cloths[k], frame - 1),
                     now = stiffness_factor(model_.scene, model_.scene.cloths[k], frame);
        done_[k] += std::max(now / before - 1, 0.0) * kept_[k];
    }
}

}  // namespace drape
