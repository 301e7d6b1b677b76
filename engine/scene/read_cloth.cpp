#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "scene/scene_sections.h"

namespace drape {
namespace {

constexpr std::uint32_t axis_limit = 16384;
constexpr std::size_t cloth_limit = 1024;

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

std::array<Vec3, 4> corners(const Cloth& cloth) {
    std::array<Vec3, 4> points;
    for (std::size_t corner = 0; corner < 4; ++corner)
        for (std::size_t i = 0; i < 3; ++i)
            points[corner][i] = cloth.placement.origin[i] +
                                (corner % 2 == 1 ? cloth.placement.u[i] * cloth.size[0] : 0.0) +
                                (corner / 2 == 1 ? cloth.placement.v[i] * cloth.size[1] : 0.0);
    return points;
}

bool read_name(const SceneNode& node, std::size_t index, std::string& name) {
    name = index == 0 ? "cloth" : fmt::format("cloth{}", index + 1);
    if (!node.read(name)) return false;
    const bool is_plain = std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
    if (is_plain && !name.empty() && name.size() <= 64) return true;
    return node.fail_expected("a name of 1 to 64 letters, digits, _ and - (it becomes a file name)");
}

bool read_grid(const SceneNode& node, std::array<std::uint32_t, 2>& grid) {
    if (!node) return true;
    if (!node.open_array("an array of 2 integers", 2, 2)) return false;
    const bool has_columns = node.element(0).read(grid[0], 2, axis_limit);
    return node.element(1).read(grid[1], 2, axis_limit) && has_columns;
}

bool read_placement(SceneNode node, Placement& placement) {
    if (!node.open_object(ObjectKind::placement)) return !node;
    bool fits = node.member("origin").read(placement.origin);
    fits = node.member("u").read_direction(placement.u) && fits;
    fits = node.member("v").read_direction(placement.v) && fits;
    const double cosine = dot(placement.u, placement.v);
    if (fits && std::abs(cosine) > 1e-6)
        return node.fail(fmt::format("expected u and v at right angles, got a cosine of {:.6g}", cosine));
    return fits;
}

void read_stiffness(SceneNode node, Stiffness& stiffness) {
    if (!node) return;
    if (node.value()->isString() && *node.value() == "rigid") {
        stiffness.rigid = true;
        return;
    }
    if (!node.value()->isObject()) {
        node.fail_expected("\"rigid\" or an object");
        return;
    }
    node.open_object(ObjectKind::stiffness);
    node.member("stretch").read(stiffness.stretch, not_negative);
    node.member("shear").read(stiffness.shear, not_negative);
    node.member("bend").read(stiffness.bend, not_negative);
}

bool read_particle(const SceneNode& node, const std::array<std::uint32_t, 2>& grid,
                   std::array<std::uint32_t, 2>& particle) {
    if (!node.open_array("a particle [column, row]", 2, 2)) return false;
    const bool has_column = node.element(0).read(particle[0], 0, grid[0] - 1);
    return node.element(1).read(particle[1], 0, grid[1] - 1) && has_column;
}

bool read_index_box(const SceneNode& node, const std::array<std::uint32_t, 2>& grid, IndexBox& box) {
    if (!node.open_array("a box [[column, row], [column, row]]", 2, 2)) return false;
    const bool has_first = read_particle(node.element(0), grid, box.first);
    const bool has_last = read_particle(node.element(1), grid, box.last);
    if (!has_first || !has_last) return false;
    if (box.first[0] <= box.last[0] && box.first[1] <= box.last[1]) return true;
    return node.fail_expected("the first particle of a box not beyond its last");
}

void read_edge(const SceneNode& node, const std::array<std::uint32_t, 2>& grid, IndexBox& box) {
    const std::uint32_t right = grid[0] - 1;
    const std::uint32_t bottom = grid[1] - 1;
    const std::pair<std::string_view, IndexBox> edges[] = {{"left", {{0, 0}, {0, bottom}}},
                                                           {"right", {{right, 0}, {right, bottom}}},
                                                           {"top", {{0, 0}, {right, 0}}},
                                                           {"bottom", {{0, bottom}, {right, bottom}}}};
    node.read_choice<IndexBox>(box, edges);
}

void read_corner(const SceneNode& node, const std::array<std::uint32_t, 2>& grid, IndexBox& box) {
    const std::uint32_t right = grid[0] - 1;
    const std::uint32_t bottom = grid[1] - 1;
    const std::pair<std::string_view, IndexBox> places[] = {{"top_left", {{0, 0}, {0, 0}}},
                                                            {"top_right", {{right, 0}, {right, 0}}},
                                                            {"bottom_left", {{0, bottom}, {0, bottom}}},
                                                            {"bottom_right", {{right, bottom}, {right, bottom}}}};
    node.read_choice<IndexBox>(box, places);
}

void read_pin(SceneNode node, const std::array<std::uint32_t, 2>& grid, Pin& pin) {
    if (!node.open_object(ObjectKind::pin)) return;
    const SceneNode edge = node.member("edge");
    const SceneNode corner = node.member("corner");
    const SceneNode at = node.member("at");
    const SceneNode box = node.member("box");
    const int selector_count = bool(edge) + bool(corner) + bool(at) + bool(box);
    if (selector_count != 1)
        node.fail(fmt::format("expected exactly one of edge, corner, at and box, got {} of them", selector_count));
    read_edge(edge, grid, pin.particles);
    read_corner(corner, grid, pin.particles);
    if (at && read_particle(at, grid, pin.particles.first)) pin.particles.last = pin.particles.first;
    if (box) read_index_box(box, grid, pin.particles);
    const SceneNode release = node.member("release");
    if (double time = 0.0; release && release.read(time, not_negative)) pin.release = time;
    const SceneNode pivot = node.member("pivot");
    if (Vec3 point{0, 0, 0}; pivot && pivot.read(point)) pin.pivot = point;
    read_path(node.member("path"), pin.path);
}

void read_appearance(SceneNode node, Appearance& appearance) {
    if (!node.open_object(ObjectKind::appearance)) return;
    node.member("front").read_color(appearance.front);
    node.member("back").read_color(appearance.back);
    constexpr std::pair<std::string_view, Pattern> patterns[] = {{"plain", Pattern::plain},
                                                                 {"checker", Pattern::checker}};
    node.member("pattern").read_choice<Pattern>(appearance.pattern, patterns);
}

// Single precision must resolve a quarter of an edge where the cloth starts, or the springs see only
// rounding.
void check_resolution(const SceneNode& cloth_node, const Cloth& cloth) {
    double farthest = 0.0;
    for (const Vec3& corner : corners(cloth))
        for (const double x : corner) farthest = std::max(farthest, std::abs(x));
    const double edge = std::min(cloth.size[0] / (cloth.grid[0] - 1), cloth.size[1] / (cloth.grid[1] - 1));
    const auto single = static_cast<float>(farthest);
    const double ulp = static_cast<double>(std::nextafter(single, std::numeric_limits<float>::infinity())) - single;
    if (ulp <= 0.25 * edge) return;
    cloth_node.fail(
        fmt::format("expected a cloth that single precision resolves: at {:.6g} m from the origin it is exact to "
                    "{:.3g} m, more than a quarter of the edge length {:.3g} m",
                    farthest, ulp, edge));
}

void read_particle_boxes(const SceneNode& node, bool has_grid, Cloth& cloth) {
    // Without a valid grid the indices are only held against the largest one, so that a mistake in the grid
    // is not reported once more for every pin.
    const std::array<std::uint32_t, 2> grid = has_grid ? cloth.grid : std::array{axis_limit, axis_limit};
    const SceneNode holes = node.member("holes");
    if (holes.open_array("an array of boxes", 0, 1'000'000)) {
        cloth.holes.assign(holes.value()->size(), {});
        for (std::size_t i = 0; i < cloth.holes.size(); ++i) read_index_box(holes.element(i), grid, cloth.holes[i]);
    }
    const SceneNode pins = node.member("pins");
    if (pins.open_array("an array of pins", 0, 1'000'000)) {
        cloth.pins.assign(pins.value()->size(), {});
        for (std::size_t i = 0; i < cloth.pins.size(); ++i) read_pin(pins.element(i), grid, cloth.pins[i]);
    }
}

void read_cloth(const SceneNode& node, Cloth& cloth) {
    const bool has_grid = read_grid(node.member("grid"), cloth.grid);
    const bool has_size = node.member("size").read(cloth.size, "an array of 2 numbers", positive);
    const bool has_placement = read_placement(node.member("placement"), cloth.placement);
    node.member("areal_density").read(cloth.areal_density, positive);
    read_stiffness(node.member("stiffness"), cloth.stiffness);
    node.member("damping").read(cloth.damping, not_negative);
    node.member("friction").read(cloth.friction, not_negative);
    node.member("thickness").read(cloth.thickness, not_negative);
    node.member("velocity").read(cloth.velocity);
    read_particle_boxes(node, has_grid, cloth);
    read_appearance(node.member("appearance"), cloth.appearance);
    if (has_grid && has_size && has_placement) check_resolution(node, cloth);
}

// Particles a grid asks for, also where an axis is beyond its limit: the message should name the count.
std::uint64_t requested_particle_count(const SceneNode& grid, const Cloth& cloth) {
    std::uint64_t count = 1;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        std::uint32_t requested = cloth.grid[axis];
        if (grid && grid.value()->isArray() && grid.value()->size() == 2) {
            const Json::Value& written = (*grid.value())[static_cast<Json::ArrayIndex>(axis)];
            if (written.isUInt()) requested = written.asUInt();
        }
        count *= requested;  // two factors below 2^32: no overflow
    }
    return count;
}

// Adds to `total`, saturating, and reports the cloth that takes it over the limit.
void count_particles(const SceneNode& grid, const Cloth& cloth, std::uint64_t& total) {
    const std::uint64_t before = total;
    const std::uint64_t count = requested_particle_count(grid, cloth);
    const std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    total = count > most - total ? most : total + count;
    if (before <= scene_particle_limit && total > scene_particle_limit)
        grid.fail(
            fmt::format("expected at most {} particles in all cloths together, got {}", scene_particle_limit, total));
}

bool start_boxes_meet(const Cloth& a, const Cloth& b) {
    const std::array<Vec3, 4> a_corners = corners(a);
    const std::array<Vec3, 4> b_corners = corners(b);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto less = [i](const Vec3& p, const Vec3& q) { return p[i] < q[i]; };
        const auto [a_low, a_high] = std::minmax_element(a_corners.begin(), a_corners.end(), less);
        const auto [b_low, b_high] = std::minmax_element(b_corners.begin(), b_corners.end(), less);
        if ((*a_high)[i] < (*b_low)[i] || (*b_high)[i] < (*a_low)[i]) return false;
    }
    return true;
}

