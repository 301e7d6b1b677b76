// The compute pipelines of a device, and how much work an invocation takes on it.
#pragma once

#include <array>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "shared/glsl_types.h"
#include "vulkan/device.h"
#include "vulkan/pipeline.h"

namespace drape {

class Pipelines {
  public:
    /// `present`: passes over cloths together are told which of them are (shaders/include/present.h).
    explicit Pipelines(const vulkan::Device& device, bool present = false) : device_(device), present_(present) {}
    /// The pipeline of a module, specialised by the values of exactly those constants that the module has;
    /// `own_constants` is that of `has_constants` (solver/cloth_constants.h).
    const vulkan::ComputePipeline& get(const std::string& module,
                                       const std::function<std::uint32_t(std::string_view constant)>& value,
                                       bool own_constants = false);
    /// The pipeline of a module that has no constants but that and `has_present`.
    const vulkan::ComputePipeline& get(const std::string& module, bool own_constants = false);
    /// How many different pipelines were asked for here.
    std::size_t size() const { return asked_for_.size(); }

    // On a CPU one invocation costs as much to begin as several entries or particles cost to handle, and a branch of
    // one lane of a subgroup costs as much as one of all: so it takes several of them in turn there, and one on a GPU.
    /// Entries of a list that an invocation takes.
    std::uint32_t entries_each() const { return is_cpu() ? 8 : 1; }
    /// Particles of a column that an invocation takes; fewer where each may take so many rounds of loops that the
    /// driver would end them silently (most_loop_rounds).
    std::uint32_t strip_rows(std::size_t rounds_each = 1) const;
    /// Neighbouring columns that an invocation takes, where particles share what is costly.
    std::uint32_t strip_columns() const { return is_cpu() ? 2 : 1; }
    /// Particles, counted row by row, that an invocation takes (shaders/include/strips.h).
    std::uint32_t strip_length() const { return is_cpu() ? 16 : 1; }
    /// Invocations across and down that take all particles of a grid, strip_length() each.
    std::array<std::uint32_t, 2> over_strips(glsl::ivec2 grid) const;
    /// Invocations across and down that take all particles of a grid, strip_rows() x strip_columns() each
    /// (shaders/self_near.comp).
    std::array<std::uint32_t, 2> over_parts(glsl::ivec2 grid) const;
    bool wide_atomics() const { return device_.capabilities().wide_atomics; }

  private:
    bool is_cpu() const { return device_.info().type == "cpu"; }
    const vulkan::Device& device_;
    bool present_;
    std::set<const vulkan::ComputePipeline*> asked_for_;
};

}  // namespace drape
