#include "graph/fold.h"

#include <gtest/gtest.h>

#include <string>

namespace drape::graph {
namespace {

std::string text(const std::vector<Fold>& folds, const std::string& sequence) {
    std::string out;
    for (const Fold& fold : folds) {
        if (fold.body.empty()) {
            out += sequence[fold.position];
        } else {
            out += std::to_string(fold.count) + "(" + text(fold.body, sequence) + ")";
        }
    }
    return out;
}

std::string folded(const std::string& sequence) {
    const std::vector<std::uint32_t> items(sequence.begin(), sequence.end());
    return text(fold(items).folds, sequence);
}

TEST(Folding, FindsRepeatedBlocksAndNestsThem) {
    EXPECT_EQ(folded(""), "");
    EXPECT_EQ(folded("abc"), "abc");
    EXPECT_EQ(folded("aaaa"), "4(a)");
    EXPECT_EQ(folded("xababaz"), "x2(ab)az");
    EXPECT_EQ(folded("fabababgfabababgn"), "2(f3(ab)g)n");
    EXPECT_EQ(folded("abbabbc"), "2(a2(b))c");
}

TEST(Folding, EveryPositionIsStoodForByTheSamePlaceOfTheFirstRepetition) {
    const std::string sequence = "xfababfababn";
    const std::vector<std::uint32_t> items(sequence.begin(), sequence.end());
    EXPECT_EQ(fold(items).representative, (std::vector<std::uint32_t>{0, 1, 2, 3, 2, 3, 1, 2, 3, 2, 3, 11}));
}

}  // namespace
}  // namespace drape::graph
