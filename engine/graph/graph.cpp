#include "graph/graph.h"

#include <fmt/core.h>

#include <array>
#include <utility>

#include "vulkan/resources.h"

namespace drape::graph {
namespace {

bool is_depth(VkFormat format) {
    return format == VK_FORMAT_D16_UNORM || format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_X8_D24_UNORM_PACK32 ||
           format == VK_FORMAT_D24_UNORM_S8_UINT || format == VK_FORMAT_D32_SFLOAT_S8_UINT;
}

bool is_attachment(Access access) {
    return access == Access::color_write || access == Access::depth_write || access == Access::resolve_write;
}

bool is_transfer(Access access) { return access == Access::transfer_read || access == Access::transfer_write; }

[[noreturn]] void refuse(const Pass& pass, std::string_view resource, std::string_view mistake) {
    throw GraphError(fmt::format("pass '{}', resource '{}': {}", pass.name, resource, mistake));
}

/// Returns the handle's resource. The handle must have the newest version of a resource of this graph.
const Resource& newest(const std::vector<Resource>& resources, const Pass& pass, Handle handle, std::string_view verb) {
    if (!handle.valid()) {
        throw GraphError(fmt::format("pass '{}' {}s a handle that names no resource", pass.name, verb));
    }
    if (handle.resource >= resources.size()) {
        throw GraphError(fmt::format("pass '{}' {}s an unknown handle (resource {} of {}): of another graph?",
                                     pass.name, verb, handle.resource, resources.size()));
    }
    const Resource& resource = resources[handle.resource];
    if (handle.version > resource.version) {
        refuse(pass, resource.name,
               fmt::format("{} of unknown version {}, the newest is {}: of another graph?", verb, handle.version,
                           resource.version));
    }
    if (handle.slice != UINT32_MAX && handle.slice >= resource.image.slices.size())
        refuse(pass, resource.name,
               fmt::format("{} of slice {}, it has {}", verb, handle.slice, resource.image.slices.size()));
    // This check precedes the comparison of versions, since the handle that this pass's own write returned is the
    // newest.
    for (const Use& use : pass.uses) {
        if (use.handle.resource != handle.resource || !is_write(use.access)) continue;
        refuse(pass, resource.name,
               verb == "read" ? "read after this pass wrote it: declare the read first" : "written twice in one pass");
    }
    if (handle.version < resource.version) {
        refuse(
            pass, resource.name,
            fmt::format("{} of a stale handle: version {}, the newest is {}", verb, handle.version, resource.version));
    }
    return resource;
}

void check_kind(const Pass& pass, const Resource& resource, Access access) {
    const auto unfit = [&](std::string_view why) {
        refuse(pass, resource.name, fmt::format("{}: {}", access_name(access), why));
    };
    if (resource.is_image) {
        if (access == Access::index_read || access == Access::indirect_read || access == Access::host_read)
            unfit("an image, not a buffer");
        const bool depth = is_depth(resource.image.format);
        const bool multisampled = resource.image.samples != VK_SAMPLE_COUNT_1_BIT;
        if (resource.image.stays_general() && is_attachment(access))
            unfit("an image with a buffer view or slices stays in GENERAL");
        if (access == Access::depth_write && !depth) unfit("the format is no depth format");
        if (access != Access::depth_write && !is_transfer(access) && depth) unfit("the format is a depth format");
        if (access == Access::resolve_write && multisampled) unfit("a resolve target has one sample");
        if (access == Access::compute_write && multisampled) unfit("a multisampled image is written as an attachment");
    } else {
        if (is_attachment(access)) unfit("a buffer, not an image");
        if (access == Access::host_read && resource.lifetime != Lifetime::host_output) {
            unfit("the host reads host_output buffers only");
        }
    }
}

/// No barrier can stand between two uses within a pass, so an image must have the same layout for all of them.
void check_against_others(const Pass& pass, const Resource& resource, const Use& use,
                          const std::vector<Resource>& resources) {
    for (const Use& other : pass.uses) {
        const bool same = other.handle.resource == use.handle.resource;
        if (same && resource.is_image && is_attachment(other.access) != is_attachment(use.access)) {
            refuse(pass, resource.name,
                   fmt::format("{} and {} in one pass need two layouts", access_name(other.access),
                               access_name(use.access)));
        }
        // A version may be read through several variables, since a shader's variables may share a resource; a resource
        // that a shader updates in place is read without a variable.
        if (other.handle == use.handle && other.access == use.access && use.variable == other.variable) {
            refuse(pass, resource.name, fmt::format("{} declared twice", access_name(use.access)));
        }
        if (use.variable.empty() || other.variable != use.variable) continue;
        refuse(pass, resource.name,
               fmt::format("variable '{}' is already taken by {} of '{}'", use.variable, access_name(other.access),
                           resources[other.handle.resource].name));
    }
}

void check_variable(const Pass& pass, const Resource& resource, const Use& use) {
    const bool bindable = use.access == Access::compute_read || use.access == Access::compute_write;
    if (!use.variable.empty() && !bindable) {
        refuse(pass, resource.name,
               fmt::format("{} takes no variable, but '{}' was given", access_name(use.access), use.variable));
    }
}

void check_name(const std::vector<Resource>& resources, const std::string& name) {
    if (name.empty()) throw GraphError("a resource needs a name");
    for (const Resource& resource : resources) {
        if (resource.name == name) throw GraphError(fmt::format("resource '{}' is declared twice", name));
    }
}

void check_slices(const std::vector<Resource>& resources, const ImageDeclaration& image) {
    if (image.slices.empty()) return;
    for (const std::string& slice : image.slices) check_name(resources, slice);
    if (image.height % image.slices.size() != 0)
        throw GraphError(fmt::format("image '{}': {} rows cannot be cut into {} slices", image.name, image.height,
                                     image.slices.size()));
}

}  // namespace

bool is_write(Access access) {
    return is_attachment(access) || access == Access::compute_write || access == Access::transfer_write;
}

std::string_view access_name(Access access) {
    static constexpr std::array<std::string_view, 12> names = {
        "compute_read", "compute_write", "vertex_read",   "fragment_read", "index_read",     "indirect_read",
        "color_write",  "depth_write",   "resolve_write", "transfer_read", "transfer_write", "host_read"};
    return names.at(static_cast<std::size_t>(access));
}

std::string_view lifetime_name(Lifetime lifetime) {
    static constexpr std::array<std::string_view, 5> names = {"transient", "persistent", "constant", "host_input",
                                                              "host_output"};
    return names.at(static_cast<std::size_t>(lifetime));
}

std::uint64_t Resource::byte_count() const {
    if (!is_image) return buffer.byte_count;
    std::uint64_t bytes = static_cast<std::uint64_t>(image.samples) * vulkan::texel_size(image.format);
    if (__builtin_mul_overflow(bytes, std::uint64_t{image.width}, &bytes) ||
        __builtin_mul_overflow(bytes, std::uint64_t{image.height}, &bytes)) {
        throw vulkan::VulkanError(
            fmt::format("image '{}': {} x {} texels exceed 64-bit sizes", name, image.width, image.height));
    }
    return bytes;
}

ImageDeclaration Resource::seen(Handle handle) const {
    ImageDeclaration declaration = image;
    if (handle.slice == UINT32_MAX) return declaration;
    declaration.name = image.slices[handle.slice];
    declaration.height /= static_cast<std::uint32_t>(image.slices.size());
    declaration.slices.clear();
    return declaration;
}

std::uint64_t Resource::byte_count(Handle handle) const {
    return handle.slice == UINT32_MAX ? byte_count() : byte_count() / image.slices.size();
}

Handle PassSetup::read(Handle handle, Access access, std::string variable) {
    const Resource& resource = newest(graph_.resources_, pass_, handle, "read");
    if (is_write(access)) {
        refuse(pass_, resource.name, fmt::format("read() with {}, which writes", access_name(access)));
    }
    const Use use{handle, access, std::move(variable)};
    check_kind(pass_, resource, access);
    check_variable(pass_, resource, use);
    check_against_others(pass_, resource, use, graph_.resources_);
    pass_.uses.push_back(use);
    return handle;
}

Handle PassSetup::write(Handle handle, Access access, std::string variable) {
    const Resource& resource = newest(graph_.resources_, pass_, handle, "write");
    if (!is_write(access)) {
        refuse(pass_, resource.name, fmt::format("write() with {}, which only reads", access_name(access)));
    }
    if (resource.lifetime == Lifetime::constant || resource.lifetime == Lifetime::host_input) {
        refuse(pass_, resource.name,
               fmt::format("write to a {} resource, which no pass may write", lifetime_name(resource.lifetime)));
    }
    const Use use{{handle.resource, handle.version + 1, handle.slice}, access, std::move(variable)};
    check_kind(pass_, resource, access);
    check_variable(pass_, resource, use);
    check_against_others(pass_, resource, use, graph_.resources_);
    pass_.uses.push_back(use);
    ++graph_.resources_[handle.resource].version;
    return use.handle;
}

Handle Graph::image(const ImageDeclaration& declaration) {
    check_name(resources_, declaration.name);
    if (declaration.width == 0 || declaration.height == 0) {
        throw GraphError(fmt::format("image '{}': {} x {} texels is empty", declaration.name, declaration.width,
                                     declaration.height));
    }
    if (declaration.lifetime == Lifetime::host_input || declaration.lifetime == Lifetime::host_output) {
        throw GraphError(
            fmt::format("image '{}': {} is for buffers", declaration.name, lifetime_name(declaration.lifetime)));
    }
    if (declaration.stays_general() && (is_depth(declaration.format) || declaration.samples != VK_SAMPLE_COUNT_1_BIT)) {
        throw GraphError(
            fmt::format("image '{}': depth and multisampled images have no buffer view", declaration.name));
    }
    check_slices(resources_, declaration);
    Resource resource;
    resource.name = declaration.name;
    resource.is_image = true;
    resource.image = declaration;
    resource.lifetime = declaration.lifetime;
    resources_.push_back(std::move(resource));
    return {static_cast<std::uint32_t>(resources_.size() - 1), 0};
}

Handle Graph::buffer(const BufferDeclaration& declaration) {
    check_name(resources_, declaration.name);
    if (declaration.byte_count == 0 || declaration.byte_count % 4 != 0) {
        throw GraphError(fmt::format("buffer '{}': {} bytes is no positive multiple of 4", declaration.name,
                                     declaration.byte_count));
    }
    Resource resource;
    resource.name = declaration.name;
    resource.buffer = declaration;
    resource.lifetime = declaration.lifetime;
    resources_.push_back(std::move(resource));
    return {static_cast<std::uint32_t>(resources_.size() - 1), 0};
}

void Graph::add_pass(PassName name, const std::function<void(PassSetup&)>& setup,
                     std::function<void(PassContext&)> execute) {
    if (name.name.empty()) throw GraphError("a pass needs a name");
    Pass pass;
    pass.name = std::move(name.name);
    pass.stage = name.stage.empty() ? "other" : std::move(name.stage);
    pass.label = name.label.empty() ? pass.name : std::move(name.label);
    pass.execute = std::move(execute);
    PassSetup declaration(*this, pass);
    try {
        setup(declaration);
    } catch (...) {
        // A refused pass changes nothing: handles from before it remain valid.
        for (const Use& use : pass.uses) {
            if (is_write(use.access)) --resources_[use.handle.resource].version;
        }
        throw;
    }
    passes_.push_back(std::move(pass));
}

void Graph::add_flops(double flops) {
    if (passes_.empty()) throw GraphError("no pass computes this");
    passes_.back().flops += flops;
}

void Graph::choose(std::string what, std::string reason) { choices_.push_back({std::move(what), std::move(reason)}); }

void Graph::compromise(std::string what, std::string reason) {
    compromises_.push_back({std::move(what), std::move(reason)});
}

void Graph::skip(std::string what, std::string reason) { skipped_.push_back({std::move(what), std::move(reason)}); }

}  // namespace drape::graph
