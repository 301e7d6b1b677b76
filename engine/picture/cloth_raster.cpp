#include "picture/cloth_raster.h"

#include <algorithm>

#include "world/contact_shape.h"

namespace drape {

namespace {

/// Returns the rest lengths of the stretch springs along columns, rows, m; 0 where there are none.
std::array<double, 2> rest_lengths(const ClothModel& cloth) {
    const StiffnessConstants& constants = cloth.stiffness_constant;
    return {constants.spring[0] > 0 ? constants.rest_length[0] : 0,
            constants.spring[1] > 0 ? constants.rest_length[1] : 0};
}

}  // namespace

std::vector<RasterCloth> raster_cloths(const SimulationModel& model, const std::vector<ClothState>& states) {
    std::vector<RasterCloth> cloths;
    for (const ClothState& state : states) {
        const Cloth& cloth = model.scene.cloths[state.cloths.front()];
        const Grid& grid = state.model->grid;
        cloths.push_back({cloth.name, grid.columns(), grid.rows(), cloth.size[0], cloth.size[1], least_thickness(cloth),
                          cloth.appearance, state[Field::position], state[Field::normal], state[Field::triangles],
                          state.index_count, state[Field::cut_vertices], state[Field::spring_share],
                          rest_lengths(*state.model)});
    }
    return cloths;
}

void ClothRaster::fit(const vulkan::Device& device, const SceneDescription& scene, const PictureOptions& options,
                      const std::vector<CutTopology>& topologies) {
    const bool cut = std::ranges::any_of(topologies, [](const CutTopology& t) { return !t.vertices().empty(); });
    const bool masked = std::ranges::any_of(topologies, &CutTopology::masked);
    if (pass_ && cut == cut_ && masked == masked_) return;
    pass_ = std::make_unique<RasterPass>(device, scene, options.width, options.height, options.samples,
                                         RasterOptions{.view = options.view, .cut = cut, .masked = masked});
    cut_ = cut, masked_ = masked;
}

}  // namespace drape
