// Finds repeated blocks in a sequence, so that dumps show one substep and "x 20".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace drape::graph {

/// A position of the sequence, or a block that comes `count` times in a row.
struct Fold {
    std::uint32_t count = 1;
    std::uint32_t position = 0;  ///< the first position at which it occurs
    std::vector<Fold> body;      ///< parts of one repetition; empty: the item at `position`
};

struct Folding {
    std::vector<Fold> folds;
    /// For every position, the position that represents it: the same place in the first repetition.
    std::vector<std::uint32_t> representative;
};

/// Folds short blocks first, so that repetitions nest (iterations within substeps). Equal numbers are equal items.
Folding fold(std::span<const std::uint32_t> sequence);

}  // namespace drape::graph
