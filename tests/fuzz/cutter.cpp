// Cuts a small cloth, by blades that sweep through it and by findings of any kind (a checkpoint's), and after each
// recounts the springs, triangles and pieces from the cells that there were and the springs that were cut.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <set>

#include "cloth/directions.h"
#include "cloth/simulation_model.h"
#include "cloth/texels.h"
#include "fuzz.h"
#include "support/cut_checks.h"
#include "support/sheets.h"
#include "twin/cut_twin.h"

namespace drape {
namespace {

using fuzz::Dice;
using fuzz::require;

class Recount {
  public:
    Recount(const Cloth& cloth, const CutTopology& topology)
        : columns_(static_cast<int>(cloth.grid[0])), rows_(static_cast<int>(cloth.grid[1])), topology_(topology) {
        for (int row = 0; row + 1 < rows_; ++row)
            for (int column = 0; column + 1 < columns_; ++column) {
                bool missing = false;
                for (const IndexBox& hole : cloth.holes)
                    missing = missing ||
                              (column >= static_cast<int>(hole.first[0]) && column < static_cast<int>(hole.last[0]) &&
                               row >= static_cast<int>(hole.first[1]) && row < static_cast<int>(hole.last[1]));
                if (!missing) cells_.insert({column, row});
            }
        area_ = static_cast<double>(cells_.size()) * cloth.size[0] / (columns_ - 1) * cloth.size[1] / (rows_ - 1);
        edge_triangles_ = triangle_count();
    }

    /// Takes a cut's findings, and checks the counts that it made of them.
    void take(const CutFindings& findings, const CutCounts& counts) {
        std::uint32_t springs = 0;
        for (int row = 0; row < rows_; ++row)
            for (int column = 0; column < columns_; ++column)
                for (std::size_t k = 0; k < 4; ++k) {
                    const float found = component(findings.fractions[index(column, row)], k);
                    if (!(found >= 0) || share(column, row, k) == 0) continue;
                    springs += cut_.insert({index(column, row), k}).second;
                }
        if (springs > 0)
            for (const auto& [column, row] : cells_)
                if (!cut_.contains({index(column, row), 2}) && !hangs_together(column, row))
                    springs += cut_.insert({index(column, row), 2}).second;
        require(springs == counts.springs, "not so many springs were cut as were found");
        const std::uint32_t left = triangle_count();
        require(edge_triangles_ - left == counts.triangles, "not so many triangles were split as have two cut edges");
        edge_triangles_ = left;
    }

    void check() const {
        for (int row = 0; row < rows_; ++row)
            for (int column = 0; column < columns_; ++column)
                for (std::size_t k = 0; topology_.masked() && k < 4; ++k) {
                    const bool is_cut = cut_.contains({index(column, row), k});
                    const float expected = is_cut ? 0.0f : share(column, row, k);
                    require(component(topology_.spring_shares()[index(column, row)], k) == expected,
                            fmt::format("spring {} of particle {}, {} has another share", k, column, row));
                    require((topology_.cut_fraction(index(column, row), k) >= 0) == is_cut, "another spring is cut");
                }
        require(topology_.grid().triangle_indices().size() == 3 * std::size_t{edge_triangles_},
                "other triangles are whole");
        require(std::abs(topology_.rest_area() - area_) <= 1e-6 * area_ + 1e-12, "cutting changed the area");
        test::expect_consistent(topology_);
    }

  private:
    using Place = std::pair<int, int>;

    std::size_t index(int column, int row) const { return static_cast<std::size_t>(row * columns_ + column); }
    bool cell(int column, int row) const { return cells_.contains({column, row}); }
    /// Each cell gives half a spring to each of its sides, and both its diagonals.
    float share(int column, int row, std::size_t direction) const {
        switch (direction) {
            case 0:
                return 0.5f * static_cast<float>(cell(column, row) + cell(column, row - 1));
            case 1:
                return 0.5f * static_cast<float>(cell(column, row) + cell(column - 1, row));
            case 2:
                return cell(column, row) ? 1.0f : 0.0f;
            default:
                return cell(column - 1, row) ? 1.0f : 0.0f;
        }
    }
    /// Returns whether the edge of the mesh between two corners of a cell is whole.
    bool edge(Place a, Place b) const {
        if (a.second > b.second || (a.second == b.second && a.first > b.first)) std::swap(a, b);
        const std::size_t direction = a.second == b.second ? 0 : a.first == b.first ? 1 : 3;
        return !cut_.contains({index(a.first, a.second), direction});
    }
    /// Returns whether a cell's upper left and lower right corners are joined by whole edges of it.
    bool hangs_together(int column, int row) const {
        const Place a{column, row}, b{column + 1, row}, c{column, row + 1}, d{column + 1, row + 1};
        const bool through_b = edge(a, b) && edge(b, d), through_c = edge(a, c) && edge(c, d);
        const bool across = edge(b, c) && ((edge(a, b) && edge(c, d)) || (edge(a, c) && edge(b, d)));
        return through_b || through_c || across;
    }
    /// Counts the triangles with at most one cut edge.
    std::uint32_t triangle_count() const {
        std::uint32_t count = 0;
        for (const auto& [column, row] : cells_) {
            const Place a{column, row}, b{column + 1, row}, c{column, row + 1}, d{column + 1, row + 1};
            count += edge(a, b) + edge(b, c) + edge(c, a) >= 2;
            count += edge(b, d) + edge(d, c) + edge(c, b) >= 2;
        }
        return count;
    }

