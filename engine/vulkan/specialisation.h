// A module as one pipeline has it: with the values of its constants, and without the code and descriptors that they
// leave out. So a shader says with or without by plain conditions, and what is left out needs no resource, costs a
// driver nothing, and counts as no use. Nothing that is left is changed. spirv-opt could do it, in 100 times the time:
// 400 ms for the largest module.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vulkan/reflection.h"

namespace drape::vulkan {

/// A constant has its name in GLSL and a 32-bit value (floats by std::bit_cast).
struct SpecializationConstant {
    std::string_view name;
    std::uint32_t value;
};

struct SpecialisedModule {
    std::vector<std::uint32_t> words;
    ReflectedModule reflected;  ///< has no constants any more
};

/// Returns a module with the values of those of `constants` that it has, and its own values of the others. Throws
/// VulkanError naming `module` when SPIRV-Cross cannot read the words.
SpecialisedModule specialise(std::span<const std::uint32_t> words, const std::string& module,
                             std::span<const SpecializationConstant> constants);

/// Returns the same of the module of that name; it is made once a process.
const SpecialisedModule& specialised_module(const std::string& module,
                                            std::span<const SpecializationConstant> constants);

}  // namespace drape::vulkan
