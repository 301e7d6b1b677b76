#include "output/written_collider.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace drape {

namespace {

constexpr std::string_view stem = "colliders";

/// Splits every triangle into four, by its corners and the middles of its edges.
void split_triangles(WrittenCollider& collider) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [found, is_new] =
            middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(collider.vertices.size()));
        if (is_new) {
            Vec3 between;
            for (std::size_t k = 0; k < 3; ++k) between[k] = 0.5 * (collider.vertices[a][k] + collider.vertices[b][k]);
            collider.vertices.push_back(between);
        }
        return found->second;
    };
    std::vector<std::uint32_t> faces;
    for (std::size_t i = 0; i + 2 < collider.faces.size(); i += 3) {
        const std::uint32_t a = collider.faces[i], b = collider.faces[i + 1], c = collider.faces[i + 2];
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const std::uint32_t corner : {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca}) faces.push_back(corner);
    }
    collider.faces = std::move(faces);
}

}  // namespace

std::vector<Vec3> formed_vertices(const WrittenCollider& collider, double time) {
    return collider.form ? collider.form(time) : collider.vertices;
}

std::vector<float> placed_vertices(const WrittenCollider& collider, double time) {
    const Placement3x4 placement = collider.placement(time);
    std::vector<float> xyz;
    for (const Vec3& vertex : formed_vertices(collider, time))
        for (const auto& row : placement)
            xyz.push_back(static_cast<float>(row[3] + row[0] * vertex[0] + row[1] * vertex[1] + row[2] * vertex[2]));
    return xyz;
}

WrittenCollider with_nodes(WrittenCollider collider) {
    for (int level = 0; collider.flat && level < 3; ++level) split_triangles(collider);
    return collider;
}

std::string still_colliders_name(std::string_view extension) { return fmt::format("{}.{}", stem, extension); }

std::string moving_colliders_name(std::uint64_t frame, int digits, std::string_view extension) {
    return fmt::format("{}_{:0{}}.{}", stem, frame, digits, extension);
}

bool is_colliders_name(std::string_view name, std::string_view extension) {
    const std::string end = fmt::format(".{}", extension);
    if (!name.starts_with(stem) || !name.ends_with(end) || name.size() < stem.size() + end.size()) return false;
    const std::string_view number = name.substr(stem.size(), name.size() - stem.size() - end.size());
    return number.empty() || (number.size() >= 5 && number[0] == '_' &&
                              std::ranges::all_of(number.substr(1), [](char c) { return c >= '0' && c <= '9'; }));
}

}  // namespace drape
