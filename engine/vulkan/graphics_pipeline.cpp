#include <fmt/format.h>

#include <optional>

#include "vulkan/api.h"
#include "vulkan/pipeline.h"
#include "vulkan/shader_stage.h"
#include "vulkan/structure.h"

namespace drape::vulkan {

namespace {

/// Throws for stages that write: this would need vertexPipelineStoresAndAtomics or fragmentStoresAndAtomics, features
/// that Drape does not require of devices.
void require_read_only(const std::string& pipeline, const ShaderStage& stage) {
    for (const ReflectedDescriptor& descriptor : stage.reflected().descriptors) {
        if (descriptor.writable) {
            throw VulkanError(fmt::format("pipeline {}: {} writes '{}' (binding {}); graphics stages only read",
                                          pipeline, stage.module(), descriptor.name, descriptor.binding));
        }
    }
}

/// The structures of the fixed functions point at each other, so they are built in place and never copied.
struct FixedFunctions {
    explicit FixedFunctions(const GraphicsState& state)
        : has_color(state.color_format != VK_FORMAT_UNDEFINED), color_format(state.color_format) {
        assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
        viewport.viewportCount = 1;
        viewport.scissorCount = 1;
        rasterization.polygonMode = VK_POLYGON_MODE_FILL;
        rasterization.cullMode = state.cull;
        rasterization.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
        rasterization.lineWidth = 1.0f;
        multisample.rasterizationSamples = state.samples;
        depth.depthTestEnable = state.depth_format != VK_FORMAT_UNDEFINED;
        depth.depthWriteEnable = depth.depthTestEnable;
        depth.depthCompareOp = state.depth_compare;
        attachment.colorWriteMask =
            VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
        blend.attachmentCount = has_color ? 1 : 0;
        blend.pAttachments = &attachment;
        dynamic.dynamicStateCount = 2;
        dynamic.pDynamicStates = dynamic_states;
        rendering.colorAttachmentCount = has_color ? 1 : 0;
        rendering.pColorAttachmentFormats = &color_format;
        rendering.depthAttachmentFormat = state.depth_format;
    }
    FixedFunctions(const FixedFunctions&) = delete;
    FixedFunctions& operator=(const FixedFunctions&) = delete;

    VkGraphicsPipelineCreateInfo create_info() const {
        auto info = structure<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
        info.pNext = &rendering;
        info.pVertexInputState = &vertex_input;
        info.pInputAssemblyState = &assembly;
        info.pViewportState = &viewport;
        info.pRasterizationState = &rasterization;
        info.pMultisampleState = &multisample;
        info.pDepthStencilState = &depth;
        info.pColorBlendState = &blend;
        info.pDynamicState = &dynamic;
        return info;
    }

    bool has_color;
    VkFormat color_format;
    VkDynamicState dynamic_states[2] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineColorBlendAttachmentState attachment{};
    VkPipelineVertexInputStateCreateInfo vertex_input =
        structure<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
    VkPipelineInputAssemblyStateCreateInfo assembly =
        structure<VkPipelineInputAssemblyStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
    VkPipelineViewportStateCreateInfo viewport =
        structure<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
    VkPipelineRasterizationStateCreateInfo rasterization =
        structure<VkPipelineRasterizationStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
    VkPipelineMultisampleStateCreateInfo multisample =
        structure<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
    VkPipelineDepthStencilStateCreateInfo depth =
        structure<VkPipelineDepthStencilStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
    VkPipelineColorBlendStateCreateInfo blend =
        structure<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
    VkPipelineDynamicStateCreateInfo dynamic =
        structure<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
    VkPipelineRenderingCreateInfo rendering =
        structure<VkPipelineRenderingCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
};

}  // namespace

GraphicsPipeline::GraphicsPipeline(const Device& device, std::string name, const GraphicsState& state)
    : Pipeline(device, std::move(name), VK_PIPELINE_BIND_POINT_GRAPHICS) {
    const ShaderStage vertex(device, name_, state.vertex, VK_SHADER_STAGE_VERTEX_BIT, state.constants);
    std::optional<ShaderStage> fragment;
    std::vector<const ShaderStage*> stages = {&vertex};
    if (!state.fragment.module.empty()) {
        fragment.emplace(device, name_, state.fragment, VK_SHADER_STAGE_FRAGMENT_BIT, state.constants);
        stages.push_back(&*fragment);
    }
    require_constants(name_, state.constants, stages);
    for (const ShaderStage* stage : stages) require_read_only(name_, *stage);
    make_layout(stages);

    std::vector<VkPipelineShaderStageCreateInfo> stage_infos;
    for (const ShaderStage* stage : stages) stage_infos.push_back(stage->create_info());
    const FixedFunctions fixed(state);
    VkGraphicsPipelineCreateInfo info = fixed.create_info();
    info.stageCount = static_cast<std::uint32_t>(stage_infos.size());
    info.pStages = stage_infos.data();
    info.layout = layout_;
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateGraphicsPipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
          "vkCreateGraphicsPipelines", name_);
    handle_ = pipeline;
    device.set_name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(handle_), name_);
}

}  // namespace drape::vulkan
