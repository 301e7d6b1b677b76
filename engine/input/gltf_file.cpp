#include "input/gltf_file.h"

#include <fmt/format.h>

#include <cstring>

#include "input/gltf_buffers.h"

namespace drape::input {

namespace {

/// The rows of an affine map: x, y, z and what is added.
using Affine = std::array<std::array<double, 4>, 3>;
constexpr Affine identity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

Affine product(const Affine& a, const Affine& b) {
    Affine c{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
            c[row][column] = column == 3 ? a[row][3] : 0;
            for (std::size_t k = 0; k < 3; ++k) c[row][column] += a[row][k] * b[k][column];
        }
    return c;
}

class Scene {
  public:
    explicit Scene(const GltfFile& file) : file_(file), is_placed_(file.json()["nodes"].size()) {}

    MeshData read() {
        const Json::Value& json = file_.json();
        std::string place;
        const Json::Value first(0u);
        const Json::Value& scene = file_.object("scenes", json["scene"].isNull() ? first : json["scene"], place);
        std::vector<Placed> open;
        push(scene["nodes"], place + "/nodes", identity, open);
        while (!open.empty()) {
            const Placed next = open.back();
            open.pop_back();
            add_node(next, open);
        }
        return std::move(mesh_);
    }

  private:
    struct Placed {
        Json::Value index;
        Affine above;
    };

    void push(const Json::Value& indices, const std::string& place, const Affine& above, std::vector<Placed>& open) {
        if (indices.isNull()) return;
        if (!indices.isArray()) file_.fail(place, "expected a list");
        for (Json::ArrayIndex k = indices.size(); k-- > 0;) open.push_back({indices[k], above});
    }

    void add_node(const Placed& placed, std::vector<Placed>& open) {
        std::string place;
        const Json::Value& node = file_.object("nodes", placed.index, place);
        if (is_placed_[placed.index.asUInt()]) file_.fail(place, "a node has two places in the scene");
        is_placed_[placed.index.asUInt()] = true;
        const Affine here = product(placed.above, map_of(node, place));
        if (!node["mesh"].isNull()) {
            std::string mesh_place;
            const Json::Value& primitives = file_.object("meshes", node["mesh"], mesh_place)["primitives"];
            if (!primitives.isArray()) file_.fail(mesh_place + "/primitives", "expected a list");
            for (Json::ArrayIndex k = 0; k < primitives.size(); ++k)
                add_primitive(primitives[k], fmt::format("{}/primitives/{}", mesh_place, k), here);
        }
        push(node["children"], place + "/children", here, open);
    }

    /// Returns so many numbers of an object, `otherwise` where it has none.
    template <std::size_t count>
    std::array<double, count> numbers(const Json::Value& object, const std::string& place, const char* key,
                                      std::array<double, count> otherwise) const {
        const Json::Value& list = object[key];
        if (list.isNull()) return otherwise;
        const std::string at = fmt::format("{}/{}", place, key);
        if (!list.isArray() || list.size() != count) file_.fail(at, fmt::format("expected {} numbers", count));
        for (Json::ArrayIndex k = 0; k < count; ++k) {
            if (!list[k].isNumeric()) file_.fail(at, fmt::format("expected {} numbers", count));
            otherwise[k] = list[k].asDouble();
        }
        return otherwise;
    }

    Affine map_of(const Json::Value& node, const std::string& place) const {
        Affine map = identity;
        if (!node["matrix"].isNull()) {  // column by column
            const auto m = numbers<16>(node, place, "matrix", {});
            for (std::size_t row = 0; row < 3; ++row)
                for (std::size_t column = 0; column < 4; ++column) map[row][column] = m[4 * column + row];
            return map;
        }
        const auto move = numbers<3>(node, place, "translation", {0, 0, 0});
        const auto [x, y, z, w] = numbers<4>(node, place, "rotation", {0, 0, 0, 1});
        const auto scale = numbers<3>(node, place, "scale", {1, 1, 1});
        map = {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), move[0]},
                {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), move[1]},
                {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), move[2]}}};
        for (auto& row : map)
            for (std::size_t column = 0; column < 3; ++column) row[column] *= scale[column];
        return map;
    }

    void add_primitive(const Json::Value& primitive, const std::string& place, const Affine& map) {
        if (!primitive.isObject()) file_.fail(place, "expected an object");
        constexpr std::uint64_t triangles = 4, strip = 5, fan = 6;
        const std::uint64_t mode = file_.whole(primitive, place, "mode", triangles);
        if (mode < triangles) return;
        if (mode > fan) file_.fail(place + "/mode", "expected 0 to 6");
        const Json::Value& attributes = primitive["attributes"];
        if (!attributes.isObject() || attributes["POSITION"].isNull())
            file_.fail(place, "expected an attribute POSITION");
        const auto before = static_cast<std::uint32_t>(mesh_.vertices.size());
        const std::uint64_t count = add_vertices(attributes["POSITION"], map);
        const std::vector<std::uint32_t> corners = corners_of(primitive["indices"], before, count);
        if (mode == strip) add_strip(mesh_, corners);
        if (mode == fan) add_face(mesh_, corners);
        if (mode == triangles)
            for (std::size_t k = 2; k < corners.size(); k += 3) add_face(mesh_, std::span(corners).subspan(k - 2, 3));
        expect_limits(mesh_, file_.name());
    }

    std::uint64_t add_vertices(const Json::Value& accessor, const Affine& map) {
        const GltfFile::Elements positions = file_.elements(accessor);
        constexpr int float_component = 5126;
        if (positions.component != float_component || positions.type != "VEC3")
            file_.fail(positions.place, "expected positions of three floats");
        if (positions.count > mesh_vertex_limit - mesh_.vertices.size())
            file_.fail(positions.place, fmt::format("expected at most {} vertices", mesh_vertex_limit));
        for (std::uint64_t k = 0; k < positions.count; ++k) {
            float at[3];
            std::memcpy(at, positions.at(k), sizeof at);
            std::array<double, 3>& vertex = mesh_.vertices.emplace_back();
            for (std::size_t row = 0; row < 3; ++row)
                vertex[row] = map[row][0] * at[0] + map[row][1] * at[1] + map[row][2] * at[2] + map[row][3];
        }
        return positions.count;
    }

    std::vector<std::uint32_t> corners_of(const Json::Value& accessor, std::uint32_t before,
                                          std::uint64_t count) const {
        std::vector<std::uint32_t> corners;
        if (accessor.isNull()) {
            for (std::uint32_t k = 0; k < count; ++k) corners.push_back(before + k);
            return corners;
        }
        const GltfFile::Elements indices = file_.elements(accessor);
        constexpr int byte = 5121, half = 5123, word = 5125;
        const bool is_known = indices.component == byte || indices.component == half || indices.component == word;
        if (!is_known || indices.type != "SCALAR") file_.fail(indices.place, "expected unsigned whole numbers");
        for (std::uint64_t k = 0; k < indices.count; ++k) {
            std::uint32_t index = 0;  // little-endian, as glTF is
            std::memcpy(&index, indices.at(k), indices.component == byte ? 1 : indices.component == half ? 2 : 4);
            if (index >= count)
                file_.fail(indices.place, fmt::format("a corner is the vertex {}, there are {}", index, count));
            corners.push_back(before + index);
        }
        return corners;
    }

    const GltfFile& file_;
    std::vector<bool> is_placed_;
    MeshData mesh_;
};

}  // namespace

MeshData read_gltf(const std::filesystem::path& path) {
    const GltfFile file(path);
    return Scene(file).read();
}

}  // namespace drape::input
