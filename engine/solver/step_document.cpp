#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "solver/step_row.h"
#include "spirv_modules.h"

namespace drape {

namespace {

/// Whether a module is the shader in one of its variants.
bool is_variant(std::string_view module, const KernelRow& kernel) {
    const std::string_view stem = kernel.shader.substr(0, kernel.shader.rfind('.'));
    if (!module.starts_with(stem) || !module.ends_with(".comp")) return false;
    std::string_view rest = module.substr(stem.size(), module.rfind('.') - stem.size());
    for (const VariantRow& variant : kernel.variants) {
        const std::string part = "_" + std::string(variant.name);
        if (rest.starts_with(part)) rest.remove_prefix(part.size());
    }
    return rest.empty();
}

struct ResourceUse {
    bool read = false, written = false;
    std::size_t modules = 0;  ///< that use it
};

/// The uses of a kernel's resources over all variants of its shader: "read | updated | written".
std::string uses_text(const KernelRow& kernel) {
    std::map<std::string, ResourceUse> uses;
    std::size_t modules = 0;
    for (const SpirvModule& module : spirv_modules()) {
        if (!is_variant(module.name, kernel)) continue;
        ++modules;
        std::set<std::string> used;
        const vulkan::ReflectedModule& interface = vulkan::module_interface(std::string(module.name));
        for (const auto& descriptor : interface.descriptors) {
            const std::string name(resource_of(descriptor.name));
            uses[name].read |= descriptor.readable;
            uses[name].written |= descriptor.writable;
            if (!interface.constants.contains("has_" + name)) used.insert(name);
        }
        for (const std::string& name : used) ++uses[name].modules;
    }
    const auto listed = [&](bool read, bool written) {
        std::string text;
        for (const auto& [name, use] : uses)
            if (use.read == read && use.written == written)
                text += (text.empty() ? "" : ", ") + (use.modules < modules ? "[" + name + "]" : name);
        return text;
    };
    return fmt::format("{} | {} | {}", listed(true, false), listed(true, true), listed(false, true));
}

}  // namespace

std::string step_document() {
    std::string text =
        "# Which pass reads and writes what?\n\n"
        "The steps of a frame in the order of `StepKind` (`engine/cloth/step.h`), with the shaders that do them, and "
        "the\n"
        "fields that these read, update and write. `[x]` is used by some variants of the shader only; `[constants]` "
        "are "
        "those\nof cloths together, where they differ (`shaders/include/push.h`), `[skin]` and `[skins]` what maps of "
        "friction and\nthickness give (`shaders/include/skin.h`). The other names are those\n"
        "of `engine/cloth/cloth_state.cpp` and `contact_state.cpp` with underscores; a row of "
        "`engine/solver/step_rows.cpp`\n"
        "says where a name means another field, and where a step writes the spare field instead. `drape graph "
        "--steps`\n"
        "prints this file from the shaders; a test compares the two.\n\n"
        "| shader | kernel | reads | updates | writes |\n|---|---|---|---|---|\n";
    for (const StepRow& row : step_rows())
        for (const KernelRow& kernel : row.kernels)
            text += fmt::format("| {} | {} | {} |\n", kernel.shader, name_of(kernel.kernel), uses_text(kernel));
    return text;
}

}  // namespace drape
