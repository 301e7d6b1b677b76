#include "solver/pipelines.h"

#include <algorithm>

#include "cloth/step.h"

namespace drape {

namespace {

/// The width and height of a dispatch of so many invocations, which are counted workgroup by workgroup, row by row. The
/// largest images take no more than the 65,535 workgroups down that every device has.
std::array<std::uint32_t, 2> folded(std::uint64_t invocations) {
    constexpr std::uint32_t width = glsl::workgroup_width, most_across = 64;
    const auto groups = static_cast<std::uint32_t>((invocations - 1) / width + 1);
    const std::uint32_t across = std::min(groups, most_across);
    return {across * width, (groups - 1) / across + 1};
}

}  // namespace

const vulkan::ComputePipeline& Pipelines::get(const std::string& module,
                                              const std::function<std::uint32_t(std::string_view)>& value,
                                              bool own_constants) {
    std::vector<vulkan::SpecializationConstant> constants;
    for (const auto& [name, id] : vulkan::module_interface(module).constants)
        constants.push_back({name, name == "has_constants" ? std::uint32_t{own_constants}
                                   : name == "has_present" ? std::uint32_t{present_}
                                                           : value(name)});
    const vulkan::ComputePipeline& pipeline = device_.compute_pipeline(module, constants);
    asked_for_.insert(&pipeline);
    return pipeline;
}

const vulkan::ComputePipeline& Pipelines::get(const std::string& module, bool own_constants) {
    const auto value = [&](std::string_view name) -> std::uint32_t {
        throw std::logic_error(module + ": nobody gives constant " + std::string(name) + " a value");
    };
    return get(module, value, own_constants);
}

std::uint32_t Pipelines::strip_rows(std::size_t rounds_each) const {
    const std::size_t most = is_cpu() ? 32 : 1;
    return static_cast<std::uint32_t>(std::clamp<std::size_t>(most_loop_rounds / rounds_each, 1, most));
}

std::array<std::uint32_t, 2> Pipelines::over_strips(glsl::ivec2 grid) const {
    return folded((static_cast<std::uint64_t>(grid.x) * static_cast<std::uint64_t>(grid.y) - 1) / strip_length() + 1);
}

std::array<std::uint32_t, 2> Pipelines::over_parts(glsl::ivec2 grid) const {
    const auto parts = [](int size, std::uint32_t each) { return (static_cast<std::uint64_t>(size) - 1) / each + 1; };
    return folded(parts(grid.x, strip_columns()) * parts(grid.y, strip_rows()));
}

}  // namespace drape
