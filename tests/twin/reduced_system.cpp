#include "twin/reduced_system.h"

#include <array>
#include <span>

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

namespace {

constexpr auto each = static_cast<std::size_t>(part_particles);

/// The rows of a system that an invocation has.
struct PartRows {
    std::array<CyclicRow, each> rows;
    CyclicRow first, own;  ///< of its first unknown and of its last

    /// Eliminates all unknowns but the last.
    void eliminate() {
        for (std::size_t j = 1; j < each; ++j) {
            rows[j - 1] = normalised_row(rows[j - 1]);
            rows[j] = without_before(rows[j], rows[j - 1]);
        }
        first = rows[each - 2];
        for (std::size_t j = each - 2; j-- > 0;) first = joined_row(rows[j], first);
        own = rows[each - 1];
    }
    void substitute(vec3 before, vec3 last, vec3* solution) const {
        solution[each - 1] = last;
        for (std::size_t j = each - 1; j-- > 0;) solution[j] = part_solution(rows[j], before, solution[j + 1]);
    }
};

/// Reduces the first `count` rows, which are left coupled to what is before them and to the row after them.
void reduce(std::span<CyclicRow> rows, std::size_t count) {
    for (std::size_t distance = 1; distance < count; distance *= 2) {
        std::vector<CyclicRow> normal;
        for (const CyclicRow& row : rows) normal.push_back(normalised_row(row));
        for (std::size_t i = 0; i < count; ++i) {
            if (i >= distance) rows[i] = without_before(rows[i], normal[i - distance]);
            if (i + distance < count) rows[i] = without_after(rows[i], normal[i + distance]);
        }
    }
}

/// A subgroup has the last rows of its invocations, all but the last one reduced and normalised, and the row of its
/// first unknown.
struct SubgroupRows {
    std::vector<CyclicRow> own;
    CyclicRow first;

    explicit SubgroupRows(std::span<const PartRows> parts) {
        for (std::size_t lane = 0; lane < parts.size(); ++lane)
            own.push_back(lane + 1 < parts.size() ? without_after(parts[lane].own, parts[lane + 1].first)
                                                  : parts[lane].own);
        const std::size_t last = own.size() - 1;
        reduce(own, last);
        for (std::size_t lane = 0; lane < last; ++lane) own[lane] = normalised_row(own[lane]);
        own[last] = without_before(own[last], own[last - 1]);
        first = joined_row(parts.front().first, own.front());
    }
};

/// Returns the last unknowns of subgroups.
std::vector<vec3> last_unknowns(const std::vector<SubgroupRows>& groups) {
    std::vector<CyclicRow> rows;
    for (std::size_t k = 0; k < groups.size(); ++k)
        rows.push_back(k + 1 < groups.size() ? without_after(groups[k].own.back(), groups[k + 1].first)
                                             : groups[k].own.back());
    reduce(rows, rows.size());
    std::vector<vec3> unknowns;
    for (const CyclicRow& row : rows) unknowns.push_back(cyclic_solution(row));
    return unknowns;
}

}  // namespace

std::vector<vec3> reduced_in_parts(std::vector<CyclicRow> rows, std::uint32_t subgroup) {
    const std::size_t count = rows.size(), lanes = subgroup / part_lines;
    rows.resize((count - 1) / (lanes * each) * lanes * each + lanes * each, no_cyclic_row());
    std::vector<PartRows> parts(rows.size() / each);
    for (std::size_t i = 0; i < rows.size(); ++i) parts[i / each].rows[i % each] = rows[i];
    for (PartRows& part : parts) part.eliminate();
    std::vector<SubgroupRows> groups;
    for (std::size_t i = 0; i < parts.size(); i += lanes) groups.emplace_back(std::span(parts).subspan(i, lanes));
    const std::vector<vec3> last = last_unknowns(groups);
    std::vector<vec3> solution(rows.size());
    vec3 before{0, 0, 0};  // the unknown before an invocation's
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::size_t group = i / lanes, lane = i % lanes;
        const vec3 of_group_before = group > 0 ? last[group - 1] : vec3{0, 0, 0};
        const vec3 own =
            lane + 1 < lanes ? part_solution(groups[group].own[lane], of_group_before, last[group]) : last[group];
        parts[i].substitute(before, own, &solution[each * i]);
        before = own;
    }
    solution.resize(count);
    return solution;
}

}  // namespace drape
