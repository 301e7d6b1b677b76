// How a mesh is taken for a body.
#pragma once

namespace drape {

enum class Solid {
    mended,  ///< its small faults are mended, and holes of at most a twentieth of its area are closed
    filled,  ///< likewise, and all holes are closed, however large
    strict,  ///< it is refused unless it is closed
};

}  // namespace drape
