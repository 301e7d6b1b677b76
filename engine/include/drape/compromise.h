#pragma once

#include <cstdint>
#include <string>

namespace drape {

/// Something that the scene asks for and that the method follows only in part.
struct Compromise {
    std::string what, reason;       ///< the reason says how much is followed, and what would help
    std::uint32_t enough_substeps;  ///< substeps per frame that would follow all of it; 0: no number would
};

}  // namespace drape
