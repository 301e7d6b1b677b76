// Every module by name.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace drape {

struct SpirvModule {
    std::string_view name;  ///< "spring.comp"
    std::span<const std::uint32_t> words;
};

/// Returns the modules, sorted by name.
std::span<const SpirvModule> spirv_modules();

}  // namespace drape
