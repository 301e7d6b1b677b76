#include "cloth/passage_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cloth/frame_inputs.h"
#include "scene/vectors.h"

namespace drape {

namespace {

double least_half_width(const ColliderShape& shape) {
    const Vec3 size = shape_geometry(shape).size;
    if (std::holds_alternative<Sphere>(shape)) return size[0];
    if (std::holds_alternative<Capsule>(shape)) return std::min(size[1], size[2]);
    return *std::ranges::min_element(size);
}

/// Returns the least length of a vector that goes straight from one to another.
double least_length(const Vec3& from, const Vec3& to) {
    const Vec3 way = minus(to, from);
    const double squared = dot(way, way);
    const double share = squared > 0 ? std::clamp(-dot(from, way) / squared, 0.0, 1.0) : 0;
    return length(plus(from, times(share, way)));
}

/// Returns the largest strains of the springs at the begin and end of a frame, at least 0: of stretch, of shear.
std::array<double, 2> largest_strains(const ClothStatistics& before, const ClothStatistics& now) {
    return {std::max({0.0, before.stretch.largest, now.stretch.largest}),
            std::max({0.0, before.shear.largest, now.shear.largest})};
}

/// Returns the radius of the least circle that holds a triangle of the cloth with its springs that far stretched, m. A
/// ball whose centre passes through a triangle comes that near to a corner.
double widest_hole(const Cloth& cloth, const std::array<double, 2>& strains) {
    std::array<double, 2> sides{};
    for (std::size_t axis = 0; axis < 2; ++axis)
        sides[axis] = cloth.size[axis] / (cloth.grid[axis] - 1) * std::max(1.0, cloth.placement.scale[axis]);
    const double diagonal = std::hypot(sides[0], sides[1]) * (1 + strains[1]);
    std::array<double, 3> edges{sides[0] * (1 + strains[0]), sides[1] * (1 + strains[0]), diagonal};
    std::ranges::sort(edges);
    const auto [a, b, longest] = edges;
    if (longest * longest >= a * a + b * b) return longest / 2;
    const double cosine = (a * a + b * b - longest * longest) / (2 * a * b);
    return longest / (2 * std::sqrt(1 - cosine * cosine));
}

/// Returns the radius of a ball about the centre of mass that holds the cloth: no particle of a sheet is, along it,
/// farther than 0.6 diagonals from the others on average.
double radius_of(const Cloth& cloth, double strain) {
    const double scale = std::max({1.0, cloth.placement.scale[0], cloth.placement.scale[1]});
    return 0.6 * std::hypot(cloth.size[0], cloth.size[1]) * scale * (1 + strain);
}

/// Returns what none of a collider's surface moves farther than in a substep of the frame that ends at `end`, m.
double motion_of(const Collider& collider, double end, double h, std::uint32_t substeps) {
    double most = 0;
    for (const std::uint32_t substep : {0u, substeps / 2, substeps - 1}) {
        const double start = end - (substeps - substep) * h;
        most = std::max(most, double(collider_record(collider, start, start + h).way_out.w));
    }
    return most;
}

}  // namespace

PassageWatch::PassageWatch(const SimulationModel& model) : model_(model) {}

std::optional<PassageWatch::Passage> PassageWatch::passage(std::uint32_t frame, std::uint32_t substeps,
                                                           std::size_t index, const ClothStatistics& before,
                                                           const ClothStatistics& now) const {
    const Cloth& cloth = model_.scene.cloths[index];
    const std::vector<KeptCollider>& kept = model_.kept_colliders[model_.cloths[index].collider_list];
    const double fps = model_.scene.time.fps, end = frame / fps, start = last_frame_ / fps, h = 1 / (fps * substeps);
    const std::array<double, 2> strains = largest_strains(before, now);
    const double strain = std::max(strains[0], strains[1]), hole = widest_hole(cloth, strains);
    const double own = std::max(before.largest_speed, now.largest_speed) * h;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        const Collider& collider = kept[k].collider;
        if (collider.kind() == glsl::kind_plane) continue;
        const double motion = motion_of(collider, end, h, substeps);
        const double middle = least_half_width(collider.shape) + cloth.thickness;
        // A collider that turns by more than a fifth of a radian goes along an arc, which is no straight way.
        const bool turns = motion > 1e14 && collider.kind() != glsl::kind_sphere;
        const bool by_way = collider.kind() == glsl::kind_box || turns;
        const double way = by_way ? 1.25 * (own + motion) : hole;
        if (!(way > middle)) continue;
        const double apart = least_length(minus(collider_pose(collider, start).center, before.center_of_mass),
                                          minus(collider_pose(collider, end).center, now.center_of_mass));
        const double near = shape_geometry(collider.shape).reach + radius_of(cloth, strain) + cloth.thickness;
        if (apart < near + 2 * own) return Passage{frame, index, k, way, middle, by_way};
    }
    return std::nullopt;
}

void PassageWatch::look(std::uint32_t frame, std::uint32_t substeps, std::span<const ClothStatistics> cloths) {
    std::optional<Passage> found;
    for (std::size_t cloth = 0; cloth < cloths.size() && !last_.empty() && frame > last_frame_ && !found; ++cloth)
        found = passage(frame, substeps, cloth, last_[cloth], cloths[cloth]);
    frames_ += found.has_value();
    if (!first_) first_ = found;
    last_.assign(cloths.begin(), cloths.end());
    last_frame_ = frame;
}

std::optional<std::string> PassageWatch::text() const {
    if (!first_) return std::nullopt;
    const std::string who = fmt::format(
        "in {} frame{}, from frame {} on, {} may have passed between the particles of "
        "cloth '{}'",
        frames_, frames_ == 1 ? "" : "s", first_->frame, collider_place(model_.scene, first_->collider),
        model_.scene.cloths[first_->cloth].name);
    if (!first_->by_way)
        return fmt::format(
            "{}: its triangles came to {:.3g} m about their middles, of which {:.3g} m lets it through; a finer grid, "
            "less stretch "
            "or more thickness may help",
            who, first_->way, first_->kept);
    const std::string way = first_->way > 1e14
                                ? "it turned by more than 0.2 radians"
                                : fmt::format("one moved by {:.3g} m at most relative to the other", first_->way);
    return fmt::format(
        "{}: in a substep {}, contact is sure up to {:.3g} m; more substeps or a thicker collider may "
        "help",
        who, way, first_->kept);
}

}  // namespace drape
