#include "solver/compute_pass.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace drape {

namespace {

using graph::Access;

void declare(graph::PassSetup& setup, const vulkan::ComputePipeline& pipeline, PassResources& resources) {
    // All reads come first: what a pass writes may be the spare of what it reads.
    for (const vulkan::ReflectedDescriptor& each : pipeline.descriptors())
        if (each.readable)
            setup.read(resources.find(resource_of(each.name), false), Access::compute_read,
                       each.writable ? std::string() : each.name);
    for (const vulkan::ReflectedDescriptor& each : pipeline.descriptors()) {
        if (!each.writable) continue;
        graph::Handle& handle = resources.find(resource_of(each.name), true);
        handle = setup.write(handle, Access::compute_write, each.name);
    }
}

/// Over cloths together of which only some are present, a dispatch has as many layers as the host says.
DispatchSize of_present(const ClothState* cloth, const vulkan::ComputePipeline& pipeline, DispatchSize size) {
    if (!cloth || !cloth->present.valid() || size.depth != cloth->count()) return size;
    const auto [x, y, z] = pipeline.local_size();
    size.sizes = cloth->present_sizes;
    size.slot = size_slot(*cloth->sizes_of_present, {(size.width + x - 1) / x, (size.height + y - 1) / y, 0, 0},
                          most_present_sizes);
    return size;
}

}  // namespace

std::string_view resource_of(std::string_view variable) {
    for (const std::string_view end : {"_in", "_out"})
        if (variable.ends_with(end)) return variable.substr(0, variable.size() - end.size());
    return variable;
}

graph::Handle& PassResources::find(std::string_view variable, bool written) {
    const std::string name = alias ? alias(variable, written) : std::string(variable);
    for (const auto& [own_name, handle] : own)
        if (own_name == name) return *handle;
    if (cloth)
        if (const auto field = field_called(name)) return (*cloth)[*field];
    if (contact)
        if (const auto field = contact_field_called(name)) return (*contact)[*field];
    if (cloth && name == "present") return cloth->present;
    if (name == "wind") return inputs.wind;
    if (name == "stiffness") return inputs.stiffness;
    if (name == "attempt") return inputs.attempt;
    if (name == "colliders" || name == "collider_texels") return inputs.colliders;
    if (name == "mesh_fields") return inputs.mesh_fields;
    if (name == "form_nodes") return inputs.form_nodes;
    if (name == "form_corners") return inputs.form_corners;
    if (name == "form_guesses") return inputs.form_guesses;
    if (name == "form_sides") return inputs.form_sides;
    throw std::logic_error("a shader names '" + name + "', which its pass has not");
}

std::size_t size_slot(std::vector<glsl::uvec4>& sizes, glsl::uvec4 size, std::size_t most) {
    const auto same = [&](const glsl::uvec4& other) { return other.x == size.x && other.y == size.y; };
    const auto found = std::ranges::find_if(sizes, same);
    if (found != sizes.end()) return static_cast<std::size_t>(found - sizes.begin());
    if (sizes.size() == most) throw std::logic_error("too many sizes of dispatches");
    sizes.push_back(size);
    return sizes.size() - 1;
}

void add_compute_pass(graph::Graph& graph, const graph::PassName& name, const vulkan::ComputePipeline& pipeline,
                      const graph::PushConstants& push, const DispatchSize& asked, PassResources resources) {
    const DispatchSize size = of_present(resources.cloth, pipeline, asked);
    graph.add_pass(
        name,
        [&](graph::PassSetup& setup) {
            if (size.sizes.valid()) setup.read(size.sizes, Access::indirect_read);
            declare(setup, pipeline, resources);
        },
        [&pipeline, push, size](graph::PassContext& context) {
            if (size.sizes.valid())
                context.dispatch_indirect(pipeline, push, size.sizes, size.slot * sizeof(glsl::uvec4));
            else
                context.dispatch(pipeline, push, size.width, size.height, size.depth);
        });
}

}  // namespace drape
