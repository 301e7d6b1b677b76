#include "passes/readback_pass.h"

#include <volk.h>

namespace drape {

std::string position_readback_name(const ClothModel& cloth) { return cloth.name + "/positions on the host"; }

void add_position_readback(graph::Graph& graph, ClothState& state) {
    const Grid& grid = state.model->grid;
    const graph::Handle empty =
        graph.buffer({position_readback_name(*state.model), grid.particle_count() * sizeof(glsl::vec4),
                      graph::Lifetime::host_output});
    // The execute function is made before set-up runs, so it holds the place where the handle will be.
    const auto target = std::make_shared<graph::Handle>();
    graph.add_pass(
        state.pass_name("position readback", "readback"),
        [&](graph::PassSetup& setup) {
            setup.read(state.position, graph::Access::transfer_read);
            *target = setup.write(empty, graph::Access::transfer_write);
        },
        [position = state.position, target, width = grid.columns(), height = grid.rows()](graph::PassContext& context) {
            const VkBufferImageCopy region{0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {}, {width, height, 1}};
            vkCmdCopyImageToBuffer(context.commands(), context.image(position).handle(), VK_IMAGE_LAYOUT_GENERAL,
                                   context.buffer(*target).handle(), 1, &region);
        });
}

}  // namespace drape
