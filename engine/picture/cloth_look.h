// What the shaders of a cloth are and are told, for each view.
#pragma once

#include <array>
#include <memory>

#include "drape/view.h"
#include "picture/raster_cloth.h"
#include "picture/strain_scale.h"
#include "shared/raster_types.h"
#include "vulkan/pipeline.h"

namespace drape {

struct ClothShaders {
    const char *vertex, *fragment;
    bool lit;
};
ClothShaders cloth_shaders(View view);

/// The pipelines for cloths, chosen by what a cloth has.
struct ClothPipelines {
    std::unique_ptr<vulkan::GraphicsPipeline> whole, masked, cut;
    const vulkan::GraphicsPipeline& of(const RasterCloth& cloth) const;
};

/// Returns the constants of a view's fragment shader that say what its cloths have: whatever none has is left out.
std::vector<vulkan::SpecializationConstant> look_constants(View view, const std::vector<Cloth>& cloths);
/// Returns whether pictures of this view show textures.
bool shows_textures(View view, const std::vector<Cloth>& cloths);

/// `texture`: its place (ClothPush::texture), zeros without one; `first_place`: PanelPlaces::first.
glsl::ClothPush cloth_push(const RasterCloth& cloth, const glsl::uvec4& texture = {}, float first_place = -1);
glsl::StrainPush strain_push(const RasterCloth& cloth, const StrainScale& scale);
/// Returns which springs a heat map looks at.
std::uint32_t strain_number(View view);
/// Returns the colours as radiance: the tone curve turns them into the map's own colours.
std::array<glsl::vec4, glsl::heat_color_count> heat_colors(const ColorMap& map);

}  // namespace drape
