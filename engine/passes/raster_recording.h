// The Vulkan commands of the raster passes.
#pragma once

#include <cstdint>
#include <vector>

#include "graph/executor.h"
#include "passes/collider_mesh.h"
#include "shared/raster_types.h"
#include "vulkan/pipeline.h"

namespace drape {

/// What a pass renders into; filled while the pass is set up, used when it is recorded.
struct RasterAttachments {
    graph::Handle color, depth;
    graph::Handle resolve;  ///< invalid: none
};

/// Begins dynamic rendering over the whole attachments, viewport and scissor set; colour and depth are
/// cleared to 1 (the far end), and the depth is forgotten at the end, like the samples when they are
/// resolved.
void begin_rendering(const graph::PassContext& context, const RasterAttachments& attachments);

/// A declared resource and the binding (set 0) that a draw gives it. PassContext::bind gives a pass one set
/// of bindings; here one pass draws several cloths and colliders, each with its own.
struct BoundHandle {
    std::uint32_t binding;
    graph::Handle handle;
};

void bind_pipeline(const graph::PassContext& context, const vulkan::GraphicsPipeline& pipeline);

/// Pushes one handle per descriptor of the pipeline. Throws GraphError when a binding is missing or one too
/// many, a format differs, or the pass did not declare the handle.
void push_bindings(const graph::PassContext& context, const vulkan::GraphicsPipeline& pipeline,
                   const std::vector<BoundHandle>& bound);

void draw_cloth(const graph::PassContext& context, const vulkan::GraphicsPipeline& pipeline,
                const glsl::ClothPush& push, graph::Handle indices, std::uint32_t index_count);

void draw_colliders(const graph::PassContext& context, const ColliderDraw& range);

/// Tightly packed.
void copy_to_buffer(const graph::PassContext& context, graph::Handle image, graph::Handle buffer);

}  // namespace drape
