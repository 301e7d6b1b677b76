#include "scene/nearest_word.h"

#include <algorithm>
#include <vector>

namespace drape {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0u : 1u)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

}  // namespace

std::string_view nearest_word(std::string_view misspelt, std::span<const std::string_view> candidates) {
    constexpr std::size_t farthest = 2;
    std::string_view nearest;
    std::size_t best = farthest + 1;
    for (const std::string_view candidate : candidates) {
        if (misspelt.size() > candidate.size() + farthest) continue;  // a word may be a megabyte long
        const std::size_t distance = edit_distance(misspelt, candidate);
        if (distance < best && distance < candidate.size()) {
            best = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

}  // namespace drape
