#include "solver/readback_pass.h"

#include "vulkan/api.h"

namespace drape {

std::string readback_name(const std::string& state, std::string_view what) {
    return state + "/" + std::string(what) + "s on the host";
}

void add_readback(graph::Graph& graph, const ClothState& state, graph::Handle image, std::string_view what) {
    add_image_readback(graph, state.pass_name(std::string(what) + " readback", "readback"), image,
                       readback_name(state.name, what));
}

void add_image_readback(graph::Graph& graph, const graph::PassName& name, graph::Handle image,
                        const std::string& host_name) {
    const graph::ImageDeclaration whole = graph.resources()[image.resource].image;
    const std::uint64_t texel = whole.format == VK_FORMAT_R32G32B32A32_SFLOAT ? sizeof(glsl::vec4) : sizeof(glsl::uint);
    const graph::Handle empty =
        graph.buffer({host_name, whole.width * whole.height * texel, graph::Lifetime::host_output});
    // The execute function is made before set-up runs, so it holds the place where the handle will be.
    const auto target = std::make_shared<graph::Handle>();
    graph.add_pass(
        name,
        [&](graph::PassSetup& setup) {
            setup.read(image, graph::Access::transfer_read);
            *target = setup.write(empty, graph::Access::transfer_write);
        },
        [image, target, width = whole.width, height = whole.height](graph::PassContext& context) {
            const VkBufferImageCopy region{0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {}, {width, height, 1}};
            vkCmdCopyImageToBuffer(context.commands(), context.image(image).handle(), VK_IMAGE_LAYOUT_GENERAL,
                                   context.buffer(*target).handle(), 1, &region);
        });
}

std::vector<std::span<const float>> read_back(const ClothLayout& layout, const graph::ResourcePool& pool,
                                              std::uint32_t slot, std::string_view what) {
    std::vector<std::span<const float>> views;
    const auto name_of = [&](const std::string& state) { return readback_name(state, what); };
    for (const auto bytes : layout.parts(pool, slot, name_of))
        views.push_back({reinterpret_cast<const float*>(bytes.data()), bytes.size() / sizeof(float)});
    return views;
}

void add_buffer_readback(graph::Graph& graph, const graph::PassName& name, graph::Handle buffer, std::uint64_t offset,
                         std::uint64_t byte_count, const std::string& host_name) {
    const graph::Handle empty = graph.buffer({host_name, byte_count, graph::Lifetime::host_output});
    const auto target = std::make_shared<graph::Handle>();  // set by set-up, used when recorded
    graph.add_pass(
        name,
        [&](graph::PassSetup& setup) {
            setup.read(buffer, graph::Access::transfer_read);
            *target = setup.write(empty, graph::Access::transfer_write);
        },
        [buffer, offset, byte_count, target](graph::PassContext& context) {
            const VkBufferCopy region{offset, 0, byte_count};
            vkCmdCopyBuffer(context.commands(), context.buffer(buffer).handle(), context.buffer(*target).handle(), 1,
                            &region);
        });
}

void write_velocities(std::span<const float> moved, std::span<const float> excess, double substeps_per_second,
                      std::span<float> velocities) {
    for (std::size_t i = 0; i < moved.size(); ++i) {
        const double sum = static_cast<double>(moved[i]) + static_cast<double>(excess[i]);
        velocities[i] = i % 4 == 3 ? 0.0f : static_cast<float>(sum * substeps_per_second);  // w counts something else
    }
}

}  // namespace drape
