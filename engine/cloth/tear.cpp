#include "cloth/tear.h"

#include <algorithm>
#include <array>
#include <limits>

#include "cloth/directions.h"
#include "cloth/texels.h"

namespace drape {

namespace {

/// A spring along a row (axis 0) or a column (axis 1), by its first particle.
struct Thread {
    int column, row;
    std::size_t axis;
    bool operator==(const Thread&) const = default;
};

/// Column and row of a cell.
using Cell = glsl::ivec2;

std::array<Cell, 2> cells_beside(const Thread& thread) {
    const Cell own{thread.column, thread.row};
    return {thread.axis == 0 ? Cell{own.x, own.y - 1} : Cell{own.x - 1, own.y}, own};
}

/// Returns the threads around a cell; the thread two places on is the opposite one.
std::array<Thread, 4> sides_of(const Cell& cell) {
    return {{{cell.x, cell.y, 0}, {cell.x + 1, cell.y, 1}, {cell.x, cell.y + 1, 0}, {cell.x, cell.y, 1}}};
}

class Tearing {
  public:
    Tearing(const CutTopology& topology, const std::vector<glsl::vec4>& loads)
        : topology_(topology),
          grid_(topology.cloth().grid),
          loads_(loads),
          pieces_(pieces_of(topology)),
          torn_(grid_.particle_count(), {-1, -1, -1, -1}),
          touched_(grid_.cells().size()),
          done_(grid_.particle_count()),
          grown_(grid_.particle_count()) {}

    CutFindings run() {
        const std::vector<Thread> overloaded = find_overloaded();
        for (const Thread& thread : overloaded) go_on(thread);
        for (const Thread& thread : overloaded) begin(thread);
        end_diagonals();
        return {{}, torn_};
    }

  private:
    std::size_t particle(const Thread& thread) const {
        return grid_.particle(static_cast<std::uint32_t>(thread.column), static_cast<std::uint32_t>(thread.row));
    }
    float load(const Thread& thread) const { return component(loads_[particle(thread)], thread.axis); }
    bool is_cell(const Cell& cell) const { return grid_.cell(cell.x, cell.y) != 0; }
    std::size_t index(const Cell& cell) const {
        return static_cast<std::size_t>(cell.y) * (grid_.columns() - 1) + static_cast<std::size_t>(cell.x);
    }
    bool ended(const Thread& thread) const { return topology_.cut_fraction(particle(thread), thread.axis) >= 0; }
    bool is_torn(const Thread& thread) const { return component(torn_[particle(thread)], thread.axis) >= 0; }
    /// Returns whether a side of the cell tore in an earlier frame.
    bool is_open(const Cell& cell) const {
        return is_cell(cell) && std::ranges::any_of(sides_of(cell), [&](const Thread& side) { return ended(side); });
    }
    bool may_tear(const Thread& thread) const {
        const auto free = [&](const Cell& cell) { return !is_cell(cell) || !touched_[index(cell)]; };
        return !done_[pieces_[particle(thread)]] && std::ranges::all_of(cells_beside(thread), free);
    }

    /// Returns the springs that bear more than their limit, the most loaded first.
    std::vector<Thread> find_overloaded() const {
        std::vector<Thread> found;
        const glsl::ivec2 size = grid_.size();
        for (int row = 0; row < size.y; ++row)
            for (int column = 0; column < size.x; ++column)
                for (const std::size_t axis : {0u, 1u})
                    if (const Thread thread{column, row, axis}; load(thread) > 1) found.push_back(thread);
        std::ranges::stable_sort(found, std::ranges::greater(), [&](const Thread& thread) { return load(thread); });
        return found;
    }

    void tear(const Thread& thread) {
        component(torn_[particle(thread)], thread.axis) = 0.5f;
        grown_[pieces_[particle(thread)]] = true;
    }

    void touch(const Thread& thread) {
        for (const Cell& cell : cells_beside(thread))
            if (is_cell(cell)) touched_[index(cell)] = true;
    }

    void go_on(const Thread& thread) {
        const auto [before, after] = cells_beside(thread);
        const bool from_before = is_open(before), from_after = is_open(after);
        if ((!from_before && !from_after) || !may_tear(thread)) return;
        tear(thread);
        if (from_before && from_after)
            done_[pieces_[particle(thread)]] = true;
        else
            lead(thread, from_before ? after : before);
        touch(thread);
    }

    void begin(const Thread& thread) {
        if (grown_[pieces_[particle(thread)]] || !may_tear(thread)) return;
        tear(thread);
        for (const Cell& cell : cells_beside(thread)) lead(thread, cell);
        touch(thread);
    }

