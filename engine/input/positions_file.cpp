#include "input/positions_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cstring>
#include <string_view>

#include "input/array_file.h"
#include "input/file_source.h"

namespace drape::input {

namespace {

using Positions = std::vector<std::array<double, 3>>;

struct GridSize {
    std::uint32_t columns, rows;
    std::uint64_t count() const { return std::uint64_t{columns} * rows; }
    std::string text() const { return fmt::format("{} x {} particles", columns, rows); }
};

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

/// Hands out the lines of a file, one after another.
class Lines {
  public:
    explicit Lines(FileSource& file) : file_(file) {}

    /// Returns whether there was another line.
    bool next(std::string_view& line) {
        constexpr std::size_t most_line = std::size_t{1} << 20;
        ++number_;
        for (;;) {
            const std::size_t end = text_.find('\n', begin_);
            if (end != text_.npos || (ended_ && begin_ < text_.size())) {
                const std::size_t stop = std::min(end, text_.size());
                line = std::string_view(text_).substr(begin_, stop - begin_);
                begin_ = stop + 1;
                return true;
            }
            if (ended_) return false;
            text_.erase(0, begin_);
            begin_ = 0;
            const std::size_t had = text_.size();
            if (had > most_line) throw unreadable(file_.name(), fmt::format("line {} is too long", number_));
            text_.resize(had + 65536);
            text_.resize(had + file_.read(text_.data() + had, 65536));
            ended_ = text_.size() == had;
        }
    }
    std::uint64_t number() const { return number_; }

  private:
    FileSource& file_;
    std::string text_;
    std::size_t begin_ = 0;
    std::uint64_t number_ = 0;
    bool ended_ = false;
};

bool read_vertex(std::string_view line, std::array<double, 3>& vertex) {
    constexpr std::string_view blanks = " \t\r";
    for (double& x : vertex) {
        line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
        const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), x);
        if (error != std::errc{}) return false;
        line.remove_prefix(static_cast<std::size_t>(end - line.data()));
        if (!line.empty() && blanks.find(line.front()) == blanks.npos) return false;
    }
    return true;
}

Positions mesh_vertices(const std::filesystem::path& path, const GridSize& grid) {
    FileSource file(path);
    Lines lines(file);
    Positions positions;
    std::uint64_t count = 0;
    for (std::string_view line; lines.next(line);) {
        if (!line.starts_with("v ") && !line.starts_with("v\t")) continue;
        if (++count > grid.count()) continue;
        if (!read_vertex(line.substr(1), positions.emplace_back()))
            throw unreadable(file.name(), fmt::format("line {} is no vertex of three numbers", lines.number()));
    }
    if (count != grid.count())
        throw of_another_shape(file.name(), grid, fmt::format("{} vertices", grid.count()), fmt::format("{}", count));
    return positions;
}

Positions cached_points(const std::filesystem::path& path, const GridSize& grid) {
    FileSource file(path);
    struct {
        char signature[12];
        std::int32_t version, points;
        float start, step;
        std::int32_t samples;
    } header{};
    static_assert(sizeof header == 32);
    if (file.read(reinterpret_cast<char*>(&header), sizeof header) != sizeof header ||
        std::memcmp(header.signature, "POINTCACHE2", 12) != 0 || header.points < 0 || header.samples < 1)
        throw unreadable(file.name(), "it is no point cache (PC2) with a sample");
    if (static_cast<std::uint64_t>(header.points) != grid.count())
        throw of_another_shape(file.name(), grid, fmt::format("{} points", grid.count()),
                               fmt::format("{}", header.points));
    const std::uint64_t bytes = 12 * grid.count();
    file.skip(bytes * static_cast<std::uint64_t>(header.samples - 1));
    std::vector<std::array<float, 3>> sample(grid.count());
    if (file.read(reinterpret_cast<char*>(sample.data()), bytes) != bytes)
        throw unreadable(file.name(), "it ends too early");
    Positions positions;
    positions.reserve(sample.size());
    for (const auto& [x, y, z] : sample) positions.push_back({x, y, z});
    return positions;
}

}  // namespace

Positions read_positions(const std::filesystem::path& path, std::uint32_t columns, std::uint32_t rows) {
    const GridSize grid{columns, rows};
    const std::string extension = extension_of(path);
    if (extension == ".npy" || extension == ".npz") return array_positions(path, grid, "positions");
    if (extension == ".obj") return mesh_vertices(path, grid);
    if (extension == ".pc2") return cached_points(path, grid);
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
