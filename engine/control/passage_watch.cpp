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

/// The dimensions that decide whether a collider may slip through the cells of a cloth.
struct Solid {
    double half;       ///< m: half of its smallest diameter
    bool edges;        ///< it has edges beside its faces
    bool arcs = true;  ///< its points move along arcs where it turns
};
/// A plane is no such solid: no cell is so wide that a plane passes through.
std::optional<Solid> solid(const Plane&) { return std::nullopt; }
std::optional<Solid> solid(const Sphere& sphere) { return Solid{sphere.radius, false, false}; }
std::optional<Solid> solid(const Box& box) { return Solid{*std::ranges::min_element(box.half_extents), true}; }
std::optional<Solid> solid(const Ellipsoid& ball) { return Solid{*std::ranges::min_element(ball.radii), false}; }
std::optional<Solid> solid(const Capsule& capsule) {
    return Solid{std::min(capsule.radii[0], capsule.radii[1]), false};
}
std::optional<Solid> solid(const Mesh& mesh) { return Solid{mesh.shape->inner_radius() + mesh.grown, false}; }

/// Returns the least length of a vector that moves in a straight line from `from` to `to`.
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

/// Returns the radius, m, of the smallest circle that holds a triangle of the cloth whose springs are stretched by
/// these strains. A ball whose centre passes through a triangle comes at least this near to a corner.
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

/// Returns the radius of a ball about the centre of mass that holds the cloth: measured along a sheet, no particle is
/// farther than 0.6 diagonals on average from the others.
double radius_of(const Cloth& cloth, double strain) {
    const double scale = std::max({1.0, cloth.placement.scale[0], cloth.placement.scale[1]});
    return 0.6 * std::hypot(cloth.size[0], cloth.size[1]) * scale * (1 + strain);
}

/// The cloth at the start and end of a frame, with the times.
struct Frame {
    std::uint32_t number, substeps;
    double start, end;  ///< s
    const ClothStatistics &before, &now;
};

/// Records the largest distance and angle that a collider moves and turns in a substep of the frame.
void note_motion(const Collider& collider, const Frame& frame, Passing& most) {
    const double h = (frame.end - frame.start) / frame.substeps;
    if (!collider.moves()) return;
    const double deforms = deformed(collider, frame.end - frame.substeps * h, frame.end) / frame.substeps;
    for (const std::uint32_t substep : {0u, frame.substeps / 2, frame.substeps - 1}) {
        const double start = frame.end - (frame.substeps - substep) * h;
        glsl::ColliderRecord record = collider_record(collider, start, start + h);
        add_deformation(record, 0, deforms);
        double squared = 0;
        for (const glsl::vec4& row : {record.change_x, record.change_y, record.change_z})
            squared += double(row.x) * row.x + double(row.y) * row.y + double(row.z) * row.z;
        most.turn = std::max(most.turn, std::sqrt(squared / 2));
        most.way = std::max(most.way, double(record.way_out.w));
    }
}

/// `own`: how far the fastest particle moves in a substep, m.
Passing passing_by(const Cloth& cloth, const Collider& collider, const Solid& solid, const Frame& frame, double own) {
    Passing passing{.cloth_way = own,
                    .half = solid.half,
                    .thickness = least_thickness(cloth),
                    .hole = widest_hole(cloth, largest_strains(frame.before, frame.now)),
                    .largest_hole = widest_hole(cloth, {springs_mean, springs_mean})};
    // Thick cloth is kept off edges, as off round colliders, by its particles alone.
    passing.by_edges = solid.edges && passing.thickness < covering_radius(cloth);
    note_motion(collider, frame, passing);
    passing.turns_far =
        solid.arcs && passing.way > 1e14;  // a record has such a distance where the paths of points are not known
    return passing;
}

/// Returns what every row of the table finds of every collider that comes near the cloth in the frame.
std::vector<Passage> passages(const SimulationModel& model, std::size_t index, const Frame& frame) {
    std::vector<Passage> all;
    const Cloth& cloth = model.scene.cloths[index];
    const std::vector<KeptCollider>& kept = model.kept_colliders[model.cloths[index].collider_list];
    const std::array<double, 2> strains = largest_strains(frame.before, frame.now);
    const double radius = radius_of(cloth, std::max(strains[0], strains[1])) + cloth.thickness;
    const double own =
        std::max(frame.before.largest_speed, frame.now.largest_speed) * (frame.end - frame.start) / frame.substeps;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        const Collider& collider = kept[k].collider;
        const auto solid_of = [](const auto& shape) { return solid(shape); };
        const std::optional<Solid> body = std::visit(solid_of, collider.shape);
        if (!body || collider.mass) continue;  // only the device knows where a body is (docs/physics.md 11)
        const double apart =
            least_length(minus(collider_pose(collider, frame.start).center, frame.before.center_of_mass),
                         minus(collider_pose(collider, frame.end).center, frame.now.center_of_mass));
        if (!(apart < shape_geometry(collider.shape).reach + radius + 2 * own)) continue;
        const Passing passing = passing_by(cloth, collider, *body, frame, own);
        for (std::uint8_t row = 0; row < passage_bounds().size(); ++row)
            all.push_back({row, frame.number, static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(k),
                           passage_bounds()[row].value(passing), passage_bounds()[row].bound(passing)});
    }
    return all;
}

}  // namespace

double passage_judgement(const SimulationModel& model, std::uint32_t frame, std::uint32_t substeps,
                         std::span<const ClothStatistics> before, std::span<const ClothStatistics> now) {
    const double fps = model.scene.time.fps;
    double worst = 0;
    for (std::size_t cloth = 0; cloth < now.size(); ++cloth) {
        // With this setting contact keeps out only particles, whatever the number of substeps.
        if (model.scene.cloths[cloth].contact == ContactOf::particles) continue;
        const Frame seen{frame, substeps, (frame - 1) / fps, frame / fps, before[cloth], now[cloth]};
        for (const Passage& passage : passages(model, cloth, seen))
            if (passage_bounds()[passage.row].substeps_help) worst = std::max(worst, passage.found / passage.kept);
    }
    return worst;
}

void PassageWatch::look(std::uint32_t frame, std::uint32_t substeps, std::span<const ClothStatistics> cloths) {
    const double fps = model_.scene.time.fps;
    bool found = false;
    for (std::size_t cloth = 0; cloth < last_.size() && frame > last_frame_; ++cloth) {
        const Frame seen{frame, substeps, last_frame_ / fps, frame / fps, last_[cloth], cloths[cloth]};
        for (const Passage& passage : passages(model_, cloth, seen)) {
            if (found || !(passage.found > passage.kept)) continue;
            found = true;
            if (frames_++ == 0) first_ = passage;
        }
    }
    last_.assign(cloths.begin(), cloths.end());
    last_frame_ = frame;
}

std::optional<std::string> PassageWatch::text() const {
    if (frames_ == 0) return std::nullopt;
    return fmt::format("in {} frame{}, from frame {} on, {} may have passed between the particles of cloth '{}': {}",
                       frames_, frames_ == 1 ? "" : "s", first_.frame, collider_place(model_.scene, first_.collider),
                       model_.scene.cloths[first_.cloth].name,
                       told(passage_bounds()[first_.row].words, {.value = first_.found, .bound = first_.kept}));
}

}  // namespace drape
