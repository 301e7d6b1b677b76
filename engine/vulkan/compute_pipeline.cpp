#include "vulkan/api.h"
#include "vulkan/pipeline.h"
#include "vulkan/shader_stage.h"
#include "vulkan/structure.h"

namespace drape::vulkan {

ComputePipeline::ComputePipeline(const Device& device, std::string name, const Shader& shader,
                                 std::span<const SpecializationConstant> constants)
    : Pipeline(device, std::move(name), VK_PIPELINE_BIND_POINT_COMPUTE) {
    const ShaderStage stage(device, name_, shader, VK_SHADER_STAGE_COMPUTE_BIT, constants);
    const ShaderStage* const stages[] = {&stage};
    require_constants(name_, constants, stages);
    local_size_ = stage.reflected().local_size;
    make_layout(stages);
    auto info = structure<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.stage = stage.create_info();
    info.layout = layout_;
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
          "vkCreateComputePipelines", name_);
    handle_ = pipeline;
    device.set_name(VK_OBJECT_TYPE_PIPELINE, reinterpret_cast<std::uint64_t>(handle_), name_);
}

}  // namespace drape::vulkan
