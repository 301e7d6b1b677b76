#include "world/overlap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "world/start.h"
#include "world/surface_distance.h"

namespace drape {

namespace {

constexpr double least_depth = 1e-3;  ///< edge lengths; smaller depths are rounding
constexpr std::size_t most_particles = std::size_t{1} << 18;

/// Returns by particle whether it is the corner of an existing cell.
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

/// Returns where the particles start, in m; of a large cloth, a sample of them.
std::vector<Vec3> places(const Cloth& cloth) {
    const std::vector<bool> used = in_a_cell(cloth);
    const std::vector<Vec3> all = start_positions(cloth);
    std::vector<Vec3> chosen;
    const std::size_t stride = all.size() / most_particles + 1;
    for (std::size_t particle = 0; particle < all.size(); particle += stride)
        if (used[particle]) chosen.push_back(all[particle]);
    return chosen;
}

/// Returns the depth (m) from which particles count.
double counting_depth(const Cloth& cloth) { return least_depth * least_spacing(cloth); }

/// Returns the half extents of a shape that cloth leaves through one of six faces (way_out_surface in
/// shaders/include/colliders.h); nothing: cloth leaves it at the nearest surface.
std::optional<Vec3> faces_of(const ColliderShape& shape) {
    using Faces = std::optional<Vec3>;
    return std::visit(
        ForEachKind{[](const Plane&) { return Faces(); }, [](const Sphere&) { return Faces(); },
                    [](const Box& box) { return Faces(box.half_extents); }, [](const Ellipsoid&) { return Faces(); },
                    [](const Capsule&) { return Faces(); }, [](const Mesh&) { return Faces(); }},
        shape);
}

/// `inside` are the places of particles in the box, `normal` is the cloth's normal; both in the box's frame.
WayOut way_out(const std::vector<Vec3>& inside, const Vec3& normal, const Vec3& half_extents, double speed) {
    WayOut best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 3 && !inside.empty(); ++axis)
        for (const double side : {1.0, -1.0}) {
            double farthest = 0;
            for (const Vec3& at : inside) farthest = std::max(farthest, half_extents[axis] - side * at[axis]);
            const double along_cloth = std::sqrt(std::max(0.0, dot(normal, normal) - normal[axis] * normal[axis]));
            if (const double cost = farthest * (1 + 2 * along_cloth); cost < least) {
                least = cost;
                best = {{}, 2 * farthest / speed};
                best.normal[axis] = side;
            }
        }
    return best;
}

StartOverlap overlap(const std::vector<Vec3>& places, const Collider& given, double least) {
    const Collider collider = formed(given, 0);
    const ColliderPose pose = collider_pose(collider, 0);
    const double reach = shape_geometry(collider.shape).reach;
    StartOverlap found;
    for (const Vec3& at : places) {
        if (length(minus(at, pose.center)) > reach) continue;  // spares the costly distance
        const double distance = exact::surface_distance(collider, pose, at);
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
        const std::vector<Vec3> at = places(cloth);
        StartOverlap deepest;
        std::size_t count = 0;
        for (std::size_t collider = 0; collider < scene.colliders.size(); ++collider) {
            StartOverlap one = overlap(at, scene.colliders[collider], counting_depth(cloth));
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

std::vector<WayOut> ways_out(const Cloth& cloth, const std::vector<Collider>& colliders, double speed) {
    std::vector<WayOut> ways(colliders.size());
    std::vector<Vec3> at;
    for (std::size_t k = 0; k < colliders.size(); ++k) {
        const std::optional<Vec3> faces = faces_of(colliders[k].shape);
        if (!faces) continue;
        if (at.empty()) at = places(cloth);
        const ColliderPose pose = collider_pose(colliders[k], 0);
        std::vector<Vec3> inside;
        for (const Vec3& world : at)
            if (exact::surface_distance(colliders[k], pose, world) < -counting_depth(cloth))
                inside.push_back(exact::to_local(pose, world));
        ways[k] = way_out(inside, exact::to_local({pose.rotation, {}}, start_normal(cloth)), *faces, speed);
    }
    return ways;
}

std::string collider_place(const SceneDescription& scene, std::size_t index) {
    const std::size_t kind = scene.colliders[index].shape.index();
    const auto before = scene.colliders.begin() + static_cast<std::ptrdiff_t>(index);
    const auto place = std::count_if(scene.colliders.begin(), before,
                                     [&](const Collider& other) { return other.shape.index() == kind; });
    return fmt::format("/colliders/{}/{}", collider_lists[kind], place);
}

std::string overlap_text(const SceneDescription& scene, const StartOverlap& overlap) {
    const std::string others = overlap.others == 0 ? ""
                                                   : fmt::format(", and inside {} other collider{}", overlap.others,
                                                                 overlap.others == 1 ? "" : "s");
    return fmt::format("cloth \"{}\" starts up to {:.3g} m inside {} ({} particle{}){}",
                       scene.cloths[overlap.cloth].name, overlap.depth, collider_place(scene, overlap.collider),
                       overlap.particles, overlap.particles == 1 ? "" : "s", others);
}

}  // namespace drape
