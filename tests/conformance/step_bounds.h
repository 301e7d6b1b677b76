// How far a device may be from the twin after one step, by the kind of step, and why.
#pragma once

#include <string_view>
#include <vector>

#include "cloth/step.h"
#include "field_pair.h"

namespace drape::test {

/// A longer chain of operations has more roundings.
enum class Chain : std::uint8_t {
    fixed,  ///< as long for every particle
    steps,  ///< a bound counts for each of the steps that are taken at once
    lines,  ///< a bound counts for each particle of the cloth's longest line
};

/// A bound counts units of the last place of a float, at the magnitude of the field's largest number (FieldPair): what
/// is smaller is a difference of such numbers and has their rounding. What follows from a decision that rounding turned
/// is not compared.
struct StepBound {
    StepKind kind;
    double units;  ///< 0: the same numbers; below 0: the twin has no such step
    Chain chain;
    double turned;  ///< so many of a thousand integers, which are decisions, rounding may turn
    std::string_view reason;

    /// Its work is seen in a later step only.
    bool is_judged_later() const { return units < 0; }
    /// Returns how many of a field's decisions rounding may turn.
    double may_turn(const FieldPair& pair) const {
        return turned / 1000 * static_cast<double>(pair.twin_integers.size());
    }
    /// Returns the bound of a step of a cloth, whose longest line has so many particles.
    double units_of(const Step& step, std::uint32_t longest_line) const {
        return units * (chain == Chain::steps ? step.count : chain == Chain::lines ? longest_line : 1);
    }
};

/// By StepKind.
const std::vector<StepBound>& step_bounds();

struct Difference {
    std::size_t count = 0;   ///< of numbers and integers
    std::size_t beyond = 0;  ///< those that are farther apart than so many units
    double units = 0;        ///< the largest distance; infinite where one is no number, or integers differ
};

Difference difference_of(const FieldPair& pair, double units);

}  // namespace drape::test