// One warning per cloth, naming the first of the earlier ones it meets.
void warn_of_touching(const SceneNode& node, const std::vector<Cloth>& cloths) {
    for (std::size_t i = 1; i < cloths.size(); ++i) {
        const auto other = std::find_if(cloths.begin(), cloths.begin() + static_cast<std::ptrdiff_t>(i),
                                        [&](const Cloth& earlier) { return start_boxes_meet(earlier, cloths[i]); });
        if (other - cloths.begin() == static_cast<std::ptrdiff_t>(i)) continue;
        node.element(i).warn(
            fmt::format("cloths \"{}\" and \"{}\" are set to touch, but will pass through each other: "
                        "cloth-cloth and self-collision are not simulated",
                        other->name, cloths[i].name));
    }
}

}  // namespace

void read_cloths(SceneNode node, std::vector<Cloth>& cloths) {
    constexpr std::string_view what = "an array of 1 to 1024 cloths";
    if (!node) node.fail_expected(what);
    if (!node.open_array(what, 1, cloth_limit)) return;
    cloths.assign(node.value()->size(), {});
    std::set<std::string_view> names;
    std::uint64_t particle_total = 0;
    for (std::size_t i = 0; i < cloths.size(); ++i) {
        SceneNode element = node.element(i);
        if (!element.open_object(ObjectKind::cloth)) continue;
        const SceneNode name = element.member("name");
        if (read_name(name, i, cloths[i].name) && !names.insert(cloths[i].name).second)
            name.fail(fmt::format("expected a name no other cloth has, got \"{}\"", cloths[i].name));
        read_cloth(element, cloths[i]);
        count_particles(element.member("grid"), cloths[i], particle_total);
    }
    warn_of_touching(node, cloths);
}

}  // namespace drape
