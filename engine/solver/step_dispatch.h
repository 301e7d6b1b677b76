// The dispatch of a step: of the size given, or, in iterations that the device may skip, of the size that the check
// before it wrote.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

class StepDispatch {
  public:
    /// Of `width` x `height` invocations of `pipeline`, which must outlive the graph. Throws std::logic_error when a
    /// cloth's iterations have more than iteration_size_count different sizes.
    StepDispatch(const ClothState& state, const Step& step, const vulkan::ComputePipeline& pipeline,
                 std::uint32_t width, std::uint32_t height);
    StepDispatch(const ClothState& state, const Step& step, const vulkan::ComputePipeline& pipeline, glsl::ivec2 size)
        : StepDispatch(state, step, pipeline, static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y)) {}

    /// To be called by the pass's set-up.
    void declare(graph::PassSetup& setup) const;
    /// To be called by the pass's execution.
    template <class T>
    void record(graph::PassContext& context, const T& push_constants) const {
        if (sizes_.valid())
            context.dispatch_indirect(*pipeline_, push_constants, sizes_, slot_ * sizeof(glsl::uvec4));
        else
            context.dispatch(*pipeline_, push_constants, width_, height_, depth_);
    }

  private:
    const vulkan::ComputePipeline* pipeline_;
    std::uint32_t width_, height_, depth_;
    graph::Handle sizes_;  ///< conditional steps
    std::size_t slot_ = 0;
};

}  // namespace drape
