#include "solver/position_upload.h"

#include "vulkan/api.h"

namespace drape {

std::string position_upload_name(const ClothModel& cloth) { return cloth.name + "/positions given"; }

void add_position_upload(graph::Graph& graph, ClothState& state) {
    const Grid& grid = state.model->grid;
    const graph::Handle given = graph.buffer(
        {position_upload_name(*state.model), grid.particle_count() * sizeof(glsl::vec4), graph::Lifetime::host_input});
    // The execute function is made before set-up runs, so it holds the place where the handle will be.
    const auto target = std::make_shared<graph::Handle>();
    graph.add_pass(
        state.pass_name("position upload", "upload"),
        [&](graph::PassSetup& setup) {
            setup.read(given, graph::Access::transfer_read);
            *target = state[Field::position] = setup.write(state[Field::position], graph::Access::transfer_write);
        },
        [given, target, width = grid.columns(), height = grid.rows()](graph::PassContext& context) {
            const VkBufferImageCopy region{0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {}, {width, height, 1}};
            vkCmdCopyBufferToImage(context.commands(), context.buffer(given).handle(), context.image(*target).handle(),
                                   context.layout(*target), 1, &region);
        });
}

}  // namespace drape
