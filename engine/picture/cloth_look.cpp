#include "picture/cloth_look.h"

#include <algorithm>
#include <cmath>

#include "include/tone.h"
#include "picture/collider_mesh.h"

namespace drape {
namespace {

glsl::uint pattern_number(Pattern pattern) {
    switch (pattern) {
        case Pattern::plain:
            return glsl::pattern_plain;
        case Pattern::checker:
            return glsl::pattern_checker;
        case Pattern::stripes:
            return glsl::pattern_stripes;
    }
    return glsl::pattern_plain;
}

}  // namespace

glsl::ClothPush cloth_push(const RasterCloth& cloth, const glsl::uvec4& texture, float first_place) {
    const Appearance& look = cloth.appearance;
    const auto u = static_cast<float>(cloth.size_u);
    const auto v = static_cast<float>(cloth.size_v);
    // Folds are searched for at a distance of a sixteenth of the cloth.
    const std::uint32_t reach = std::max(1u, std::max(cloth.columns, cloth.rows) / 16);
    glsl::vec4 second = linear_color(look.second);
    second.w = static_cast<float>(look.sheen);
    return {{cloth.columns, cloth.rows, pattern_number(look.pattern), reach},
            {u, v, std::min(u, v) / 8, static_cast<float>(cloth.thickness)},
            linear_color(look.front),
            linear_color(back_of(look)),
            second,
            {static_cast<float>(std::pow(look.roughness, 4)), static_cast<float>(look.weave),
             static_cast<float>(look.hem), first_place},
            texture};
}

glsl::StrainPush strain_push(const RasterCloth& cloth, const StrainScale& scale) {
    const double origin = scale.place_of(0), one = scale.knee > 0 ? 1 - origin : 1 / (scale.high - scale.low);
    const double per_knee = scale.knee > 0 ? 1 / scale.knee : 0;
    return {{cloth.columns, cloth.rows, 0, 0},
            {static_cast<float>(cloth.rest_lengths[0]), static_cast<float>(cloth.rest_lengths[1]), 0,
             static_cast<float>(cloth.thickness)},
            {static_cast<float>(one), static_cast<float>(origin), static_cast<float>(per_knee),
             static_cast<float>(scale.knee > 0 ? 1 / std::log1p(knees_to_end) : 0)}};
}

/// Returns the colours as radiance: the tone curve turns them into the map's own colours.
std::array<glsl::vec4, glsl::heat_color_count> heat_colors(const ColorMap& map) {
    std::array<glsl::vec4, glsl::heat_color_count> colors{};
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const std::array<double, 3> shown = color_at(map, static_cast<double>(i) / (colors.size() - 1.0));
        const glsl::vec4 color = linear_color({shown[0] / 255, shown[1] / 255, shown[2] / 255});
        colors[i] = {glsl::untoned(color.x), glsl::untoned(color.y), glsl::untoned(color.z), 0};
    }
    return colors;
}

ClothShaders cloth_shaders(View view) {
    switch (view) {
        case View::stretch:
        case View::warp:
        case View::weft:
            return {"strain.vert", "strain.frag", false};
        case View::wire:
            return {"cloth.vert", "wire.frag", true};
        case View::normals:
            return {"cloth.vert", "normals.frag", false};
        case View::shaded:
            break;
    }
    return {"cloth.vert", "cloth.frag", true};
}

const vulkan::GraphicsPipeline& ClothPipelines::of(const RasterCloth& cloth) const {
    if (cloth.cut_vertices.valid()) return *cut;
    return cloth.spring_shares.valid() && masked ? *masked : *whole;
}

std::uint32_t strain_number(View view) {
    return static_cast<std::uint32_t>(view == View::warp   ? glsl::strain_of_warp
                                      : view == View::weft ? glsl::strain_of_weft
                                                           : glsl::strain_of_both);
}

bool shows_textures(View view, const std::vector<Cloth>& cloths) {
    return view == View::shaded &&
           std::ranges::any_of(cloths, [](const Cloth& cloth) { return cloth.appearance.image.get() != nullptr; });
}

std::vector<vulkan::SpecializationConstant> look_constants(View view, const std::vector<Cloth>& cloths) {
    if (view != View::shaded) return {};
    const auto any = [&](bool (*has)(const Appearance&)) {
        return std::uint32_t{std::ranges::any_of(cloths, [has](const Cloth& cloth) { return has(cloth.appearance); })};
    };
    return {{"glossy", any([](const Appearance& look) { return look.roughness < 1; })},
            {"has_threads", any([](const Appearance& look) { return look.weave > 0; })},
            {"has_hem", any([](const Appearance& look) { return look.hem > 0; })},
            {"has_texture", std::uint32_t{shows_textures(view, cloths)}}};
}

}  // namespace drape
