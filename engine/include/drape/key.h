// A number that changes with time.
#pragma once

namespace drape {

/// One key of a number that changes: world/weather.h gives it between the keys.
struct NumberKey {
    double time = 0.0;  ///< s
    double value = 0.0;
    bool operator==(const NumberKey&) const = default;
};

}  // namespace drape
