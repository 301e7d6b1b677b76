// What a scene asks for and gets only in part.
#pragma once

#include <cstdint>
#include <string>

namespace drape {

/// Something that the scene asks for and that the method follows only in part.
struct Compromise {
    std::string what, reason;       ///< the reason with numbers: what is followed, and what would help
    std::uint32_t enough_substeps;  ///< per frame, that would follow all of it; 0: none would
};

}  // namespace drape
