// Draws the picture of a frame: cloths from their images, colliders as their true shapes, the first light's shadow, and
// the copy that the host reads.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drape/frame.h"
#include "drape/scene.h"
#include "drape/view.h"
#include "graph/executor.h"
#include "picture/cloth_look.h"
#include "picture/collider_mesh.h"
#include "picture/drawn_bodies.h"
#include "picture/ground_shade.h"
#include "picture/panel_places.h"
#include "picture/picture_tiles.h"
#include "picture/raster_cloth.h"
#include "picture/raster_frame.h"
#include "picture/strain_scale.h"
#include "picture/textures.h"
#include "shared/raster_types.h"
#include "solver/pass_kit.h"
#include "vulkan/pipeline.h"

namespace drape {

struct RasterOptions {
    bool shadow = true;
    bool ground_shade = true;  ///< the floor is darker where cloth and bodies stand between it and the sky
    PictureView view;
    bool cut = false;     ///< some cloth has cut vertices: their pipelines are made
    bool masked = false;  ///< some cloth has spring shares: their pipelines are made
    /// The picture is shifted by so many pixels to the right and down: the mean of pictures shifted by parts of a pixel
    /// is a picture with many samples.
    std::array<double, 2> shift{0, 0};
    /// Whether fragments receive the frame's constants with their triangle (shaders/include/lit_constants.h), which
    /// changes no byte; nothing: the faster way for the device.
    std::optional<bool> constants_by_triangle;
};

class RasterPass {
  public:
    /// Makes the pipelines that the scene needs. `samples`: 1 or 4.
    RasterPass(const vulkan::Device& device, const SceneDescription& scene, std::uint32_t width, std::uint32_t height,
               std::uint32_t samples, const RasterOptions& options = {});
    RasterPass(const RasterPass&) = delete;
    RasterPass& operator=(const RasterPass&) = delete;

    /// Declares the frame's host inputs, the attachments and the passes of the stages "shadow" and "raster"; returns
    /// the host_output buffer `readback_name`: width x height RGBA8 (sRGB encoded, straight alpha), rows from the top,
    /// tightly packed.
    /// The graph's plans may run as long as this object lives.
    graph::Handle add(graph::Graph& graph, std::span<const RasterCloth> cloths) const;

    /// Fills the data that is the same in all frames; call it once for each pool.
    void upload(const graph::ResourcePool& pool) const;

    /// Fills the host inputs of a slot for the picture at `time` (s).
    /// `moved`: where bodies that cloth moves are.
    void write_frame(const graph::ResourcePool& pool, std::uint32_t slot, double time,
                     std::span<const BodyState> moved = {}) const;

    /// Draws into a picture that was read back what the host draws: the legend of a heat map.
    void finish(std::span<std::byte> rgba) const;

    /// Returns whether the encoding pass reads the samples themselves instead of a resolved image.
    bool is_sampled() const { return samples_ > 1 && !resolves_; }
    bool casts_shadow() const { return around_.shadow_skip_reason.empty(); }
    std::uint64_t readback_byte_count() const;

    static constexpr const char* readback_name = "color/readback";
    static constexpr const char* frame_name = "raster/frame";
    static constexpr const char* colliders_name = "raster/colliders";
    static constexpr const char* meshes_name = "raster/meshes";
    static constexpr const char* heat_colors_name = "raster/heat colors";
    static constexpr const char* body_tiles_name = "raster/tiles of bodies";
    static constexpr const char* tiles_name = "raster/tiles";
    static constexpr const char* textures_name = "raster/textures";
    static constexpr const char* panels_name = "raster/places on panels";
    static constexpr const char* light_name = "light";  ///< radiance
    static constexpr const char* resolved_name = "light/resolved";
    static constexpr const char* depth_name = "depth";
    static constexpr const char* shadow_map_name = "shadow/map";
    static constexpr const char* shadow_depth_name = "shadow/depth";
    static constexpr const char* shadow_rows_name = "shadow/rows";

  private:
    struct Draw {
        ColliderDraw range;
        std::unique_ptr<vulkan::GraphicsPipeline> pipeline;
    };
    struct Targets;

    void make_cloth_pipelines(const vulkan::Device& device, const SceneDescription& scene, const RasterOptions& options,
                              vulkan::GraphicsState state, vulkan::GraphicsState shadow_state);
    void make_pipelines(const vulkan::Device& device, const SceneDescription& scene, const RasterOptions& options);
    void make_compute_pipelines(bool cut);
    Targets declare(graph::Graph& graph) const;
    void add_shadow(graph::Graph& graph, Targets& targets, const std::vector<RasterCloth>& cloths) const;
    void add_tiles(graph::Graph& graph, Targets& targets, const std::vector<RasterCloth>& cloths) const;
    void add_raster(graph::Graph& graph, Targets& targets, const std::vector<RasterCloth>& cloths) const;
    graph::Handle add_encoding(graph::Graph& graph, const Targets& targets) const;
    void draw_bodies(graph::PassContext& context, const Targets& targets, const std::vector<Draw>& draws,
                     const std::vector<graph::Binding>& shared) const;
    void draw_picture(graph::PassContext& context, const Targets& targets,
                      const std::vector<RasterCloth>& cloths) const;

    /// This is what is drawn behind cloths and bodies, and what falls on them.
    struct Surroundings {
        bool has_floor = false;              ///< a plane that is not among the bodies: the encoding pass draws it
        bool has_alpha = false;              ///< neither that nor the backdrop is drawn
        std::optional<GroundShade> shade{};  ///< on the floor
        std::string shade_skip_reason{};     ///< why there is none
        std::string shadow_skip_reason{};    ///< empty: there is a shadow
    };
    /// This is what the cloths show.
    struct Surfaces {
        std::optional<Textures> textures;
        PanelPlaces panels;
    };
    struct AllPipelines {
        Pipelines compute;
        ClothPipelines cloth{}, shadow_cloth{};
        std::vector<Draw> draws{}, shadow_draws{};
        std::unique_ptr<vulkan::GraphicsPipeline> clearing{};
        const vulkan::ComputePipeline* shadow_rows = nullptr;  ///< none without a shadow
        std::uint32_t shadow_rows_invocations = 0;
        const vulkan::ComputePipeline* encoding = nullptr;
        const vulkan::ComputePipeline *cloth_tiles = nullptr,
                                      *cut_cloth_tiles = nullptr;  ///< none of cut cloth without
    };

    std::uint32_t width_, height_, samples_;
    PictureTiles tiles_;
    FrameView frame_view_;
    bool resolves_;  ///< the samples, where the encoding pass cannot read them
    DrawnBodies bodies_;
    Surroundings around_;
    View view_;
    Surfaces surfaces_;
    std::optional<StrainScale> scale_;  ///< set for a heat map
    AllPipelines pipelines_;
};

}  // namespace drape