    /// Continues a tear from a thread into a cell, and on from there.
    void lead(Thread from, Cell into) {
        for (;;) {
            if (!is_cell(into) || is_open(into) || touched_[index(into)]) {
                done_[pieces_[particle(from)]] = true;
                return;
            }
            touched_[index(into)] = true;
            const std::array<Thread, 4> sides = sides_of(into);
            const auto entry = static_cast<std::size_t>(std::ranges::find(sides, from) - sides.begin());
            std::size_t way = (entry + 2) % 4;  // among equal sides, the opposite one
            for (const std::size_t turn : {1u, 3u})
                if (const std::size_t side = (entry + turn) % 4; load(sides[side]) > load(sides[way])) way = side;
            if (!(load(sides[way]) > 1)) return;
            from = sides[way];
            tear(from);
            const auto [before, after] = cells_beside(from);
            into = before == into ? after : before;
        }
    }

    /// The corners of a cell that a diagonal joins are also connected around the cell. Where both of these connections
    /// tore, the diagonal that is an edge of the mesh ends too. CutTopology handles the other diagonal.
    void end_diagonals() {
        const glsl::ivec2 size = grid_.size();
        const auto is_through = [&](const Thread& thread) { return is_torn(thread) || ended(thread); };
        for (int row = 0; row + 1 < size.y; ++row)
            for (int column = 0; column + 1 < size.x; ++column) {
                const std::array<Thread, 4> sides = sides_of({column, row});
                if (!is_cell({column, row}) || std::ranges::none_of(sides, [&](auto& side) { return is_torn(side); }))
                    continue;
                // The upper and the left side meet at a corner where this diagonal does not end, and so do the other
                // two.
                if ((is_through(sides[0]) || is_through(sides[3])) && (is_through(sides[1]) || is_through(sides[2])))
                    component(torn_[particle({column + 1, row, 0})], 3) = 0.5f;
            }
    }

    const CutTopology& topology_;
    const Grid& grid_;
    const std::vector<glsl::vec4>& loads_;
    std::vector<std::size_t> pieces_;
    std::vector<glsl::vec4> torn_;
    std::vector<bool> touched_;       ///< cells that a tear of this frame passed through
    std::vector<bool> done_, grown_;  ///< pieces in which nothing else tears; pieces in which a tear continued or began
};

/// Returns a cell's load limit divided by the cloth's.
float tear_factor(const Cloth& cloth, const Grid& grid, const Cell& cell) {
    if (cloth.cell_tear.empty()) return 1;
    return cloth.cell_tear[static_cast<std::size_t>(cell.y) * (grid.columns() - 1) + static_cast<std::size_t>(cell.x)];
}

/// Returns the limit, and the weight of the diagonals, of a spring; the weaker of its cells decides.
std::array<double, 2> thread_limit(const Cloth& cloth, const Grid& grid, const Thread& thread,
                                   const std::array<double, 2>& spacing) {
    double factor = std::numeric_limits<double>::infinity(), stiffness = 0;
    int count = 0;
    for (const Cell& cell : cells_beside(thread)) {
        if (grid.cell(cell.x, cell.y) == 0) continue;
        factor = std::min(factor, static_cast<double>(tear_factor(cloth, grid, cell)));
        stiffness += static_cast<double>(grid.cell_stiffness(cell.x, cell.y));
        ++count;
    }
    if (count == 0) return {1, 0};  // the spring does not exist
    if (cloth.tear->strain) return {*cloth.tear->strain * factor, 0};
    const double stretch = cloth.stiffness.stretch.along(thread.axis) * stiffness / count,
                 across = spacing[1 - thread.axis];
    // Each of a cell's two diagonals transmits (diagonal / across)^2 / 2 of its strain, as shear, through the cell's
    // width.
    const double diagonal_squared = spacing[0] * spacing[0] + spacing[1] * spacing[1];
    const double of_diagonals = cloth.stiffness.shear * diagonal_squared / (2 * across * across * count);
    return {*cloth.tear->tension * factor / stretch, of_diagonals / stretch};
}

}  // namespace

std::vector<glsl::vec4> tear_limits(const Cloth& cloth, const Grid& grid) {
    const std::array<double, 2> spacing = grid_spacing(cloth);
    std::vector<glsl::vec4> limits;
    limits.reserve(grid.particle_count());
    for (int row = 0; row < grid.size().y; ++row)
        for (int column = 0; column < grid.size().x; ++column) {
            const auto along_row = thread_limit(cloth, grid, {column, row, 0}, spacing);
            const auto along_column = thread_limit(cloth, grid, {column, row, 1}, spacing);
            limits.push_back({static_cast<float>(along_row[0]), static_cast<float>(along_column[0]),
                              static_cast<float>(along_row[1]), static_cast<float>(along_column[1])});
        }
    return limits;
}

glsl::TearPush tear_push(const ClothGeometry& cloth) {
    const PerDirection<double>& rest = cloth.stiffness_constant.rest_length;
    return {cloth.grid.size(), static_cast<float>(rest[0]), static_cast<float>(rest[1]), static_cast<float>(rest[2]),
            cloth.compression};
}

CutFindings torn_springs(const CutTopology& topology, const std::vector<glsl::vec4>& loads) {
    return Tearing(topology, loads).run();
}

}  // namespace drape
