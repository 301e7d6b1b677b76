#include <algorithm>
#include <cmath>

#include "scene/scene_sections.h"

namespace drape {
namespace {

constexpr std::size_t cutter_limit = 1024;

/// Twice the area over the square of the longest edge: 0 for points on a line, 0.87 for equal edges.
double shape_quality(const std::array<Vec3, 3>& t) {
    const auto edge = [&](std::size_t a, std::size_t b) {
        return Vec3{t[b][0] - t[a][0], t[b][1] - t[a][1], t[b][2] - t[a][2]};
    };
    const auto squared = [](const Vec3& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; };
    const Vec3 u = edge(0, 1), v = edge(0, 2);
    const Vec3 normal{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double longest = std::max({squared(u), squared(v), squared(edge(1, 2))});
    return longest > 0 ? std::sqrt(squared(normal)) / longest : 0;
}

void read_triangle(const SceneNode& node, std::array<Vec3, 3>& triangle) {
    if (!node) {
        node.fail("expected \"triangle\": three points");
        return;
    }
    if (!node.open_array("an array of 3 points", 3, 3)) return;
    bool good = true;
    for (std::size_t corner = 0; corner < 3; ++corner) good = node.element(corner).read(triangle[corner]) && good;
    // Single precision keeps seven digits: a flatter triangle has no plane there.
    if (good && shape_quality(triangle) < 1e-5) node.fail("expected a triangle with an area, got a degenerate one");
}

void read_active(const SceneNode& node, Cutter& cutter) {
    if (!node) {
        node.fail("expected \"active\": [begin, end] in seconds");
        return;
    }
    std::array<double, 2> times{};
    if (!node.read(std::span<double>(times), "an array of 2 numbers", not_negative)) return;
    if (times[1] < times[0]) node.fail("expected an end that is not before the beginning");
    cutter.begin = times[0];
    cutter.end = times[1];
}

}  // namespace

void read_cutters(SceneNode node, std::vector<Cutter>& cutters) {
    if (!node.open_array("an array of at most 1024 cutters", 0, cutter_limit)) return;
    cutters.assign(node.value()->size(), {});
    for (std::size_t i = 0; i < cutters.size(); ++i) {
        SceneNode element = node.element(i);
        if (!element.open_object(ObjectKind::cutter)) continue;
        read_triangle(element.member("triangle"), cutters[i].triangle);
        read_active(element.member("active"), cutters[i]);
        read_path(element.member("path"), cutters[i].path);
    }
}

}  // namespace drape
