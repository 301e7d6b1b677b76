#include "passes/raster_interfaces.h"

#include <cstddef>

#include "passes/declare.h"
#include "passes/struct_layouts.h"
#include "shared/raster_types.h"

namespace drape::raster_interfaces {
namespace {

using namespace glsl;

constexpr vulkan::MemberLayout frame_members[] = {
    {"clip_from_world", offsetof(FrameConstants, clip_from_world)},
    {"shadow_from_world", offsetof(FrameConstants, shadow_from_world)},
    {"eye", offsetof(FrameConstants, eye)},
    {"ambient", offsetof(FrameConstants, ambient)},
    {"background", offsetof(FrameConstants, background)},
    {"fade", offsetof(FrameConstants, fade)},
    {"to_light", offsetof(FrameConstants, to_light)},
    {"light_radiance", offsetof(FrameConstants, light_radiance)},
};
constexpr vulkan::StructLayout frame_layout{"FrameConstants", sizeof(FrameConstants), frame_members};

constexpr vulkan::MemberLayout collider_members[] = {
    {"pose_x", offsetof(ColliderInstance, pose_x)}, {"pose_y", offsetof(ColliderInstance, pose_y)},
    {"pose_z", offsetof(ColliderInstance, pose_z)}, {"shape", offsetof(ColliderInstance, shape)},
    {"color", offsetof(ColliderInstance, color)},
};
constexpr vulkan::StructLayout collider_layout{"ColliderInstance", sizeof(ColliderInstance), collider_members};

constexpr vulkan::MemberLayout push_members[] = {
    {"grid", offsetof(ClothPush, grid)},
    {"size", offsetof(ClothPush, size)},
    {"front", offsetof(ClothPush, front)},
    {"back", offsetof(ClothPush, back)},
};
constexpr vulkan::StructLayout push_layout{"ClothPush", sizeof(ClothPush), push_members};

constexpr auto frame = struct_buffer_read(frame_binding, "Frame", &frame_layout);
constexpr auto colliders = struct_buffer_read(colliders_binding, "Colliders", &collider_layout);
constexpr auto position = image_read(position_binding, "position");
constexpr auto normal = image_read(normal_binding, "normal");
constexpr auto shadow_map = image_read(shadow_map_binding, "shadow_map", VK_FORMAT_R32_SFLOAT);

constexpr vulkan::DescriptorDeclaration frame_alone[] = {frame};
constexpr vulkan::DescriptorDeclaration frame_and_map[] = {frame, shadow_map};
constexpr vulkan::DescriptorDeclaration cloth_images[] = {frame, position, normal};
constexpr vulkan::DescriptorDeclaration cloth_positions[] = {frame, position};
const auto cut_vertices = struct_buffer_read(cut_vertices_binding, "CutVertices", &layouts::cut_vertex);
const vulkan::DescriptorDeclaration cut_cloth_images[] = {frame, position, normal, cut_vertices};
const vulkan::DescriptorDeclaration cut_cloth_positions[] = {frame, position, cut_vertices};
constexpr vulkan::DescriptorDeclaration frame_and_colliders[] = {frame, colliders};

}  // namespace

const vulkan::ShaderInterface cloth_vertex{"cloth.vert", cloth_images, &push_layout};
const vulkan::ShaderInterface cut_cloth_vertex{"cloth_cut.vert", cut_cloth_images, &push_layout};
const vulkan::ShaderInterface shadow_cut_cloth_vertex{"shadow_cloth_cut.vert", cut_cloth_positions, &push_layout};
const vulkan::ShaderInterface cloth_fragment{"cloth.frag", frame_alone, &push_layout};
const vulkan::ShaderInterface cloth_shadowed_fragment{"cloth_shadowed.frag", frame_and_map, &push_layout};
const vulkan::ShaderInterface collider_vertex{"collider.vert", frame_and_colliders};
const vulkan::ShaderInterface collider_fragment{"collider.frag", frame_alone};
const vulkan::ShaderInterface collider_shadowed_fragment{"collider_shadowed.frag", frame_and_map};
const vulkan::ShaderInterface shadow_cloth_vertex{"shadow_cloth.vert", cloth_positions, &push_layout};
const vulkan::ShaderInterface shadow_collider_vertex{"shadow_collider.vert", frame_and_colliders};
const vulkan::ShaderInterface shadow_fragment{"shadow.frag", {}};

}  // namespace drape::raster_interfaces
