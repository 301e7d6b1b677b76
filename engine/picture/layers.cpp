#include "picture/layers.h"

#include <cstddef>
#include <cstring>

#include "picture/raster_recording.h"
#include "vulkan/api.h"
#include "vulkan/resources.h"

namespace drape {

using graph::Access;

namespace {

constexpr VkFormat pixel_format = VK_FORMAT_R32G32B32A32_UINT;
constexpr VkFormat depth_format = VK_FORMAT_D32_SFLOAT;
static_assert(sizeof(LayerPixel) == 16 && offsetof(LayerPixel, normal) == 4 && offsetof(LayerPixel, id) == 10 &&
              offsetof(LayerPixel, strain) == 12);  // as shaders/include/layer.h packs it

constexpr const char *frame_name = "layers/frame", *colliders_name = "layers/colliders", *meshes_name = "layers/meshes",
                     *pixels_name = "layers", *depth_name = "layers/depth", *readback_name = "layers/readback";

/// Pictures have no floor where they have an alpha channel.
std::optional<std::size_t> left_out(const SceneDescription& scene, const FrameView& view) {
    return scene.image.alpha ? view.floor() : std::nullopt;
}

/// Returns what strain.vert needs to pass on the strain itself.
glsl::StrainPush layer_push(const RasterCloth& cloth, std::uint32_t id) {
    return {{cloth.columns, cloth.rows, id, 0},
            {static_cast<float>(cloth.rest_lengths[0]), static_cast<float>(cloth.rest_lengths[1]), 0,
             static_cast<float>(cloth.thickness)},
            {1, 0, 0, 0}};
}

}  // namespace

LayerPass::LayerPass(const vulkan::Device& device, const SceneDescription& scene, std::uint32_t width,
                     std::uint32_t height, bool cut, bool masked)
    : width_(width),
      height_(height),
      frame_view_(scene, {picture_camera(scene, width, height), scene_extent(scene), width, height}),
      bodies_(scene, left_out(scene, frame_view_)),
      ids_(bodies_.ids(scene.cloths.size())) {
    if (!scene.cloths.empty()) make_cloth_pipelines(device, cut, masked);
    make_body_pipelines(device, scene);
}

void LayerPass::make_cloth_pipelines(const vulkan::Device& device, bool cut, bool masked) {
    vulkan::GraphicsState state;
    state.vertex = {"strain.vert"}, state.fragment = {"layer_cloth.frag"};
    state.color_format = pixel_format;
    state.depth_format = depth_format;
    state.constants = {{"shown", static_cast<std::uint32_t>(glsl::strain_of_both)}};
    const auto make = [&](const char* name) { return std::make_unique<vulkan::GraphicsPipeline>(device, name, state); };
    cloth_pipelines_.whole = make("layers of cloth");
    if (masked || cut) state.constants.push_back({"masked", 1});
    if (masked) cloth_pipelines_.masked = make("layers of masked cloth");
    state.constants.push_back({"cut", 1});
    if (cut) cloth_pipelines_.cut = make("layers of cut cloth");
}

void LayerPass::make_body_pipelines(const vulkan::Device& device, const SceneDescription& scene) {
    vulkan::GraphicsState state;
    state.vertex = {"layer_collider.vert"}, state.fragment = {"layer_collider.frag"};
    state.color_format = pixel_format;
    state.depth_format = depth_format;
    const double end = scene.time.frame_count / scene.time.fps;
    for (const ColliderDraw& range : collider_draws(bodies_.at(0), bodies_.columns(frame_view_, end, height_))) {
        state.constants = body_constants(range);
        state.cull = body_cull(range);
        draws_.push_back({range, std::make_unique<vulkan::GraphicsPipeline>(device, "layers of bodies", state)});
    }
}

LayerPass::Targets LayerPass::declare(graph::Graph& graph) const {
    Targets targets;
    targets.frame = graph.buffer<glsl::FrameConstants>(frame_name, 1, graph::Lifetime::host_input);
    if (bodies_.count() > 0)
        targets.colliders =
            graph.buffer<glsl::ColliderInstance>(colliders_name, bodies_.count(), graph::Lifetime::host_input);
    if (!bodies_.corners().empty())
        targets.meshes =
            graph.buffer<glsl::MeshCorner>(meshes_name, bodies_.corners().size(),
                                           bodies_.deform() ? graph::Lifetime::host_input : graph::Lifetime::constant);
    targets.pixels = graph.image({pixels_name, pixel_format, width_, height_});
    targets.depth = graph.image({depth_name, depth_format, width_, height_});
    return targets;
}

void LayerPass::add(graph::Graph& graph, std::span<const RasterCloth> cloths) const {
    Targets targets = declare(graph);
    const std::vector<RasterCloth> kept(cloths.begin(), cloths.end());
    auto attachments = std::make_shared<RasterAttachments>();
    graph.add_pass(
        {"layers", "layers", "layers"},
        [&](graph::PassSetup& setup) {
            setup.read(targets.frame, Access::vertex_read);
            if (targets.colliders.valid()) setup.read(targets.colliders, Access::vertex_read);
            if (targets.meshes.valid()) setup.read(targets.meshes, Access::vertex_read);
            for (const RasterCloth& cloth : kept) {
                setup.read(cloth.position, Access::vertex_read);
                setup.read(cloth.normal, Access::vertex_read);
                setup.read(cloth.indices, Access::index_read);
                if (cloth.cut_vertices.valid()) setup.read(cloth.cut_vertices, Access::vertex_read);
                if (cloth.spring_shares.valid()) setup.read(cloth.spring_shares, Access::vertex_read);
            }
            constexpr std::uint32_t infinity = 0x7f800000;  // the bits of a float
            attachments->cleared = VkClearColorValue{.uint32 = {infinity, 0, 0, 0}};
            attachments->color = targets.pixels = setup.write(targets.pixels, Access::color_write);
            attachments->depth = setup.write(targets.depth, Access::depth_write);
        },
        [this, attachments, kept, targets](graph::PassContext& context) {
            begin_rendering(context, *attachments);
            draw(context, targets, kept);
            vkCmdEndRendering(context.commands());
        });
    const auto copied = std::make_shared<graph::Handle>(  // set by set-up, used when recorded
        graph.buffer(
            {readback_name, std::uint64_t{width_} * height_ * sizeof(LayerPixel), graph::Lifetime::host_output}));
    graph.add_pass(
        {"layers readback", "layers", "layers readback"},
        [&](graph::PassSetup& setup) {
            setup.read(targets.pixels, Access::transfer_read);
            *copied = setup.write(*copied, Access::transfer_write);
        },
        [image = targets.pixels, copied, size = VkExtent3D{width_, height_, 1}](graph::PassContext& context) {
            const VkBufferImageCopy region{0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {}, size};
            vkCmdCopyImageToBuffer(context.commands(), context.image(image).handle(), context.layout(image),
                                   context.buffer(*copied).handle(), 1, &region);
        });
}

void LayerPass::draw(graph::PassContext& context, const Targets& targets,
                     const std::vector<RasterCloth>& cloths) const {
    for (std::uint32_t k = 0; k < cloths.size(); ++k) {
        const RasterCloth& cloth = cloths[k];
        const vulkan::GraphicsPipeline& pipeline = cloth_pipelines_.of(cloth);
        std::vector<graph::Binding> bound{
            {"frame", targets.frame}, {"position", cloth.position}, {"normal", cloth.normal}};
        if (cloth.cut_vertices.valid()) bound.push_back({"cut_vertices", cloth.cut_vertices});
        if (cloth.spring_shares.valid()) bound.push_back({"spring_shares", cloth.spring_shares});
        context.bind(pipeline, bound);
        context.push(pipeline, layer_push(cloth, k + 1));
        draw_cloth(context, cloth.indices, cloth.index_count);
    }
    for (const Draw& each : draws_) {
        std::vector<graph::Binding> bound{{"frame", targets.frame}, {"colliders", targets.colliders}};
        if (each.range.has_corners) bound.push_back({"mesh_corners", targets.meshes});
        context.bind(*each.pipeline, bound);
        draw_colliders(context, each.range);
    }
}

void LayerPass::upload(const graph::ResourcePool& pool) const {
    if (!bodies_.corners().empty() && !bodies_.deform())
        vulkan::upload(pool.device(), pool.buffer(meshes_name), std::as_bytes(std::span(bodies_.corners())));
}

void LayerPass::write_frame(const graph::ResourcePool& pool, std::uint32_t slot, double time,
                            std::span<const BodyState> moved) const {
    const auto write = [&](const char* name, std::span<const std::byte> bytes) {
        std::memcpy(pool.buffer(name, slot).mapped().data(), bytes.data(), bytes.size());
    };
    glsl::FrameConstants constants = frame_view_.constants_at(time);
    constants.above_floor = {0, 0, 0, 1};  // the floor is drawn with the other planes, and hides what is below it
    write(frame_name, std::as_bytes(std::span(&constants, 1)));
    const std::vector<glsl::ColliderInstance> instances =
        collider_instances(bodies_.at(time, moved), frame_view_.plane_extent_at(time), time, ids_);
    if (!instances.empty()) write(colliders_name, std::as_bytes(std::span(instances)));
    if (bodies_.deform()) {
        const std::vector<glsl::MeshCorner> corners = bodies_.corners_at(time);
        write(meshes_name, std::as_bytes(std::span(corners)));
    }
}

std::span<const LayerPixel> LayerPass::pixels(const graph::ResourcePool& pool, std::uint32_t slot) const {
    const std::span<std::byte> bytes = pool.buffer(readback_name, slot).mapped();
    return {reinterpret_cast<const LayerPixel*>(bytes.data()), std::size_t{width_} * height_};
}

}  // namespace drape
