#include "cloth/self_contact.h"

#include <algorithm>
#include <cmath>

#include "cloth/cloth_model.h"

namespace drape {

namespace {

/// m, by how much more than it needs to the search for cells looks. Cells of flat cloth that are no neighbours are a
/// spacing apart, and shall not be found.
double search_margin(double spacing, double thickness) { return std::max(0.2 * spacing, 0.8 * (spacing - thickness)); }

int top_level(glsl::ivec2 grid) {
    int level = 0;
    while (self_tree_boxes_of(grid, level) > 1) ++level;
    return level;
}

}  // namespace

glsl::SelfContactPush self_contact_constants(const SceneDescription& scene, const Cloth& cloth,
                                             const ClothGeometry& geometry, double extent) {
    const double spacing = std::min(geometry.spacing[0], geometry.spacing[1]);
    const SelfCollision& asked = *cloth.self_collision;
    const double thickness = asked.thickness.value_or(
        std::clamp(cloth.thickness, least_self_thickness * spacing, most_self_thickness * spacing));
    const double substep = 1.0 / (scene.time.fps * scene.solver.substeps);
    const glsl::ivec2 grid = geometry.grid.size();
    const auto count = grid.x * grid.y;
    glsl::SelfContactPush push{};
    push.grid = grid;
    push.spacing = {static_cast<float>(geometry.spacing[0]), static_cast<float>(geometry.spacing[1])};
    push.thickness = static_cast<float>(thickness);
    push.friction = static_cast<float>(asked.friction.value_or(cloth.friction));
    push.recovery = static_cast<float>(recovery_speed * substep);
    push.least = static_cast<float>(2e-6 * extent);  // a few roundings of the coordinates
    // A corner and the diagonal beside it.
    push.least_flat = static_cast<float>(geometry.spacing[0] * geometry.spacing[1] /
                                         std::hypot(geometry.spacing[0], geometry.spacing[1]));
    push.margin = static_cast<float>(search_margin(spacing, thickness));
    push.pair_room = count * static_cast<int>(self_pairs_per_particle);
    push.cell_room = count * static_cast<int>(self_cells_per_particle);
    push.top = top_level(grid);
    // What they are pressed against must not seem to move.
    push.held = std::ranges::any_of(cloth.pins, [](const Pin& pin) { return !pin.release; }) ? 1 : 0;
    return push;
}

double self_list_use(const glsl::SelfContactPush& push, const glsl::SelfRecord& record) {
    return std::max(static_cast<double>(record.most_pairs) / push.pair_room,
                    static_cast<double>(record.most_cells) / push.cell_room);
}

std::uint32_t self_tree_boxes_of(glsl::ivec2 grid, int level) {
    const auto nodes = [level](int particles) { return static_cast<std::uint32_t>(((particles - 1) >> level) + 1); };
    return nodes(grid.x) * nodes(grid.y);
}

int last_level(const glsl::SelfContactPush& push, int level) {
    const bool tail = level > 0 && self_tree_boxes_of(push.grid, level) <= glsl::self_tree_tail;
    return tail ? push.top : level;
}

std::uint64_t self_tree_boxes(glsl::ivec2 grid) {
    std::uint64_t count = 0;
    for (int level = 0; level <= top_level(grid); ++level) count += self_tree_boxes_of(grid, level);
    return count;
}

}  // namespace drape
