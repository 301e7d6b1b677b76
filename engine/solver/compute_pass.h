// A compute pass whose uses come from its shader: GLSL names the resources and says how each is used, nothing repeats
// it.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "solver/pass_kit.h"

namespace drape {

/// Invocations of a dispatch; or, where `sizes` is valid, the workgroups that the device wrote there.
struct DispatchSize {
    std::uint32_t width = 1, height = 1, depth = 1;
    graph::Handle sizes{};
    std::size_t slot = 0;  ///< of `sizes`, a uvec4 each
};

/// Returns the place of a size in a list, at which it is put when it is new. Throws std::logic_error when more than
/// `most` come.
std::size_t size_slot(std::vector<glsl::uvec4>& sizes, glsl::uvec4 size, std::size_t most);
/// A state's passes have at most so many sizes.
inline constexpr std::size_t most_present_sizes = 256;

/// Finds the resources that a shader names: a field of a cloth by its row's name, then one of contact, then a host
/// input of the scene; those of `own` first.
struct PassResources {
    ClothState* cloth = nullptr;
    ContactHandles* contact = nullptr;
    SceneInputs inputs = {};
    std::vector<std::pair<std::string_view, graph::Handle*>> own = {};
    /// Returns the name of the resource that a name means in this pass; unset: every name means itself.
    std::function<std::string(std::string_view name, bool written)> alias = {};

    /// Throws std::logic_error where there is none of that name.
    graph::Handle& find(std::string_view variable, bool written);
};

/// Adds a pass that dispatches `pipeline`. Its descriptors are its uses: `readonly` ones are read, `writeonly` ones
/// written, others updated in place. NAME_in and NAME_out are one resource that the pass updates by two variables, so
/// that synchronization validation sees them apart. The pipeline must outlive the graph.
void add_compute_pass(graph::Graph& graph, const graph::PassName& name, const vulkan::ComputePipeline& pipeline,
                      const graph::PushConstants& push, const DispatchSize& size, PassResources resources);

/// The name of the resource that a shader's variable is bound to: without _in and _out.
std::string_view resource_of(std::string_view variable);

}  // namespace drape
