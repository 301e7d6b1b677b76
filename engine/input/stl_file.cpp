#include "input/stl_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>

#include "input/file_source.h"
#include "input/text_lines.h"

namespace drape::input {

namespace {

constexpr std::size_t head_bytes = 84;      ///< 80 of any text, and the number of triangles
constexpr std::size_t triangle_bytes = 50;  ///< a normal, three corners, two bytes

/// Adds a triangle whose corners are the last three vertices.
void add_triangle(MeshData& mesh) {
    const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.triangles.push_back({count - 3, count - 2, count - 1});
}

MeshData read_binary(FileSource& file, std::uint32_t count) {
    if (count > mesh_triangle_limit)
        throw unreadable(file.name(),
                         fmt::format("expected at most {} triangles, byte 80 says {}", mesh_triangle_limit, count));
    if (file.size() < head_bytes + triangle_bytes * std::uint64_t{count})
        throw unreadable(file.name(), fmt::format("{} triangles, as byte 80 says, need {} bytes, it has {}", count,
                                                  head_bytes + triangle_bytes * std::uint64_t{count}, file.size()));
    MeshData mesh;
    const std::vector<std::uint8_t> bytes = file.rest();
    for (std::size_t k = 0; k < count; ++k) {
        float corners[3][3];
        std::memcpy(corners, &bytes.at(triangle_bytes * k + 12), sizeof corners);
        for (const auto& [x, y, z] : corners) mesh.vertices.push_back({x, y, z});
        add_triangle(mesh);
    }
    return mesh;
}

std::string lower_word(std::string_view& line) {
    constexpr std::string_view blanks = " \t";
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    std::string word(line.substr(0, std::min(line.find_first_of(blanks), line.size())));
    line.remove_prefix(word.size());
    std::ranges::transform(word, word.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return word;
}

MeshData read_ascii(const std::filesystem::path& path) {
    FileSource file(path);
    Lines lines(file);
    MeshData mesh;
    std::size_t corners = 0;
    const auto expect = [&](bool holds, const char* what) {
        if (!holds) throw unreadable(file.name(), fmt::format("line {}: {}", lines.number(), what));
    };
    for (std::string_view line; lines.next(line);) {
        const std::string word = lower_word(line);
        if (word == "vertex") {
            expect(read_vertex(line, mesh.vertices.emplace_back()), "expected three numbers");
            expect(++corners <= 3, "a loop has more than three vertices");
        } else if (word == "endloop") {
            expect(corners == 3, "a loop has fewer than three vertices");
            add_triangle(mesh);
            expect_limits(mesh, file.name());
        } else if (word == "outer" || word == "endfacet") {
            expect(corners == 0 || corners == 3, "a loop has no end");
            corners = 0;
        }
    }
    expect(corners == 0 || corners == 3, "the file ends within a loop");
    return mesh;
}

}  // namespace

MeshData read_stl(const std::filesystem::path& path) {
    FileSource file(path);
    char head[head_bytes] = {};
    const std::size_t got = file.read(head, head_bytes);
    std::uint32_t count = 0;
    std::memcpy(&count, head + 80, sizeof count);
    const bool is_binary = got == head_bytes && file.size() == head_bytes + triangle_bytes * std::uint64_t{count};
    std::string_view line(head, got);
    if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r\n"), line.size()));
    if (!is_binary && lower_word(line).starts_with("solid")) return read_ascii(path);
    if (got < head_bytes) throw unreadable(file.name(), "it neither begins with \"solid\" nor has 84 bytes");
    return read_binary(file, count);
}

}  // namespace drape::input
