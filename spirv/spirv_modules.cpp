// Every module, taken as it is from its file.
#include "spirv_modules.h"

// clang-format off
#define MODULE(symbol, name)                                                                                \
    asm(".pushsection .rodata\n.balign 4\n"                                                                \
        #symbol ": .incbin \"" DRAPE_SPIRV_DIR "/" name ".spv\"\n"                                          \
        #symbol "_end:\n.popsection");                                                                      \
    extern "C" const std::uint32_t symbol[], symbol##_end[];
// clang-format on
#include "modules.inc"
#undef MODULE

namespace drape {

std::span<const SpirvModule> spirv_modules() {
#define MODULE(symbol, name) {name, {symbol, symbol##_end}},
    static const SpirvModule table[] = {
#include "modules.inc"
    };
    return table;
}

}  // namespace drape
