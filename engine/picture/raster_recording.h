#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "graph/executor.h"
#include "picture/collider_mesh.h"
#include "shared/raster_types.h"
#include "vulkan/pipeline.h"

namespace drape {

/// The attachments of a pass, filled while it is set up and used when it is recorded.
struct RasterAttachments {
    graph::Handle color;
    graph::Handle depth = {};                       ///< invalid: none
    graph::Handle resolve;                          ///< invalid: none
    std::optional<VkClearColorValue> cleared = {};  ///< colour, and depth with it; else their contents are undefined
};

/// Begins dynamic rendering over the whole attachments and sets viewport and scissor. Depth is cleared to 1 (the far
/// end) and discarded at the end, like the samples when they are resolved.
void begin_rendering(const graph::PassContext& context, const RasterAttachments& attachments);

void draw_cloth(graph::PassContext& context, graph::Handle indices, std::uint32_t index_count);

void draw_colliders(const graph::PassContext& context, const ColliderDraw& range);
/// Returns the constants of include/collider_mesh.h for a draw, and which sides it leaves out.
std::vector<vulkan::SpecializationConstant> body_constants(const ColliderDraw& range);
VkCullModeFlags body_cull(const ColliderDraw& range);

}  // namespace drape
