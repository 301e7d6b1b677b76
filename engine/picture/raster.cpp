#include "picture/raster.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>

#include "picture/cloth_look.h"
#include "picture/legend.h"
#include "picture/raster_frame.h"
#include "picture/raster_recording.h"
#include "solver/kernel_choice.h"
#include "vulkan/api.h"
#include "vulkan/resources.h"

namespace drape {

using graph::Access;
using graph::Handle;

/// The passes of a frame write these resources one after the other; the handles are the newest versions.
struct RasterPass::Targets {
    Handle frame;
    Handle colliders;    ///< invalid where no body is drawn
    Handle meshes;       ///< invalid where no mesh is
    Handle heat_colors;  ///< invalid where the view is no heat map
    Handle textures;     ///< invalid where none is shown
    Handle panels;       ///< invalid where no cloth has an outline
    Handle body_tiles, tiles;
    Handle depth;
    Handle drawn, light;  ///< radiance as it is drawn, and as it is encoded: the same, unless samples are resolved
    Handle shadow_map, shadow_depth, shadow_rows;  ///< invalid without a shadow
    Handle ground_shade;                           ///< invalid without it
};

namespace {

/// The format allows radiance beyond 1, and light is averaged before it is encoded.
constexpr VkFormat light_format = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat depth_format = VK_FORMAT_D32_SFLOAT;
constexpr VkFormat shadow_format = VK_FORMAT_R32_SFLOAT;

std::string shadow_skip_reason(const SceneDescription& scene, const RasterOptions& options) {
    if (!options.shadow) return "switched off";
    if (scene.lights.empty()) return "the scene has no light";
    if (!(scene.lights[0].intensity > 0)) return "the first light has no intensity";
    const auto casts = [](const ColliderDraw& draw) { return draw.casts_shadow; };
    if (scene.cloths.empty() && std::ranges::none_of(collider_draws(scene.colliders, {}), casts))
        return "the scene has nothing that casts one";
    return {};
}

std::string ground_shade_skip_reason(bool has_floor, const SceneDescription& scene, const RasterOptions& options) {
    if (!options.ground_shade) return "switched off";
    if (!has_floor) return "no floor is drawn";
    const auto bounded = [](const Collider& body) { return !special(body.shape).plane; };
    if (scene.cloths.empty() && std::ranges::none_of(scene.colliders, bounded)) return "nothing stands above the floor";
    return {};
}

}  // namespace

RasterPass::RasterPass(const vulkan::Device& device, const SceneDescription& scene, std::uint32_t width,
                       std::uint32_t height, std::uint32_t samples, const RasterOptions& options)
    : width_(width),
      height_(height),
      samples_(samples),
      tiles_(width, height),
      frame_view_(scene, {picture_camera(scene, width, height), scene_extent(scene), width, height, options.shift}),
      resolves_(samples > 1 && !device.capabilities().samples_in_shaders),
      bodies_(scene, frame_view_.floor()),
      view_(options.view.kind),
      surfaces_{{}, PanelPlaces(view_, scene.cloths)},
      scale_(strain_scale(options.view, scene)),
      pipelines_{.compute = Pipelines(device)} {
    if (samples != 1 && samples != 4) throw vulkan::VulkanError("raster: samples must be 1 or 4");
    const std::optional<std::size_t> floor = frame_view_.floor();
    if (shows_textures(view_, scene.cloths)) surfaces_.textures.emplace(scene.cloths);
    around_.shadow_skip_reason = shadow_skip_reason(scene, options);
    around_.has_alpha = scene.image.alpha;
    around_.has_floor = floor && !around_.has_alpha;
    around_.shade_skip_reason = ground_shade_skip_reason(around_.has_floor, scene, options);
    if (around_.shade_skip_reason.empty())
        around_.shade.emplace(pipelines_.compute, ground_map(scene.colliders[*floor], frame_view_.extent()),
                              bodies_.colliders(), options.cut);
    make_pipelines(device, scene, options);
    make_compute_pipelines(options.cut);
}

void RasterPass::make_cloth_pipelines(const vulkan::Device& device, const SceneDescription& scene,
                                      const RasterOptions& options, vulkan::GraphicsState state,
                                      vulkan::GraphicsState shadow_state) {
    const ClothShaders shaders = cloth_shaders(view_);
    const bool strain = scale_.has_value(), shadow = casts_shadow();
    state.vertex = {shaders.vertex}, state.fragment = {shaders.fragment};
    shadow_state.vertex = {"shadow_cloth.vert"};
    if (!shaders.lit) state.constants.clear();
    if (strain) state.constants = {{"shown", strain_number(view_)}};
    const auto looks = look_constants(view_, scene.cloths);
    state.constants.insert(state.constants.end(), looks.begin(), looks.end());
    if (!surfaces_.panels.empty()) state.constants.push_back({"has_panels", 1});
    const auto make = [&](const char* name, vulkan::GraphicsState of,
                          std::initializer_list<vulkan::SpecializationConstant> more = {}) {
        of.constants.insert(of.constants.end(), more);
        return std::make_unique<vulkan::GraphicsPipeline>(device, name, of);
    };
    pipelines_.cloth.whole = make("raster cloth", state);
    if (shadow) pipelines_.shadow_cloth.whole = make("shadow cloth", shadow_state);
    if (strain && options.masked) pipelines_.cloth.masked = make("raster masked cloth", state, {{"masked", 1}});
    if (!options.cut) return;
    if (strain) state.constants.push_back({"masked", 1});
    pipelines_.cloth.cut = make("raster cut cloth", state, {{"cut", 1}});
    if (shadow) pipelines_.shadow_cloth.cut = make("shadow cut cloth", shadow_state, {{"cut", 1}});
}

void RasterPass::make_pipelines(const vulkan::Device& device, const SceneDescription& scene,
                                const RasterOptions& options) {
    const bool shadow = casts_shadow();
    const bool by_triangle = options.constants_by_triangle.value_or(device_kind(device.info()) == DeviceKind::cpu);
    const std::vector<vulkan::SpecializationConstant> lit{{"light_count", light_count(scene)},
                                                          {"constants_by_triangle", by_triangle ? 1u : 0u},
                                                          {"shadowed", shadow ? 1u : 0u}};
    vulkan::GraphicsState state;
    state.color_format = light_format;
    state.depth_format = depth_format;
    state.samples = samples_ == 4 ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT;
    vulkan::GraphicsState shadow_state = state, clear_state = state;
    clear_state.vertex = {"clear.vert"}, clear_state.fragment = {"clear.frag"};
    clear_state.constants = tiles_.constants();
    clear_state.depth_compare = VK_COMPARE_OP_ALWAYS;
    pipelines_.clearing = std::make_unique<vulkan::GraphicsPipeline>(device, "raster clear", clear_state);
    state.constants = lit;
    shadow_state.color_format = shadow_format;
    shadow_state.samples = VK_SAMPLE_COUNT_1_BIT;
    shadow_state.fragment = {"shadow.frag"};
    if (!scene.cloths.empty()) make_cloth_pipelines(device, scene, options, state, shadow_state);
    state.vertex = {"collider.vert"}, state.fragment = {"collider.frag"};
    shadow_state.vertex = {"shadow_collider.vert"};
    const double end = scene.time.frame_count / scene.time.fps;
    for (const ColliderDraw& range : collider_draws(bodies_.at(0), bodies_.columns(frame_view_, end, height_))) {
        state.constants = shadow_state.constants = body_constants(range);
        state.constants.insert(state.constants.end(), lit.begin(), lit.end());
        state.cull = body_cull(range);
        // The y axis of the shadow map points up, so there the outer side turns the other way.
        shadow_state.cull = range.closed ? VK_CULL_MODE_FRONT_BIT : VK_CULL_MODE_NONE;
        pipelines_.draws.push_back(
            {range, std::make_unique<vulkan::GraphicsPipeline>(device, "raster collider", state)});
        if (!shadow || !range.casts_shadow) continue;
        pipelines_.shadow_draws.push_back(
            {range, std::make_unique<vulkan::GraphicsPipeline>(device, "shadow collider", shadow_state)});
    }
}

void RasterPass::make_compute_pipelines(bool cut) {
    pipelines_.encoding = &pipelines_.compute.get("encode.comp", [this](std::string_view name) {
        if (name == "has_floor") return std::uint32_t{around_.has_floor};
        if (name == "has_alpha") return std::uint32_t{around_.has_alpha};
        if (name == "has_ground_shade") return std::uint32_t{around_.shade.has_value()};
        if (name == "shadowed") return std::uint32_t{casts_shadow() && around_.has_floor};
        if (name == "sampled") return std::uint32_t{is_sampled()};
        return name == "strip_length" ? pipelines_.compute.strip_length() : tiles_.constant(name);
    });
    const auto tiles_of = [this](bool of_cut) {
        return &pipelines_.compute.get("cloth_tiles.comp", [this, of_cut](std::string_view name) {
            return name == "cut" ? std::uint32_t{of_cut} : tiles_.constant(name);
        });
    };
    pipelines_.cloth_tiles = tiles_of(false);
    if (cut) pipelines_.cut_cloth_tiles = tiles_of(true);
    if (!casts_shadow()) return;
    constexpr auto side = static_cast<std::uint32_t>(glsl::shadow_map_size);
    const std::uint32_t texels_each = std::max(4u, pipelines_.compute.strip_rows());
    pipelines_.shadow_rows = &pipelines_.compute.get("shadow_rows.comp", [=](std::string_view) { return texels_each; });
    pipelines_.shadow_rows_invocations = side * side / texels_each;
}

RasterPass::Targets RasterPass::declare(graph::Graph& graph) const {
    Targets targets;
    targets.frame = graph.buffer<glsl::FrameConstants>(frame_name, 1, graph::Lifetime::host_input);
    if (const std::size_t count = bodies_.count(); count > 0)
        targets.colliders = graph.buffer<glsl::ColliderInstance>(colliders_name, count, graph::Lifetime::host_input);
    if (!bodies_.corners().empty())
        targets.meshes =
            graph.buffer<glsl::MeshCorner>(meshes_name, bodies_.corners().size(),
                                           bodies_.deform() ? graph::Lifetime::host_input : graph::Lifetime::constant);
    if (scale_)
        targets.heat_colors =
            graph.buffer<glsl::vec4>(heat_colors_name, glsl::heat_color_count, graph::Lifetime::host_input);
    if (surfaces_.textures)
        targets.textures =
            graph.buffer<glsl::uint>(textures_name, surfaces_.textures->halves().size(), graph::Lifetime::constant);
    if (const std::size_t count = surfaces_.panels.all().size(); count > 0)
        targets.panels = graph.buffer<glsl::vec2>(panels_name, count, graph::Lifetime::constant);
    targets.body_tiles = graph.buffer<glsl::uint>(body_tiles_name, tiles_.count(), graph::Lifetime::host_input);
    targets.tiles = graph.buffer<glsl::uint>(tiles_name, tiles_.count(), graph::Lifetime::transient);
    const auto samples = samples_ == 4 ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT;
    targets.drawn = targets.light = graph.image({light_name, light_format, width_, height_, samples});
    if (resolves_) targets.light = graph.image({resolved_name, light_format, width_, height_});
    targets.depth = graph.image({depth_name, depth_format, width_, height_, samples});
    if (casts_shadow()) {
        const std::uint32_t side = glsl::shadow_map_size;
        targets.shadow_map = graph.image({shadow_map_name, shadow_format, side, side});
        targets.shadow_depth = graph.image({shadow_depth_name, depth_format, side, side});
        targets.shadow_rows = graph.buffer({.name = shadow_rows_name,
                                            .byte_count = std::uint64_t{side} * side * sizeof(glsl::vec4),
                                            .element = &glsl::layout_of<glsl::vec4>(),
                                            .texels = true});
    }
    return targets;
}

Handle RasterPass::add(graph::Graph& graph, std::span<const RasterCloth> cloths) const {
    Targets targets = declare(graph);
    const std::vector<RasterCloth> kept(cloths.begin(), cloths.end());
    if (casts_shadow()) {
        add_shadow(graph, targets, kept);
    } else {
        graph.skip("shadow", around_.shadow_skip_reason);
    }
    if (around_.shade) {
        targets.ground_shade = around_.shade->add(graph, cloths);
    } else {
        graph.skip("ground shade", around_.shade_skip_reason);
    }
    add_tiles(graph, targets, kept);
    add_raster(graph, targets, kept);
    return add_encoding(graph, targets);
}

void RasterPass::add_shadow(graph::Graph& graph, Targets& targets, const std::vector<RasterCloth>& cloths) const {
    auto attachments = std::make_shared<RasterAttachments>();
    graph.add_pass(
        {"shadow", "shadow", "shadow"},
        [&](graph::PassSetup& setup) {
            setup.read(targets.frame, Access::vertex_read);
            if (!pipelines_.draws.empty()) setup.read(targets.colliders, Access::vertex_read);
            if (targets.meshes.valid()) setup.read(targets.meshes, Access::vertex_read);
            for (const RasterCloth& cloth : cloths) {
                setup.read(cloth.position, Access::vertex_read);
                setup.read(cloth.indices, Access::index_read);
                if (cloth.cut_vertices.valid()) setup.read(cloth.cut_vertices, Access::vertex_read);
            }
            attachments->cleared = VkClearColorValue{.float32 = {1, 1, 1, 1}};
            attachments->color = targets.shadow_map = setup.write(targets.shadow_map, Access::color_write);
            attachments->depth = setup.write(targets.shadow_depth, Access::depth_write);
        },
        [this, attachments, cloths, targets](graph::PassContext& context) {
            begin_rendering(context, *attachments);
            for (const RasterCloth& cloth : cloths) {
                const bool cut = cloth.cut_vertices.valid();
                const vulkan::GraphicsPipeline& pipeline = pipelines_.shadow_cloth.of(cloth);
                std::vector<graph::Binding> bound{{"frame", targets.frame}, {"position", cloth.position}};
                if (cut) bound.push_back({"cut_vertices", cloth.cut_vertices});
                context.bind(pipeline, bound);
                context.push(pipeline, cloth_push(cloth));
                draw_cloth(context, cloth.indices, cloth.index_count);
            }
            draw_bodies(context, targets, pipelines_.shadow_draws, {{"frame", targets.frame}});
            vkCmdEndRendering(context.commands());
        });
    graph.add_pass(
        {"shadow rows", "shadow", "shadow rows"},
        [&](graph::PassSetup& setup) {
            setup.read(targets.shadow_map, Access::compute_read, "shadow_map");
            targets.shadow_rows = setup.write(targets.shadow_rows, Access::compute_write, "shadow_rows");
        },
        [this](graph::PassContext& context) {
            context.dispatch(*pipelines_.shadow_rows, {}, pipelines_.shadow_rows_invocations, 1);
        });
}

void RasterPass::add_tiles(graph::Graph& graph, Targets& targets, const std::vector<RasterCloth>& cloths) const {
    const auto copied = std::make_shared<Handle>();
    graph.add_pass(
        {"tiles of bodies", "raster", "tiles of bodies"},
        [&](graph::PassSetup& setup) {
            setup.read(targets.body_tiles, Access::transfer_read);
            *copied = targets.tiles = setup.write(targets.tiles, Access::transfer_write);
        },
        [copied, from = targets.body_tiles, size = tiles_.count() * sizeof(glsl::uint)](graph::PassContext& context) {
            const VkBufferCopy region{0, 0, size};
            vkCmdCopyBuffer(context.commands(), context.buffer(from).handle(), context.buffer(*copied).handle(), 1,
                            &region);
        });
    for (const RasterCloth& cloth : cloths) {
        const bool cut = cloth.cut_vertices.valid();
        const std::uint32_t triangles = cloth.index_count / 3;
        graph.add_pass(
            {cloth.name + "/tiles", "raster", "tiles of cloth"},
            [&](graph::PassSetup& setup) {
                setup.read(targets.frame, Access::compute_read, "frame");
                setup.read(cloth.position, Access::compute_read, "position");
                setup.read(cloth.indices, Access::compute_read, "triangles");
                if (cut) setup.read(cloth.cut_vertices, Access::compute_read, "cut_vertices");
                setup.read(targets.tiles, Access::compute_read);
                targets.tiles = setup.write(targets.tiles, Access::compute_write, "tiles");
            },
            [pipeline = cut ? pipelines_.cut_cloth_tiles : pipelines_.cloth_tiles, triangles,
             push = glsl::ClothTilesPush{{cloth.columns, cloth.rows, triangles, 0}}](graph::PassContext& context) {
                context.dispatch(*pipeline, push, triangles, 1);
            });
    }
}

void RasterPass::add_raster(graph::Graph& graph, Targets& targets, const std::vector<RasterCloth>& cloths) const {
    auto attachments = std::make_shared<RasterAttachments>();
    graph.add_pass(
        {"raster", "raster", "raster"},
        [&](graph::PassSetup& setup) {
            setup.read(targets.frame, Access::vertex_read);
            setup.read(targets.frame, Access::fragment_read);
            if (!pipelines_.draws.empty()) setup.read(targets.colliders, Access::vertex_read);
            if (targets.meshes.valid()) setup.read(targets.meshes, Access::vertex_read);
            if (casts_shadow()) setup.read(targets.shadow_rows, Access::fragment_read);
            if (scale_) setup.read(targets.heat_colors, Access::fragment_read);
            if (targets.textures.valid()) setup.read(targets.textures, Access::fragment_read);
            if (targets.panels.valid()) setup.read(targets.panels, Access::vertex_read);
            for (const RasterCloth& cloth : cloths) {
                setup.read(cloth.position, Access::vertex_read);
                setup.read(cloth.normal, Access::vertex_read);
                setup.read(cloth.indices, Access::index_read);
                if (cloth.cut_vertices.valid()) setup.read(cloth.cut_vertices, Access::vertex_read);
                if (scale_ && cloth.spring_shares.valid()) setup.read(cloth.spring_shares, Access::vertex_read);
            }
            setup.read(targets.tiles, Access::vertex_read);
            attachments->color = targets.drawn = setup.write(targets.drawn, Access::color_write);
            attachments->depth = setup.write(targets.depth, Access::depth_write);
            if (resolves_) attachments->resolve = targets.light = setup.write(targets.light, Access::resolve_write);
            if (!resolves_) targets.light = targets.drawn;
        },
        [this, attachments, cloths, targets](graph::PassContext& context) {
            begin_rendering(context, *attachments);
            const graph::Binding bound[] = {{"tiles", targets.tiles}};
            context.bind(*pipelines_.clearing, bound);
            vkCmdDraw(context.commands(), 6, tiles_.count(), 0, 0);
            draw_picture(context, targets, cloths);
            vkCmdEndRendering(context.commands());
        });
}

void RasterPass::draw_picture(graph::PassContext& context, const Targets& targets,
                              const std::vector<RasterCloth>& cloths) const {
    std::vector<graph::Binding> shared{{"frame", targets.frame}};
    if (casts_shadow()) shared.push_back({"shadow_rows", targets.shadow_rows});
    const bool lit = cloth_shaders(view_).lit;
    for (std::size_t k = 0; k < cloths.size(); ++k) {
        const RasterCloth& cloth = cloths[k];
        const vulkan::GraphicsPipeline& pipeline = pipelines_.cloth.of(cloth);
        std::vector<graph::Binding> bound = lit ? shared : std::vector<graph::Binding>{{"frame", targets.frame}};
        bound.insert(bound.end(), {{"position", cloth.position}, {"normal", cloth.normal}});
        if (cloth.cut_vertices.valid()) bound.push_back({"cut_vertices", cloth.cut_vertices});
        if (scale_) bound.push_back({"heat_colors", targets.heat_colors});
        if (surfaces_.textures) bound.push_back({"texels", targets.textures});
        if (targets.panels.valid()) bound.push_back({"panel_places", targets.panels});
        if (scale_ && cloth.spring_shares.valid()) bound.push_back({"spring_shares", cloth.spring_shares});
        context.bind(pipeline, bound);
        if (scale_) context.push(pipeline, strain_push(cloth, *scale_));
        const glsl::uvec4 texture = surfaces_.textures ? surfaces_.textures->place(cloth) : glsl::uvec4{};
        if (!scale_) context.push(pipeline, cloth_push(cloth, texture, surfaces_.panels.first(k)));
        draw_cloth(context, cloth.indices, cloth.index_count);
    }
    draw_bodies(context, targets, pipelines_.draws, shared);
}

void RasterPass::draw_bodies(graph::PassContext& context, const Targets& targets, const std::vector<Draw>& draws,
                             const std::vector<graph::Binding>& shared) const {
    for (const Draw& draw : draws) {
        std::vector<graph::Binding> bound = shared;
        bound.push_back({"colliders", targets.colliders});
        if (draw.range.has_corners) bound.push_back({"mesh_corners", targets.meshes});
        context.bind(*draw.pipeline, bound);
        draw_colliders(context, draw.range);
    }
}

void RasterPass::upload(const graph::ResourcePool& pool) const {
    if (!bodies_.corners().empty() && !bodies_.deform())
        vulkan::upload(pool.device(), pool.buffer(meshes_name), std::as_bytes(std::span(bodies_.corners())));
    if (!surfaces_.panels.empty())
        vulkan::upload(pool.device(), pool.buffer(panels_name), std::as_bytes(surfaces_.panels.all()));
    if (surfaces_.textures)
        vulkan::upload(pool.device(), pool.buffer(textures_name), std::as_bytes(surfaces_.textures->halves()));
}

Handle RasterPass::add_encoding(graph::Graph& graph, const Targets& targets) const {
    Handle picture =
        graph.buffer<glsl::uint>(readback_name, std::uint64_t{width_} * height_, graph::Lifetime::host_output);
    graph.add_pass(
        {"encode", "raster", "encode"},
        [&](graph::PassSetup& setup) {
            setup.read(targets.frame, Access::compute_read, "frame");
            setup.read(targets.light, Access::compute_read, is_sampled() ? "samples" : "light");
            setup.read(targets.tiles, Access::compute_read, "tiles");
            if (casts_shadow() && around_.has_floor)
                setup.read(targets.shadow_rows, Access::compute_read, "shadow_rows");
            if (targets.ground_shade.valid()) setup.read(targets.ground_shade, Access::compute_read, "ground_shade");
            picture = setup.write(picture, Access::compute_write, "pixels");
        },
        [this](graph::PassContext& context) {
            const glsl::GridPush push{{static_cast<int>(width_), static_cast<int>(height_)}};
            const auto [across, down] = pipelines_.compute.over_strips(push.grid);
            context.dispatch(*pipelines_.encoding, push, across, down);
        });
    return picture;
}

void RasterPass::write_frame(const graph::ResourcePool& pool, std::uint32_t slot, double time,
                             std::span<const BodyState> moved) const {
    const auto write = [&](const char* name, std::span<const std::byte> bytes) {
        std::memcpy(pool.buffer(name, slot).mapped().data(), bytes.data(), bytes.size());
    };
    const std::vector<Collider> bodies = bodies_.at(time, moved);
    if (around_.shade) around_.shade->write(pool, slot, std::span(bodies).first(bodies_.colliders().size()), time);
    const std::vector<glsl::ColliderInstance> instances =
        collider_instances(bodies, frame_view_.plane_extent_at(time), time);
    const std::vector<std::uint32_t> marks = tiles_.marks(bodies, time, frame_view_.camera_at(time));
    const glsl::FrameConstants constants = frame_view_.constants_at(time);
    write(body_tiles_name, std::as_bytes(std::span(marks)));
    write(frame_name, std::as_bytes(std::span(&constants, 1)));
    if (!instances.empty()) write(colliders_name, std::as_bytes(std::span(instances)));
    if (bodies_.deform()) {
        const std::vector<glsl::MeshCorner> corners = bodies_.corners_at(time);
        write(meshes_name, std::as_bytes(std::span(corners)));
    }
    if (!scale_) return;
    const auto colors = heat_colors(*scale_->map);
    write(heat_colors_name, std::as_bytes(std::span(colors)));
}

void RasterPass::finish(std::span<std::byte> rgba) const {
    if (scale_) draw_legend({reinterpret_cast<std::uint8_t*>(rgba.data()), rgba.size()}, width_, height_, *scale_);
}

std::uint64_t RasterPass::readback_byte_count() const { return std::uint64_t{4} * width_ * height_; }

}  // namespace drape
