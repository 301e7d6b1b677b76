#include "scene/overlap.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/start.h"
#include "scene/surface_distance.h"

namespace drape {

namespace {

constexpr double least_depth = 1e-3;  ///< of an edge: less is rounding
constexpr std::size_t most_particles = std::size_t{1} << 18;

/// By particle: whether it is a corner of a cell that no hole takes away.
std::vector<bool> in_a_cell(const Cloth& cloth) {
    const std::size_t columns = cloth.grid[0], rows = cloth.grid[1];
    const std::vector<bool> missing = missing_cells(cloth);
    std::vector<bool> used(columns * rows);
    for (std::size_t row = 0; row + 1 < rows; ++row)
        for (std::size_t column = 0; column + 1 < columns; ++column)
            if (!missing[row * (columns - 1) + column])
                for (const std::size_t corner : {row * columns + column, (row + 1) * columns + column})
                    used[corner] = used[corner + 1] = true;
    return used;
}

/// m; those of a large cloth thinned out.
std::vector<Vec3> places(const Cloth& cloth) {
    const std::vector<bool> used = in_a_cell(cloth);
    const std::vector<Vec3> all = start_positions(cloth);
    std::vector<Vec3> chosen;
    const std::size_t stride = all.size() / most_particles + 1;
    for (std::size_t particle = 0; particle < all.size(); particle += stride)
        if (used[particle]) chosen.push_back(all[particle]);
    return chosen;
}

StartOverlap overlap(const std::vector<Vec3>& places, const Collider& collider, double least) {
    const ColliderPose pose = collider_pose(collider, 0);
    const double reach = shape_geometry(collider.shape).reach;
    StartOverlap found;
    for (const Vec3& at : places) {
        if (exact::norm(exact::minus(at, pose.center)) > reach) continue;  // told without the costly distance
        const Vec3 local = exact::to_local(pose, at);
        const double distance =
            std::visit([&](const auto& shape) { return exact::shape_distance(shape, local); }, collider.shape);
        if (!(-distance > least)) continue;
        ++found.particles;
        found.depth = std::max(found.depth, -distance);
    }
    return found;
}

}  // namespace

std::vector<StartOverlap> start_overlaps(const SceneDescription& scene) {
    std::vector<StartOverlap> all;
    if (scene.colliders.empty()) return all;
    for (std::size_t index = 0; index < scene.cloths.size(); ++index) {
        const Cloth& cloth = scene.cloths[index];
        const double edge = std::min(cloth.size[0] / (cloth.grid[0] - 1), cloth.size[1] / (cloth.grid[1] - 1));
        const std::vector<Vec3> at = places(cloth);
        StartOverlap deepest;
        std::size_t count = 0;
        for (std::size_t collider = 0; collider < scene.colliders.size(); ++collider) {
            StartOverlap one = overlap(at, scene.colliders[collider], least_depth * edge);
            if (one.particles == 0) continue;
            ++count;
            one.cloth = index;
            one.collider = collider;
            if (one.depth > deepest.depth) deepest = one;
        }
        deepest.others = count - 1;
        if (count > 0) all.push_back(deepest);
    }
    return all;
}

std::string overlap_text(const SceneDescription& scene, const StartOverlap& overlap) {
    const std::size_t kind = scene.colliders[overlap.collider].shape.index();
    const auto before = scene.colliders.begin() + static_cast<std::ptrdiff_t>(overlap.collider);
    const auto place = std::count_if(scene.colliders.begin(), before,
                                     [&](const Collider& other) { return other.shape.index() == kind; });
    const std::string others = overlap.others == 0 ? ""
                                                   : fmt::format(", and inside {} other collider{}", overlap.others,
                                                                 overlap.others == 1 ? "" : "s");
    return fmt::format("cloth \"{}\" starts up to {:.3g} m inside /colliders/{}/{} ({} particle{}){}",
                       scene.cloths[overlap.cloth].name, overlap.depth, collider_lists[kind], place, overlap.particles,
                       overlap.particles == 1 ? "" : "s", others);
}

}  // namespace drape
