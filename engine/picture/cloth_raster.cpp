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
    if (*this && cut == cut_ && masked == masked_) return;
    if (options.color)
        picture_ = std::make_unique<RasterPass>(device, scene, options.width, options.height, options.samples,
                                                RasterOptions{.view = options.view, .cut = cut, .masked = masked});
    if (options.layers)
        layers_ = std::make_unique<LayerPass>(device, scene, options.width, options.height, cut, masked);
    cut_ = cut, masked_ = masked;
}

void ClothRaster::add(graph::Graph& graph, std::span<const RasterCloth> cloths) const {
    if (picture_) picture_->add(graph, cloths);
    if (layers_) layers_->add(graph, cloths);
}

void ClothRaster::upload(const graph::ResourcePool& pool) const {
    if (picture_) picture_->upload(pool);
    if (layers_) layers_->upload(pool);
}

void ClothRaster::write_frame(const graph::ResourcePool& pool, std::uint32_t slot, double time,
                              std::span<const BodyState> moved) const {
    if (picture_) picture_->write_frame(pool, slot, time, moved);
    if (layers_) layers_->write_frame(pool, slot, time, moved);
}

void ClothRaster::read(const graph::ResourcePool& pool, std::uint32_t slot, FinishedFrame& frame) const {
    if (layers_) frame.layers = layers_->pixels(pool, slot);
    if (!picture_) return;
    const std::span<std::byte> bytes =
        pool.buffer(RasterPass::readback_name, slot).mapped().first(picture_->readback_byte_count());
    picture_->finish(bytes);
    frame.rgba = {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

}  // namespace drape
