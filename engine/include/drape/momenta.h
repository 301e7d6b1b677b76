#pragma once

#include <string>
#include <vector>

namespace drape {

/// What may change the momenta of a cloth that its statistics have. What is not named here does not.
struct Momenta {
    std::string cloth;
    std::string about;  ///< the point that the angular momentum is about
    std::vector<std::string> momentum_by, angular_momentum_by;
};

}  // namespace drape
