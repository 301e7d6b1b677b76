#include "solver/step_dispatch.h"

#include <algorithm>
#include <stdexcept>

namespace drape {

namespace {

/// The place of a size in the list, at which it is put when new.
std::size_t slot_of(std::vector<glsl::uvec4>& sizes, glsl::uvec4 size) {
    const auto same = [&](const glsl::uvec4& other) { return other.x == size.x && other.y == size.y; };
    const auto found = std::ranges::find_if(sizes, same);
    if (found != sizes.end()) return static_cast<std::size_t>(found - sizes.begin());
    if (sizes.size() == glsl::iteration_size_count)
        throw std::logic_error("too many sizes of dispatches in an iteration");
    sizes.push_back(size);
    return sizes.size() - 1;
}

}  // namespace

StepDispatch::StepDispatch(const ClothState& state, const Step& step, const vulkan::ComputePipeline& pipeline,
                           std::uint32_t width, std::uint32_t height)
    : pipeline_(&pipeline), width_(width), height_(height), depth_(state.count) {
    if (!step.conditional) return;
    const auto [x, y, z] = pipeline.local_size();
    sizes_ = state[Field::iterations];
    slot_ = slot_of(*state.iteration_sizes, {(width + x - 1) / x, (height + y - 1) / y, 1, 0});
}

void StepDispatch::declare(graph::PassSetup& setup) const {
    if (sizes_.valid()) setup.read(sizes_, graph::Access::indirect_read);
}

}  // namespace drape
