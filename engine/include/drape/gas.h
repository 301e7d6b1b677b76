// Cloths that are sewn to a closed surface close in a gas, which a scene describes by this.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drape/key.h"
#include "drape/spelling.h"

namespace drape {

/// A side of a cloth: the front is that of u x v.
enum class ClothSide { front, back };
inline constexpr Spelling<ClothSide> cloth_side_spellings[] = {{"front", ClothSide::front}, {"back", ClothSide::back}};

/// An ideal gas at constant temperature: (p + ambient) V = ambient Vn, where p is its gauge pressure, V what the cloths
/// close in and Vn its volume at ambient pressure, of which a number or keys say how much there is.
struct Gas {
    std::vector<std::string> cloths;     ///< their names
    std::optional<double> volume{};      ///< m^3 at ambient pressure
    std::vector<NumberKey> volume_keys;  ///< m^3, strictly increasing in time
    double ambient = 101325;             ///< Pa, absolute: what presses on the cloths from outside
    /// The side of the first cloth that is outside; nothing: that by which they close in a volume above 0 at the start.
    std::optional<ClothSide> outside{};
    bool operator==(const Gas&) const = default;
};

}  // namespace drape