    int columns_, rows_;
    const CutTopology& topology_;
    std::set<Place> cells_;
    std::set<std::pair<std::size_t, std::size_t>> cut_;
    std::uint32_t edge_triangles_ = 0;
    double area_ = 0;
};

SceneDescription cloth_of(Dice& dice) {
    const std::uint32_t columns = 2 + dice.below(6), rows = 2 + dice.below(6);
    SceneDescription scene = test::sheet(columns, rows, 0.1 * (columns - 1), 0.1 * (rows - 1), 1);
    for (std::uint32_t k = dice.below(3); k > 0; --k) {
        IndexBox hole;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const std::uint32_t count = axis == 0 ? columns : rows;
            hole.first[axis] = dice.below(count);
            hole.last[axis] = hole.first[axis] + dice.below(count - hole.first[axis]);
        }
        scene.cloths[0].holes.push_back(hole);
    }
    return scene;
}

/// Returns a place on a particle, or anywhere about the cloth.
Vec3 corner(Dice& dice, const ClothModel& cloth) {
    if (dice.chance(0.3)) {
        const glsl::vec4& at = cloth.position[dice.below(static_cast<std::uint32_t>(cloth.position.size()))];
        return {static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(at.z)};
    }
    const double x = dice.uniform(-0.2, 0.8), y = dice.uniform(-0.8, 0.2), z = dice.uniform(-0.5, 0.5);
    return {x, y, dice.chance(0.1) ? 0 : z};
}

CutFindings by_blades(Dice& dice, const ClothModel& cloth, const CutTopology& topology,
                      const std::vector<glsl::vec4>& position) {
    std::vector<Cutter> cutters(1 + dice.below(2));
    for (Cutter& cutter : cutters) {
        for (Vec3& point : cutter.triangle) point = corner(dice, cloth);
        cutter.begin = dice.uniform(0, 1);
        cutter.end = cutter.begin + dice.uniform(0, 1);
        if (!dice.chance(0.5)) continue;
        const Vec3 by = corner(dice, cloth);
        const double turn = dice.uniform(-400, 400);
        cutter.path.keys = {{0, {}, {}}, {2, by, {turn, 0, -turn}}};
    }
    const double from = dice.uniform(0, 2), to = from + dice.uniform(0, 0.5);
    const auto triangles = cutter_triangles(cutters, from, to);
    require(triangles.size() == cutters.size() * glsl::cutter_triangle_count, "cutters have another room");
    require(cutters_active(cutters, from, to) == (triangles[0].a.w != 0), "an active cutter without a triangle");
    CutFindings found = find_cuts(topology, position, triangles);
    for (const glsl::vec4& fractions : found.fractions)
        for (std::size_t k = 0; k < 4; ++k) {
            const float f = component(fractions, k);
            require(f == -1 || (f >= 0 && f <= 1), "a spring crossed beyond its ends");
        }
    return found;
}

CutFindings any_findings(Dice& dice, const CutTopology& topology) {
    CutFindings findings;
    findings.fractions.resize(topology.cloth().grid.particle_count(), {-1, -1, -1, -1});
    for (std::uint32_t k = dice.below(12); k > 0; --k) {
        glsl::vec4& at = findings.fractions[dice.below(static_cast<std::uint32_t>(findings.fractions.size()))];
        const std::uint32_t direction = dice.below(4);
        component(at, direction) = dice.chance(0.2) ? std::bit_cast<float>(static_cast<std::uint32_t>(dice.bits(4)))
                                                    : static_cast<float>(dice.uniform(0, 1));
    }
    return findings;
}

/// Returns positions that the simulation may have come to.
std::vector<glsl::vec4> moved(Dice& dice, std::vector<glsl::vec4> position) {
    const double by = dice.chance(0.5) ? 0 : dice.log_uniform(1e-6, 1);
    for (glsl::vec4& at : position)
        for (std::size_t k = 0; by > 0 && k < 3; ++k) component(at, k) += static_cast<float>(dice.uniform(-by, by));
    return position;
}

}  // namespace
}  // namespace drape

extern "C" int DRAPE_FUZZ_ENTRY(cutter)(const std::uint8_t* data, std::size_t size) {
    using namespace drape;
    // The checks of expect_consistent throw where no test is running.
    GTEST_FLAG_SET(throw_on_failure, testing::UnitTest::GetInstance()->current_test_info() == nullptr);
    fuzz::Dice dice({data, size});
    const SceneDescription scene = cloth_of(dice);
    const ClothModel cloth(scene, 0);
    CutTopology topology(cloth);
    Recount recount(scene.cloths[0], topology);
    recount.check();
    const std::uint32_t cuts = 1 + dice.below(8);
    for (std::uint32_t k = 0; k < cuts; ++k) {
        const std::vector<glsl::vec4> position = moved(dice, cloth.position);
        const CutFindings findings =
            dice.chance(0.6) ? by_blades(dice, cloth, topology, position) : any_findings(dice, topology);
        const CutCounts counts = topology.apply(findings);
        recount.take(findings, counts);
        recount.check();
    }
    return 0;
}
