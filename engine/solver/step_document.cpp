#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "solver/step_row.h"

namespace drape {

namespace {

struct ResourceUse {
    bool read = false, written = false;
    bool always = true;
};

std::set<std::string> names_in(const vulkan::ReflectedModule& module) {
    std::set<std::string> names;
    for (const vulkan::ReflectedDescriptor& each : module.descriptors) names.emplace(resource_of(each.name));
    return names;
}

/// The uses of a kernel's resources, whatever its shader's constants are: "read | updated | written". One is used
/// always that no constant leaves out alone.
std::string uses_text(const KernelRow& kernel) {
    const std::string shader(kernel.shader);
    const vulkan::ReflectedModule& whole = vulkan::module_interface(shader);
    std::map<std::string, ResourceUse> uses;
    for (const vulkan::ReflectedDescriptor& each : whole.descriptors) {
        ResourceUse& use = uses[std::string(resource_of(each.name))];
        use.read |= each.readable;
        use.written |= each.writable;
    }
    for (const auto& [constant, id] : whole.constants)
        for (const std::uint32_t value : {0u, 1u}) {
            const vulkan::SpecializationConstant only[] = {{constant, value}};
            const std::set<std::string> used = names_in(vulkan::specialised_module(shader, only).reflected);
            for (auto& [name, use] : uses) use.always &= used.contains(name);
        }
    const auto listed = [&](bool read, bool written) {
        std::string text;
        for (const auto& [name, use] : uses)
            if (use.read == read && use.written == written)
                text += (text.empty() ? "" : ", ") + (use.always ? name : "[" + name + "]");
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
        "fields that these read, update and write. `[x]` is left out by some values of the shader's constants; "
        "`[constants]`\nare those of cloths together, where they differ (`shaders/include/push.h`), `[skin]` and "
        "`[skins]` what maps of\nfriction and thickness give (`shaders/include/skin.h`). The other names are those\n"
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
