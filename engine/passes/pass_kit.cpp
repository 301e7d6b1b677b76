#include "passes/pass_kit.h"

#include <utility>

#include "fmt/format.h"

namespace drape {

const vulkan::ComputePipeline& PipelineCache::get(const vulkan::ShaderInterface& shader,
                                                  const std::vector<vulkan::SpecializationConstant>& constants) {
    std::string key(shader.module);
    for (const auto& constant : constants) key += fmt::format(" {}={}", constant.id, constant.value);
    std::unique_ptr<vulkan::ComputePipeline>& pipeline = pipelines_[key];
    if (!pipeline) pipeline = std::make_unique<vulkan::ComputePipeline>(device_, key, shader, constants);
    return *pipeline;
}

void ClothState::turn() {
    std::swap(position, position_spare);
    std::swap(displacement, displacement_spare);
    away = !away;
}

graph::PassName ClothState::pass_name(const std::string& pass, const std::string& stage) const {
    const std::string label = model->name + "/" + pass;
    return {label, stage, label};
}

graph::PassName ClothState::step_name(const std::string& pass, const Step& step) const {
    const std::string label = model->name + "/" + pass;
    return {fmt::format("{} (substep {}, iteration {})", label, step.substep, step.iteration), "simulate", label};
}

void update(graph::PassSetup& setup, graph::Handle& handle, std::uint32_t read_binding, std::uint32_t write_binding) {
    setup.read(handle, graph::Access::compute_read, read_binding);
    handle = setup.write(handle, graph::Access::compute_write, write_binding);
}

}  // namespace drape
