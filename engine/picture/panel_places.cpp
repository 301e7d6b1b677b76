#include "picture/panel_places.h"

namespace drape {

PanelPlaces::PanelPlaces(View view, const std::vector<Cloth>& cloths) : first_(cloths.size(), -1) {
    if (view != View::shaded) return;
    for (std::size_t k = 0; k < cloths.size(); ++k) {
        if (cloths[k].panel.empty()) continue;
        first_[k] = static_cast<float>(places_.size());
        for (const auto& [u, v] : cloths[k].panel) places_.push_back({static_cast<float>(u), static_cast<float>(v)});
    }
}

}  // namespace drape
