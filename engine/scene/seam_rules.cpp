#include <algorithm>

#include "scene/scene_rules.h"
#include "world/gas.h"
#include "world/seams.h"

namespace drape {

namespace {

/// Returns the node below another that a JSON pointer names.
SceneNode node_at(const SceneNode& from, std::string_view pointer) {
    if (pointer.empty()) return from;
    const std::size_t end = std::min(pointer.find('/', 1), pointer.size());
    const std::string_view token = pointer.substr(1, end - 1);
    const bool is_index = token.find_first_not_of("0123456789") == std::string_view::npos;
    return node_at(is_index ? from.element(std::stoul(std::string(token))) : from.member(token), pointer.substr(end));
}

}  // namespace

bool check_seams(const SceneNode& cloths, const SceneNode& seams, SceneDescription& scene) {
    for (Seam& seam : scene.seams)
        for (SeamSide* const side : {&seam.a, &seam.b})
            if (const auto cloth = cloth_called(scene, side->cloth); cloth && side->from)
                side->corner = outline_corner(cloths.element(*cloth).member("outline"));
    const std::vector<SeamFault> faults = seam_faults(scene);
    for (const SeamFault& fault : faults) node_at(seams, fault.below).fail(fault.text);
    return faults.empty();
}

bool check_gas(const SceneNode& gas, const SceneDescription& scene) {
    const std::vector<GasFault> faults = gas_faults(scene);
    for (const GasFault& fault : faults) node_at(gas, fault.below).fail(fault.text);
    return faults.empty();
}

}  // namespace drape
