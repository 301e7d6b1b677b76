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

/// Adds a texture's vertex of one, two or three numbers, of which the first two count.
void add_texture_vertex(FileSource& file, const Statement& statement, std::vector<std::array<double, 3>>& vertices) {
    // With zeros behind it, what a line lacks is there.
    if (!read_vertex(std::string(statement.rest) + " 0 0", vertices.emplace_back()))
        throw unreadable(file.name(), fmt::format("line {} is no texture vertex", statement.line));
    if (vertices.size() > mesh_vertex_limit)
        throw unreadable(file.name(), fmt::format("line {} is a vertex more than the {} that are taken", statement.line,
                                                  mesh_vertex_limit));
}

/// Takes the number of a vertex off the line's front; a negative one counts back from the last of `count`.
bool take_number(std::string_view& line, std::size_t count, std::uint32_t& vertex) {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (error != std::errc{} || number == 0) return false;
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    const std::int64_t place = number < 0 ? static_cast<std::int64_t>(count) + number : number - 1;
    if (place < 0 || place >= static_cast<std::int64_t>(mesh_vertex_limit)) return false;
    vertex = static_cast<std::uint32_t>(place);
    return true;
}

/// The corners of a face, each a vertex and perhaps one of the texture.
struct Face {
    std::vector<std::uint32_t> vertices, texture;
};

/// Reads a face, whose corners are "7", "7/1", "7//2" or "7/1/2" each. Those of the texture are looked at only where
/// `with_texture`.
bool read_face(std::string_view line, const UvMesh& mesh, bool with_texture, Face& face) {
    face.vertices.clear();
    face.texture.clear();
    for (;;) {
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        if (line.empty()) return true;
        if (!take_number(line, mesh.shape.vertices.size(), face.vertices.emplace_back())) return false;
        if (!line.empty() && std::string_view("/ \t").find(line.front()) == std::string_view::npos) return false;
        if (with_texture) {
            line.remove_prefix(line.starts_with('/') ? 1 : 0);
            if (!take_number(line, mesh.chart.vertices.size(), face.texture.emplace_back())) return false;
        }
        line.remove_prefix(std::min(line.find_first_of(" \t"), line.size()));
    }
}

OutputError no_face(FileSource& file, std::uint64_t line, bool of_texture) {
    return unreadable(file.name(), fmt::format("line {} is no face of vertices{} that are there", line,
                                               of_texture ? " and texture vertices" : ""));
}

}  // namespace

namespace {

UvMesh read_obj_faces(const std::filesystem::path& path, bool with_texture) {
    FileSource file(path);
    UvMesh mesh;
    Face face;
    // A face may come before its vertices.
    struct Farthest {
        std::uint32_t corner = 0;
        std::uint64_t line = 0;
        void see(const std::vector<std::uint32_t>& corners, std::uint64_t where) {
            for (const std::uint32_t each : corners)
                if (line == 0 || each > corner) *this = {each, where};
        }
    } shape, chart;
    each_statement(file, [&](const Statement& statement) {
        if (statement.keyword == "v") add_vertex(file, statement, mesh.shape.vertices);
        if (statement.keyword == "vt" && with_texture) add_texture_vertex(file, statement, mesh.chart.vertices);
        if (statement.keyword != "f") return;
        if (!read_face(statement.rest, mesh, with_texture, face)) throw no_face(file, statement.line, with_texture);
        shape.see(face.vertices, statement.line);
        chart.see(face.texture, statement.line);
        add_face(mesh.shape, face.vertices);
        add_face(mesh.chart, face.texture);
        expect_limits(mesh.shape, file.name());
    });
    if (shape.line > 0 && shape.corner >= mesh.shape.vertices.size()) throw no_face(file, shape.line, false);
    if (chart.line > 0 && chart.corner >= mesh.chart.vertices.size()) throw no_face(file, chart.line, true);
    return mesh;
}

}  // namespace

MeshData read_obj(const std::filesystem::path& path) { return read_obj_faces(path, false).shape; }

UvMesh read_obj_with_uv(const std::filesystem::path& path) { return read_obj_faces(path, true); }

std::vector<std::array<double, 3>> read_obj_vertices(const std::filesystem::path& path) {
    FileSource file(path);
    std::vector<std::array<double, 3>> vertices;
    each_statement(file, [&](const Statement& statement) {
        if (statement.keyword == "v") add_vertex(file, statement, vertices);
    });
    return vertices;
}

}  // namespace drape::input
