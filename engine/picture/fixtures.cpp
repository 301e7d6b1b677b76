#include "picture/fixtures.h"

#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "picture/picture_places.h"
#include "world/collider_pose.h"
#include "world/motion.h"
#include "world/start.h"
#include "world/up.h"

namespace drape {
namespace {

constexpr std::size_t most_pins = 256;

Vec3 middle(const Vec3& a, const Vec3& b) { return sum(sum({0, 0, 0}, a, 0.5), b, 0.5); }

/// Finds the fixtures of one cloth, sized after it.
class Fitter {
  public:
    Fitter(const SceneDescription& scene, const Cloth& cloth, std::vector<Fixture>& found)
        : scene_(scene),
          cloth_(cloth),
          found_(found),
          size_(std::max(cloth.size[0], cloth.size[1])),
          up_(up_axis(scene.up)) {}

    void fit() {
        std::vector<const Pin*> points;
        for (const Pin& pin : cloth_.pins) {
            const IndexBox& box = pin.particles;
            if (box.first == box.last)
                points.push_back(&pin);
            else
                fit_row(pin);
        }
        if (fit_rail(points)) return;
        for (const Pin* pin : points) fit_point(*pin);
    }

  private:
    Vec3 first(const Pin& pin) const { return start_place(cloth_, pin.particles.first[0], pin.particles.first[1]); }

    void add(const Vec3& from, const Vec3& to, double radius, const Pin& pin) {
        const IndexBox& box = pin.particles;
        const Vec3 centroid = middle(first(pin), start_place(cloth_, box.last[0], box.last[1]));
        found_.push_back({from, to, radius * size_, pin.path, pin.pivot.value_or(centroid)});
    }
    void add_knob(const Vec3& at, const Pin& pin, double radius = knob) { add(at, at, radius, pin); }

    /// Fits a pin of one row or column, or of a few beside each other, of which the outermost counts.
    void fit_row(const Pin& pin) {
        const IndexBox& box = pin.particles;
        const double wide = cloth_.size[0] * (box.last[0] - box.first[0]) / (cloth_.grid[0] - 1.0);
        const double high = cloth_.size[1] * (box.last[1] - box.first[1]) / (cloth_.grid[1] - 1.0);
        if (std::min(wide, high) > 0.25 * size_) return;  // an area is held by nothing that could be drawn
        std::array<std::uint32_t, 2> from = box.first, to = box.last;
        const std::size_t across = wide >= high ? 1 : 0;
        const bool at_end = box.last[across] + 1 == cloth_.grid[across] && box.first[across] > 0;
        from[across] = to[across] = at_end ? box.last[across] : box.first[across];
        if (is_bent(from, to)) return;
        fit_bar(start_place(cloth_, from[0], from[1]), start_place(cloth_, to[0], to[1]), pin);
    }

    /// Returns whether a given shape leads a row of particles along no straight line.
    bool is_bent(const std::array<std::uint32_t, 2>& from, const std::array<std::uint32_t, 2>& to) const {
        if (cloth_.start.empty()) return false;
        const Vec3 begin = start_place(cloth_, from[0], from[1]), end = start_place(cloth_, to[0], to[1]);
        const Vec3 along = sum(end, begin, -1);
        const double squared = dot(along, along);
        for (std::uint32_t row = from[1]; row <= to[1]; ++row)
            for (std::uint32_t column = from[0]; column <= to[0]; ++column) {
                const Vec3 away = sum(start_place(cloth_, column, row), begin, -1);
                const double share = squared > 0 ? dot(away, along) / squared : 0;
                if (length(sum(away, along, -share)) > 0.01 * size_) return true;
            }
        return false;
    }

    void fit_bar(Vec3 from, Vec3 to, const Pin& pin) {
        Vec3 along = sum(to, from, -1);
        const double reach = length(along);
        if (!(reach > 0)) return;
        for (double& part : along) part /= reach;
        const bool upright = std::abs(along[up_]) > 0.8;
        if (upright && along[up_] < 0) {
            std::swap(from, to);
            for (double& part : along) part = -part;
        }
        const std::optional<double> floor = floor_below(scene_.colliders, from[up_], up_);
        const bool stands = upright && floor && pin.path.keys.empty();
        from = stands ? sum(from, along, (*floor - from[up_]) / along[up_]) : sum(from, along, -overhang * size_);
        to = sum(to, along, overhang * size_);
        add(from, to, upright ? pole : rail, pin);
        add_knob(to, pin, finial);
        if (!upright) add_knob(from, pin, finial);
    }

