#pragma once

#include <string>
#include <vector>

namespace drape {

/// These may change the momenta of a cloth that its statistics have. Nothing else does.
struct Momenta {
    std::string cloth;
    std::string about;  ///< the point that the angular momentum is about
    std::vector<std::string> momentum_by, angular_momentum_by;
};

}  // namespace drape
