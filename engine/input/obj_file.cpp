#include "input/obj_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <string_view>

#include "input/text_lines.h"

namespace drape::input {

namespace {

struct Statement {
    std::string_view keyword, rest;
    std::uint64_t line;
};

/// Calls `see` with every statement: lines without their comments, joined where one ends in a backslash.
void each_statement(FileSource& file, const std::function<void(const Statement&)>& see) {
    constexpr std::size_t most_bytes = std::size_t{16} << 20;
    Lines lines(file);
    std::string joined;
    for (std::string_view line; lines.next(line);) {
        line = line.substr(0, line.find('#'));
        const bool goes_on = line.ends_with('\\');
        if (goes_on || !joined.empty()) {
            joined.append(line.substr(0, line.size() - (goes_on ? 1 : 0))) += ' ';
            if (joined.size() > most_bytes)
                throw unreadable(file.name(), fmt::format("line {} goes on for too long", lines.number()));
            if (goes_on) continue;
            line = joined;
        }
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
        see({line.substr(0, end), line.substr(end), lines.number()});
        joined.clear();
    }
}

void add_vertex(FileSource& file, const Statement& statement, std::vector<std::array<double, 3>>& vertices) {
    if (!read_vertex(statement.rest, vertices.emplace_back()))
        throw unreadable(file.name(), fmt::format("line {} is no vertex of three numbers", statement.line));
    if (vertices.size() > mesh_vertex_limit)
        throw unreadable(file.name(), fmt::format("line {} is a vertex more than the {} that are taken", statement.line,
                                                  mesh_vertex_limit));
}

/// Reads the corners of a face, "7", "7/1", "7//2" or "7/1/2" each; a negative one counts back from the last vertex.
bool read_face(std::string_view line, std::size_t vertices, std::vector<std::uint32_t>& corners) {
    corners.clear();
    for (;;) {
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        if (line.empty()) return true;
        std::int64_t number = 0;
        const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
        if (error != std::errc{} || number == 0) return false;
        line.remove_prefix(static_cast<std::size_t>(end - line.data()));
        if (!line.empty() && std::string_view("/ \t").find(line.front()) == std::string_view::npos) return false;
        const std::int64_t corner = number < 0 ? static_cast<std::int64_t>(vertices) + number : number - 1;
        if (corner < 0 || corner >= static_cast<std::int64_t>(mesh_vertex_limit)) return false;
        corners.push_back(static_cast<std::uint32_t>(corner));
        line.remove_prefix(std::min(line.find_first_of(" \t"), line.size()));
    }
}

OutputError no_face(FileSource& file, std::uint64_t line) {
    return unreadable(file.name(), fmt::format("line {} is no face of vertices that are there", line));
}

}  // namespace

MeshData read_obj(const std::filesystem::path& path) {
    FileSource file(path);
    MeshData mesh;
    std::vector<std::uint32_t> corners;
    // A face may come before its vertices.
    struct {
        std::uint32_t corner = 0;
        std::uint64_t line = 0;
    } farthest;
    each_statement(file, [&](const Statement& statement) {
        if (statement.keyword == "v") add_vertex(file, statement, mesh.vertices);
        if (statement.keyword != "f") return;
        if (!read_face(statement.rest, mesh.vertices.size(), corners)) throw no_face(file, statement.line);
        for (const std::uint32_t corner : corners)
            if (farthest.line == 0 || corner > farthest.corner) farthest = {corner, statement.line};
        add_face(mesh, corners);
        expect_limits(mesh, file.name());
    });
    if (farthest.line > 0 && farthest.corner >= mesh.vertices.size()) throw no_face(file, farthest.line);
    return mesh;
}

std::vector<std::array<double, 3>> read_obj_vertices(const std::filesystem::path& path) {
    FileSource file(path);
    std::vector<std::array<double, 3>> vertices;
    each_statement(file, [&](const Statement& statement) {
        if (statement.keyword == "v") add_vertex(file, statement, vertices);
    });
    return vertices;
}

}  // namespace drape::input
