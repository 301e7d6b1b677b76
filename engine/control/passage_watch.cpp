#include "control/passage_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vectors.h"
#include "cloth/cloth_statistics.h"
#include "cloth/frame_inputs.h"
#include "world/collider_pose.h"
#include "world/contact_shape.h"

namespace drape {

namespace {

double least_half_width(const ColliderShape& shape) {
    const Vec3 size = shape_geometry(shape).size;
    if (std::holds_alternative<Sphere>(shape)) return size[0];
    if (const Mesh* mesh = std::get_if<Mesh>(&shape)) return mesh->shape->inner_radius() + mesh->grown;
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

/// The way and turn of a collider in a substep, at most.
struct Motion {
    double way = 0;   ///< m: no point of the surface moves farther
    double turn = 0;  ///< radians
};

/// Returns that of the frame that ends at `end`.
Motion motion_of(const Collider& collider, double end, double h, std::uint32_t substeps) {
    Motion most;
    if (!collider.moves()) return most;
    const double deforms = deformed(collider, end - substeps * h, end) / substeps;
    for (const std::uint32_t substep : {0u, substeps / 2, substeps - 1}) {
        const double start = end - (substeps - substep) * h;
        glsl::ColliderRecord record = collider_record(collider, start, start + h);
        add_deformation(record, 0, deforms);
        double squared = 0;
        for (const glsl::vec4& row : {record.change_x, record.change_y, record.change_z})
            squared += double(row.x) * row.x + double(row.y) * row.y + double(row.z) * row.z;
        most.turn = std::max(most.turn, std::sqrt(squared / 2));
        most.way = std::max(most.way, double(record.way_out.w));
    }
    return most;
}

/// The cloth at the begin and end of a frame, and how long it takes.
struct Frame {
    std::uint32_t number, substeps;
    double start, end;  ///< s
    const ClothStatistics &before, &now;
};

/// Calls `see(passage)` for what of a collider may be too much for contact, whether it is or not. `own`: the way of the
/// fastest particle in a substep, m.
template <class See>
void look_at(const Cloth& cloth, const Collider& collider, const Frame& frame, double own, const See& see) {
    constexpr double most_turn = 0.2;  // beyond it the record's way is none (surface_motion)
    /// Edges and corners of boxes lead triangles away that are not torn apart. Beyond this strain springs follow no
    /// fabric, of which a run warns too (control/watch.h).
    constexpr double most_strain = 0.5;
    const Motion motion = motion_of(collider, frame.end, (frame.end - frame.start) / frame.substeps, frame.substeps);
    // Thick cloth is kept off boxes by its particles alone, as off round colliders.
    const bool by_edges = collider.kind() == glsl::kind_box && least_thickness(cloth) < covering_radius(cloth);
    const double half = least_half_width(collider.shape);
    if (motion.way > 1e14 && collider.kind() != glsl::kind_sphere)
        see({.by = Passage::By::turn, .found = std::max(motion.turn, 1.01 * most_turn), .kept = most_turn});
    else if (by_edges)
        see({.by = Passage::By::way, .found = 1.25 * (own + motion.way), .kept = half});
    see({.by = Passage::By::hole,
         .found = widest_hole(cloth, largest_strains(frame.before, frame.now)),
         .kept = by_edges ? widest_hole(cloth, {most_strain, most_strain}) : half + least_thickness(cloth)});
}

/// Calls `see(passage)` for every collider that comes near the cloth in the frame.
template <class See>
void for_those_near(const SimulationModel& model, std::size_t index, const Frame& frame, const See& see) {
    const Cloth& cloth = model.scene.cloths[index];
    const std::vector<KeptCollider>& kept = model.kept_colliders[model.cloths[index].collider_list];
    const std::array<double, 2> strains = largest_strains(frame.before, frame.now);
    const double radius = radius_of(cloth, std::max(strains[0], strains[1])) + cloth.thickness;
    const double own =
        std::max(frame.before.largest_speed, frame.now.largest_speed) * (frame.end - frame.start) / frame.substeps;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        const Collider& collider = kept[k].collider;
        if (collider.kind() == glsl::kind_plane) continue;
        const double apart =
            least_length(minus(collider_pose(collider, frame.start).center, frame.before.center_of_mass),
                         minus(collider_pose(collider, frame.end).center, frame.now.center_of_mass));
        if (!(apart < shape_geometry(collider.shape).reach + radius + 2 * own)) continue;
        look_at(cloth, collider, frame, own, [&](Passage passage) {
            passage.frame = frame.number;
            passage.cloth = static_cast<std::uint32_t>(index);
            passage.collider = static_cast<std::uint32_t>(k);
            see(passage);
        });
    }
}

}  // namespace

double passage_judgement(const SimulationModel& model, std::uint32_t frame, std::uint32_t substeps,
                         std::span<const ClothStatistics> before, std::span<const ClothStatistics> now) {
    const double fps = model.scene.time.fps;
    double worst = 0;
    for (std::size_t cloth = 0; cloth < now.size(); ++cloth) {
        // Only particles are kept out then, with any substeps.
        if (model.scene.cloths[cloth].contact == ContactOf::particles) continue;
        for_those_near(model, cloth, {frame, substeps, (frame - 1) / fps, frame / fps, before[cloth], now[cloth]},
                       [&](const Passage& passage) {
                           if (passage.by != Passage::By::hole) worst = std::max(worst, passage.found / passage.kept);
                       });
    }
    return worst;
}

std::vector<ClothStatistics> starting_statistics(const SimulationModel& model) {
    std::vector<ClothStatistics> all;
    for (const ClothModel& cloth : model.cloths) {
        ClothStatistics& start = all.emplace_back();
        start.stretch.largest = start.shear.largest = cloth.start_strain;
        start.largest_speed = cloth.start_speed;
        const std::vector<float> shares = mass_shares(cloth);
        for (std::size_t i = 0; i < shares.size(); ++i) {
            const glsl::vec4& at = cloth.position[i];
            start.mass += shares[i];
            start.center_of_mass = plus(start.center_of_mass, times(shares[i], Vec3{at.x, at.y, at.z}));
        }
        start.center_of_mass = times(1 / std::max(start.mass, 1e-300), start.center_of_mass);
    }
    return all;
}

void PassageWatch::look(std::uint32_t frame, std::uint32_t substeps, std::span<const ClothStatistics> cloths) {
    const double fps = model_.scene.time.fps;
    std::optional<Passage> found;
    for (std::size_t cloth = 0; cloth < cloths.size() && !last_.empty() && frame > last_frame_ && !found; ++cloth)
        for_those_near(model_, cloth, {frame, substeps, last_frame_ / fps, frame / fps, last_[cloth], cloths[cloth]},
                       [&](const Passage& passage) {
                           if (!found && passage.found > passage.kept) found = passage;
                       });
    if (found && frames_++ == 0) first_ = *found;
    last_.assign(cloths.begin(), cloths.end());
    last_frame_ = frame;
}

std::optional<std::string> PassageWatch::text() const {
    if (frames_ == 0) return std::nullopt;
    const std::string who =
        fmt::format("in {} frame{}, from frame {} on, {} may have passed between the particles of cloth '{}'", frames_,
                    frames_ == 1 ? "" : "s", first_.frame, collider_place(model_.scene, first_.collider),
                    model_.scene.cloths[first_.cloth].name);
    switch (first_.by) {
        case Passage::By::way:
            return fmt::format(
                "{}: in a substep one moved by {:.3g} m at most relative to the other, contact is sure up to {:.3g} m; "
                "more substeps or a thicker collider may help",
                who, first_.found, first_.kept);
        case Passage::By::turn:
            return fmt::format(
                "{}: in a substep it turned by more than {:.3g} radians, up to which contact is sure; more substeps "
                "may help",
                who, first_.kept);
        case Passage::By::hole:
            break;
    }
    return fmt::format(
        "{}: its triangles came to {:.3g} m about their middles, of which {:.3g} m lets it through; a finer grid, less "
        "stretch or more thickness may help",
        who, first_.found, first_.kept);
}

}  // namespace drape
