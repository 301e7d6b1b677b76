// The script of views in 3-D and the libraries that it needs, taken as they are from their files.
#include <string_view>

#include "report/space.h"

// clang-format off
#define TEXT(symbol, path) asm(".pushsection .rodata\n" #symbol ": .incbin \"" path "\"\n" #symbol "_end:\n.popsection");
// clang-format on
TEXT(drape_viewer, DRAPE_VIEWER)
extern "C" const char drape_viewer[], drape_viewer_end[];
#ifdef DRAPE_THREE
TEXT(drape_three, DRAPE_THREE)
TEXT(drape_orbit, DRAPE_ORBIT)
TEXT(drape_licence, DRAPE_LICENCE)
extern "C" const char drape_three[], drape_three_end[], drape_orbit[], drape_orbit_end[], drape_licence[],
    drape_licence_end[];
#endif
#undef TEXT

namespace drape::report {

std::string space_script() {
    std::string text;
#ifdef DRAPE_THREE
    // The program's own licence has the same words below its first lines.
    const std::string_view licence(drape_licence, drape_licence_end);
    text +=
        "/* three.js and its OrbitControls, https://threejs.org: MIT licence, copyright 2010-2019 three.js authors\n\n";
    text += licence.substr(licence.find("Permission is"));
    text += "*/\n";
    for (const std::string_view library :
         {std::string_view(drape_three, drape_three_end), std::string_view(drape_orbit, drape_orbit_end)}) {
        text += library;
        text += '\n';
    }
#endif
    return text + std::string(drape_viewer, drape_viewer_end);
}

}  // namespace drape::report
