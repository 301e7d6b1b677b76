#include "input/positions_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "input/array_file.h"
#include "input/file_source.h"
#include "input/obj_file.h"
#include "input/point_cache.h"

namespace drape::input {

namespace {

using Positions = std::vector<std::array<double, 3>>;

struct GridSize {
    std::uint32_t columns, rows;
    std::uint64_t count() const { return std::uint64_t{columns} * rows; }
    std::string text() const { return fmt::format("{} x {} particles", columns, rows); }
    std::vector<std::uint64_t> neighbours(std::uint64_t particle) const {
        std::vector<std::uint64_t> all;
        if (particle % columns > 0) all.push_back(particle - 1);
        if (particle % columns + 1 < columns) all.push_back(particle + 1);
        if (particle >= columns) all.push_back(particle - columns);
        if (particle + columns < count()) all.push_back(particle + columns);
        return all;
    }
};

/// The possible numbers of points in a mesh or a point cache.
struct PointCounts {
    PointCounts(const GridSize& grid, const std::vector<bool>& is_used)
        : all(grid.count()),
          used(is_used.empty() ? all : static_cast<std::uint64_t>(std::ranges::count(is_used, true))) {}
    std::uint64_t all, used;
    bool allow(std::uint64_t count) const { return count == all || count == used; }
    std::string text(std::string_view points) const {
        return used == all ? fmt::format("{} {}", all, points)
                           : fmt::format("{} {}, or {} without those in holes", all, points, used);
    }
};

/// Returns all particles of the grid, from those that are used.
Positions with_unused(const Positions& used, const GridSize& grid, const std::vector<bool>& is_used) {
    Positions all(grid.count());
    std::vector<bool> is_placed(grid.count());
    std::vector<std::uint64_t> placed;
    for (std::uint64_t particle = 0; particle < grid.count(); ++particle) {
        if (!is_used[particle]) continue;
        all[particle] = used[placed.size()];
        is_placed[particle] = true;
        placed.push_back(particle);
    }
    for (std::size_t next = 0; next < placed.size(); ++next)
        for (const std::uint64_t particle : grid.neighbours(placed[next])) {
            if (is_placed[particle]) continue;
            double count = 0;
            for (const std::uint64_t neighbour : grid.neighbours(particle)) {
                if (!is_placed[neighbour]) continue;
                ++count;
                for (std::size_t k = 0; k < 3; ++k) all[particle][k] += (all[neighbour][k] - all[particle][k]) / count;
            }
            is_placed[particle] = true;
            placed.push_back(particle);
        }
    return all;
}

OutputError of_another_shape(const std::string& name, const GridSize& grid, const std::string& wanted,
                             const std::string& got) {
    return unreadable(name, fmt::format("the grid of {} needs {}, and it has {}", grid.text(), wanted, got));
}

Positions array_positions(const std::filesystem::path& path, const GridSize& grid, std::string_view name) {
    const Array array = load_array(path, name, [&](const Array& head) -> std::uint64_t {
        const std::vector<std::uint64_t>& shape = head.shape;
        const bool is_real = head.type == "<f4" || head.type == "<f8";
        const std::size_t frames = shape.size() == 4 ? 1 : 0;
        const bool fits = is_real && shape.size() == 3 + frames && shape[frames] == grid.rows &&
                          shape[frames + 1] == grid.columns && shape[frames + 2] == 3;
        if (!fits || (frames == 1 && shape[0] == 0))
            throw of_another_shape(
                path.string(), grid,
                fmt::format("float32 or float64 ({0}, {1}, 3) or (frames, {0}, {1}, 3)", grid.rows, grid.columns),
                head.text());
        return 3 * grid.count();
    });
    Positions positions(grid.count());
    for (std::size_t i = 0; i < positions.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) positions[i][k] = array.value(3 * i + k);
    return positions;
}

Positions mesh_vertices(const std::filesystem::path& path, const GridSize& grid, const PointCounts& counts) {
    Positions positions = read_obj_vertices(path);
    if (!counts.allow(positions.size()))
        throw of_another_shape(path.string(), grid, counts.text("vertices"), fmt::format("{}", positions.size()));
    return positions;
}

Positions cached_points(const std::filesystem::path& path, const GridSize& grid, const PointCounts& counts) {
    FileSource file(path);
    const PointCacheHead header = read_head(file);
    const auto count = static_cast<std::uint64_t>(header.points);
    if (!counts.allow(count))
        throw of_another_shape(file.name(), grid, counts.text("points"), fmt::format("{}", count));
    const std::uint64_t bytes = 12 * count;
    file.skip(bytes * static_cast<std::uint64_t>(header.samples - 1));
    std::vector<std::array<float, 3>> sample(count);
    if (file.read(reinterpret_cast<char*>(sample.data()), bytes) != bytes)
        throw unreadable(file.name(), "it ends too early");
    Positions positions;
    positions.reserve(sample.size());
    for (const auto& [x, y, z] : sample) positions.push_back({x, y, z});
    return positions;
}

}  // namespace

Positions read_positions(const std::filesystem::path& path, std::uint32_t columns, std::uint32_t rows,
                         const std::vector<bool>& is_used) {
    const GridSize grid{columns, rows};
    const PointCounts counts(grid, is_used);
    const auto whole = [&](Positions found) {
        return found.size() == counts.all ? std::move(found) : with_unused(found, grid, is_used);
    };
    const std::string extension = extension_of(path);
    if (extension == ".npy" || extension == ".npz") return array_positions(path, grid, "positions");
    if (extension == ".obj") return whole(mesh_vertices(path, grid, counts));
    if (extension == ".pc2") return whole(cached_points(path, grid, counts));
    throw unreadable(path.string(), "positions are read from .npy, .npz, .obj and .pc2");
}

std::vector<std::array<double, 3>> read_velocities(const std::filesystem::path& path, std::uint32_t columns,
                                                   std::uint32_t rows) {
    const std::string extension = extension_of(path);
    if (extension != ".npy" && extension != ".npz")
        throw unreadable(path.string(), "velocities are read from .npy and .npz");
    return array_positions(path, {columns, rows}, "velocities");
}

}  // namespace drape::input
