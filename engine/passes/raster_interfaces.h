// What the C++ side believes of the raster shaders; checked against the SPIR-V when the pipelines are made.
#pragma once

#include "vulkan/shader_interface.h"

namespace drape::raster_interfaces {

extern const vulkan::ShaderInterface cloth_vertex, cloth_fragment, cloth_shadowed_fragment;
extern const vulkan::ShaderInterface collider_vertex, collider_fragment, collider_shadowed_fragment;
extern const vulkan::ShaderInterface shadow_cloth_vertex, shadow_collider_vertex, shadow_fragment;
/// Cloths with vertices on cut springs.
extern const vulkan::ShaderInterface cut_cloth_vertex, shadow_cut_cloth_vertex;

/// Bindings of set 0.
inline constexpr std::uint32_t frame_binding = 0, position_binding = 1, colliders_binding = 1, normal_binding = 2,
                               shadow_map_binding = 3, cut_vertices_binding = 5;
/// Specialization constant of the collider shaders.
inline constexpr std::uint32_t collider_kind_constant = 0;

}  // namespace drape::raster_interfaces