    /// Fits three or more points on one line that is not upright, held by pins that stay on it.
    bool fit_rail(const std::vector<const Pin*>& points) {
        if (points.size() < 3) return false;
        Vec3 along = sum(first(*points.back()), first(*points.front()), -1);
        const double reach = length(along);
        if (!(reach > 0) || std::abs(along[up_]) > 0.8 * reach) return false;
        for (double& part : along) part /= reach;
        const Vec3 origin = first(*points.front());
        double low = 0, high = 0;
        const auto on_line = [&](const Vec3& point) {
            const Vec3 away = sum(point, origin, -1);
            const double place = dot(away, along);
            low = std::min(low, place);
            high = std::max(high, place);
            return length(sum(away, along, -place)) < 1e-3 * size_;
        };
        for (const Pin* pin : points) {
            if (!on_line(first(*pin))) return false;
            for (const MotionKey& key : pin->path.keys)
                if (!on_line(sum(first(*pin), key.translate))) return false;
        }
        Pin still;
        still.particles = points.front()->particles;
        const Vec3 from = sum(origin, along, low - overhang * size_), to = sum(origin, along, high + overhang * size_);
        add(from, to, rail, still);
        add_knob(from, still, finial);
        add_knob(to, still, finial);
        for (const Pin* pin : points) add_knob(first(*pin), *pin);
        return true;
    }

    void fit_point(const Pin& pin) {
        const Vec3 at = first(pin);
        const std::optional<double> floor = floor_below(scene_.colliders, at[up_], up_);
        Vec3 foot = at;
        foot[up_] = floor.value_or(at[up_]);
        if (floor && pin.path.keys.empty()) add(foot, at, pole, pin);
        add_knob(at, pin);
    }

    // These are in units of the cloth's longer side.
    static constexpr double pole = 0.011, rail = 0.009, knob = 0.014, finial = 0.018, overhang = 0.05;

    const SceneDescription& scene_;
    const Cloth& cloth_;
    std::vector<Fixture>& found_;
    double size_;
    std::size_t up_;  ///< the coordinate that grows upwards
};

/// The rim alone shows where a blade is and hides no cloth.
void add_blade(const Cutter& cutter, std::vector<Fixture>& found) {
    constexpr Vec3 steel{0.62, 0.66, 0.70};
    const auto& [a, b, c] = cutter.triangle;
    const double longest = std::max({length(sum(b, a, -1)), length(sum(c, b, -1)), length(sum(a, c, -1))});
    const Vec3 centroid = sum({0, 0, 0}, sum(sum(a, b), c), 1.0 / 3);
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}})
        found.push_back({from, to, 0.0015 * longest, cutter.path, centroid, cutter.begin, cutter.end, steel});
}

}  // namespace

std::vector<Fixture> fixtures(const SceneDescription& scene) {
    std::vector<Fixture> found;
    if (scene.image.blades)
        for (const Cutter& cutter : scene.cutters) add_blade(cutter, found);
    std::size_t pins = 0;
    for (const Cloth& cloth : scene.cloths) pins += cloth.pins.size();
    if (!scene.image.fixtures || pins > most_pins) return found;
    for (const Cloth& cloth : scene.cloths) Fitter(scene, cloth, found).fit();
    return found;
}

Collider posed(const Fixture& fixture, double time) {
    const RigidTransform motion = motion_at(fixture.path, time);
    const auto moved = [&](const Vec3& point) {
        const Vec3 turned = rotate(motion.rotation, sum(point, fixture.pivot, -1));
        return sum(sum(fixture.pivot, motion.translation), turned);
    };
    Collider collider;
    collider.color = fixture.color;
    const bool seen = time >= fixture.begin && time <= fixture.end;
    const double radius = seen ? fixture.radius : 0;  // a shape without a size covers nothing
    if (fixture.from == fixture.to)
        collider.shape = Sphere{moved(fixture.from), radius};
    else
        collider.shape = Capsule{moved(fixture.from), moved(fixture.to), {radius, radius}};
    return collider;
}

}  // namespace drape
