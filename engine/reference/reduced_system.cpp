#include "reference/reduced_system.h"

namespace drape {

using namespace glsl;

std::vector<vec3> reduced(std::vector<CyclicRow> rows) {
    for (std::size_t distance = 1; distance < rows.size(); distance *= 2) {
        std::vector<CyclicRow> farther;
        for (std::size_t i = 0; i < rows.size(); ++i)
            farther.push_back(reduced_row(rows[i], i >= distance ? rows[i - distance] : no_cyclic_row(),
                                          i + distance < rows.size() ? rows[i + distance] : no_cyclic_row()));
        rows = farther;
    }
    std::vector<vec3> solution;
    for (const CyclicRow& row : rows) solution.push_back(cyclic_solution(row));
    return solution;
}

std::vector<vec3> reduced(std::vector<BentRow> rows) {
    const std::size_t count = rows.size();
    if (count % 2 != 0) rows.push_back(no_bent_row(true));
    const auto block = [&](std::size_t first) {
        // Places before the first row wrap around to beyond the last.
        return first < rows.size() ? BentBlock(rows[first], rows[first + 1])
                                   : BentBlock(no_bent_row(false), no_bent_row(true));
    };
    for (std::size_t distance = 1; 2 * distance < count; distance *= 2) {
        std::vector<BentRow> farther;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::size_t first = i - i % 2;
            farther.push_back(reduced_bent_row(rows[i], block(first - 2 * distance), block(first + 2 * distance),
                                               static_cast<int>(distance)));
        }
        rows = farther;
    }
    std::vector<vec3> solution;
    for (std::size_t i = 0; i < count; ++i) solution.push_back(bent_solution(block(i - i % 2), i % 2 != 0));
    return solution;
}

}  // namespace drape
