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

}  // namespace drape
