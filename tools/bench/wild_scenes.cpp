#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "base/vectors.h"
#include "bench/random_scenes.h"
#include "mesh/mesh_shape.h"
#include "world/random.h"

namespace drape::bench {

namespace {

constexpr double pi = 3.14159265358979323846;

/// No call draws twice in its arguments: their order would be the compiler's.
class Dice {
  public:
    Dice(std::uint64_t seed, std::uint32_t index) : state_(seed * splitmix64_step + index) { next(), next(); }

    double uniform(double low, double high) { return low + (high - low) * unit(); }
    double log_uniform(double low, double high) { return low * std::pow(high / low, unit()); }
    bool chance(double probability) { return unit() < probability; }
    std::uint32_t below(std::uint32_t count) { return std::min(static_cast<std::uint32_t>(unit() * count), count - 1); }
    std::uint64_t next() { return splitmix64(std::exchange(state_, state_ + splitmix64_step)); }
    /// Uniform over the sphere.
    Vec3 direction() {
        const double z = uniform(-1, 1), angle = uniform(0, 2 * pi), r = std::sqrt(1 - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }
    /// A vector of log-uniform length, in any direction.
    Vec3 vector(double shortest, double longest) {
        const double length = log_uniform(shortest, longest);
        return times(length, direction());
    }
    /// A unit vector that leans away from `way` by up to `most` of its length.
    Vec3 leaning(const Vec3& way, double most) {
        const double share = uniform(0, most);
        const Vec3 aside = direction();
        Vec3 sum = way;
        for (std::size_t k = 0; k < 3; ++k) sum[k] += share * aside[k];
        const double length = std::hypot(sum[0], sum[1], sum[2]);
        return {sum[0] / length, sum[1] / length, sum[2] / length};
    }

  private:
    double unit() { return unit_interval_of(next()); }
    std::uint64_t state_;
};

Vec3 along(const Vec3& from, double distance, const Vec3& way) { return plus(from, times(distance, way)); }

double duration(const SceneDescription& scene) { return (scene.time.frame_count - 1) / scene.time.fps; }

/// Where particle-like point (s, t) in [0, 1]^2 of the flat cloth starts.
Vec3 point_of(const Cloth& cloth, double s, double t) {
    return along(along(cloth.placement.origin, s * cloth.size[0], cloth.placement.u), t * cloth.size[1],
                 cloth.placement.v);
}

/// A grid of its own shape; cells up to four times as long as wide.
void draw_shape(Cloth& cloth, Dice& dice) {
    for (std::uint32_t& side : cloth.grid)
        side = static_cast<std::uint32_t>(std::lround(dice.log_uniform(1.5001, 129.4999)));
    const double cell = dice.log_uniform(0.2, 3) / (cloth.grid[0] - 1);
    cloth.size = {cell * (cloth.grid[0] - 1), cell * dice.log_uniform(0.25, 4) * (cloth.grid[1] - 1)};
    // Ribbons of many cells stay in a room.
    const double shrink = std::min(1.0, 4 / std::max(cloth.size[0], cloth.size[1]));
    for (double& side : cloth.size) side *= shrink;
}

void draw_fabric(Cloth& cloth, Dice& dice) {
    cloth.areal_density = dice.log_uniform(0.02, 1);
    cloth.stiffness.rigid = dice.chance(0.12);
    cloth.stiffness.stretch = dice.log_uniform(50, 5e4);
    cloth.stiffness.shear = cloth.stiffness.stretch * dice.log_uniform(0.01, 0.6);
    cloth.stiffness.bend = dice.chance(0.5) ? 0 : dice.log_uniform(1e-7, 1e-2);
    cloth.damping = dice.chance(0.5) ? 0 : dice.log_uniform(0.03, 6);
    cloth.friction = dice.uniform(0, 1);
    cloth.thickness = dice.uniform(0.001, 0.012);
}

void draw_place(Cloth& cloth, std::size_t number, Dice& dice) {
    const Vec3 u = dice.direction();
    Vec3 other = dice.direction();
    while (std::abs(dot(u, other)) > 0.9) other = dice.direction();
    // Three of ten hang straight down or lie flat.
    const double kind = dice.uniform(0, 1);
    if (kind < 0.15)
        cloth.placement = {{}, {1, 0, 0}, {0, -1, 0}};
    else if (kind < 0.3)
        cloth.placement = {{}, {1, 0, 0}, {0, 0, 1}};
    else
        cloth.placement = {{}, u, unit_of(along(other, -dot(u, other), u))};
    const Vec3 middle = {6.0 * static_cast<double>(number), dice.uniform(-0.5, 2), 0};
    cloth.placement.origin =
        along(along(middle, -0.5 * cloth.size[0], cloth.placement.u), -0.5 * cloth.size[1], cloth.placement.v);
    if (dice.chance(0.3)) cloth.velocity = dice.vector(0.1, 5);
}

/// Through a few places and attitudes, at up to `speed` m/s.
MotionPath draw_path(double seconds, double speed, Dice& dice) {
    const std::uint32_t legs = 1 + dice.below(4);
    const double begin = dice.chance(0.5) ? 0 : dice.uniform(0, 0.5 * seconds);
    const double leg = (seconds - begin) / legs * dice.uniform(0.3, 1);
    MotionPath path{{{begin, {}, {}}}};
    for (std::uint32_t k = 1; k <= legs; ++k) {
        MotionKey key = path.keys.back();
        key.time = begin + k * leg;
        // Catmull-Rom overshoots: the mean speed of a leg stays well below the largest.
        const double shift = leg * dice.uniform(0, 0.6 * speed);
        key.translate = along(key.translate, shift, dice.direction());
        if (dice.chance(0.4))
            for (double& angle : key.rotate) angle += dice.uniform(-120, 120) * leg;
        path.keys.push_back(key);
    }
    return path;
}

/// By `share` of its length over `seconds`, then still.
MotionPath pull(const Vec3& direction, double length, double share, double seconds) {
    return {{{0, {}, {}}, {seconds, times(share * length, direction), {}}}};
}

void pin_taut(Cloth& cloth, double seconds, Dice& dice) {
    const std::uint32_t right = cloth.grid[0] - 1, bottom = cloth.grid[1] - 1;
    const bool sideways = dice.chance(0.5);
    const double share = cloth.stiffness.rigid ? 0 : dice.log_uniform(0.002, 0.15),
                 time = seconds * dice.uniform(0.2, 1);
    Pin first, second;
    first.particles = sideways ? IndexBox{{0, 0}, {0, bottom}} : IndexBox{{0, 0}, {right, 0}};
    second.particles = sideways ? IndexBox{{right, 0}, {right, bottom}} : IndexBox{{0, bottom}, {right, bottom}};
    if (share > 0)
        second.path = pull(sideways ? cloth.placement.u : cloth.placement.v, cloth.size[sideways ? 0 : 1], share, time);
    cloth.pins = {first, second};
}

void pin_points(Cloth& cloth, Dice& dice) {
    for (std::uint32_t k = 1 + dice.below(3); k > 0; --k) {
        const std::array<std::uint32_t, 2> at = {dice.below(cloth.grid[0]), dice.below(cloth.grid[1])};
        if (std::ranges::none_of(cloth.pins, [&](const Pin& pin) { return pin.particles.first == at; })) {
            cloth.pins.emplace_back();
            cloth.pins.back().particles = {at, at};
        }
    }
}

void draw_pins(Cloth& cloth, double seconds, Dice& dice) {
    const std::uint32_t right = cloth.grid[0] - 1, bottom = cloth.grid[1] - 1;
    const auto add = [&](const IndexBox& box) {
        cloth.pins.emplace_back();
        cloth.pins.back().particles = box;
    };
    switch (dice.below(7)) {
        case 0:
            break;  // falls or flies
        case 1:
            add({{0, 0}, {right, 0}});
            break;
        case 2:
            add({{0, 0}, {0, bottom}});
            break;
        case 3:
            add({{0, 0}, {0, 0}}), add({{right, 0}, {right, 0}});
            break;
        case 4:
            pin_points(cloth, dice);
            break;
        case 5:
            pin_taut(cloth, seconds, dice);
            break;
        default:
            for (const std::uint32_t column : {0u, right})
                for (const std::uint32_t row : {0u, bottom}) add({{column, row}, {column, row}});
    }
    // One path for all pins: apart they would pull cloth to any length.
    const bool pulled = std::ranges::any_of(cloth.pins, [](const Pin& pin) { return pin.path.moves(); });
    if (!pulled && dice.chance(0.45)) {
        const MotionPath path = draw_path(seconds, dice.log_uniform(0.2, 8), dice);
        const Vec3 pivot = point_of(cloth, 0.5, 0.5);
        for (Pin& pin : cloth.pins) pin.path = path, pin.pivot = pivot;
    }
    for (Pin& pin : cloth.pins)
        if (dice.chance(0.25)) pin.release = dice.uniform(0.02, 1) * seconds;
    cloth.velocity = cloth.pins.empty() ? cloth.velocity : Vec3{};
}

void draw_forces(SceneDescription& scene, Dice& dice) {
    const double kind = dice.uniform(0, 1);
    if (kind < 0.15)
        scene.gravity = {0, 0, 0};
    else if (kind < 0.25)
        scene.gravity = dice.vector(1, 20);
    if (!dice.chance(0.55)) return;
    scene.wind.velocity = dice.vector(0.5, 60);
    scene.wind.drag = dice.uniform(0.3, 2);
    scene.wind.lift = dice.uniform(0, 1);
    const double speed = length(scene.wind.velocity);
    if (dice.chance(0.6))
        scene.wind.gust = {speed * dice.uniform(0.1, 0.8), dice.uniform(0.1, 3),
                           static_cast<std::uint32_t>(dice.next() >> 40)};
}

struct Ball {
    Vec3 center;
    double radius;
};

/// Returns the radius of a ball about a shape's own centre that holds it, m.
double bounding_radius(const ColliderShape& shape) {
    return std::visit(ForEachKind{[](const Plane&) { return std::numeric_limits<double>::infinity(); },
                                  [](const Sphere& sphere) { return sphere.radius; },
                                  [](const Box& box) { return length(box.half_extents); },
                                  [](const Ellipsoid& ellipsoid) { return std::ranges::max(ellipsoid.radii); },
                                  [](const Capsule& capsule) {
                                      return 0.5 * length(minus(capsule.to, capsule.from)) +
                                             std::ranges::max(capsule.radii);
                                  },
                                  [](const Mesh& mesh) { return length(mesh.shape->half_extents()); }},
                      shape);
}

double draw_side(double size, Dice& dice) { return size * dice.log_uniform(0.25, 1); }

Vec3 draw_sides(double size, Dice& dice) {
    const double x = draw_side(size, dice), y = draw_side(size, dice), z = draw_side(size, dice);
    return {x, y, z};
}

/// Draws a shape about the origin.
using DrawShape = ColliderShape (*)(double size, Dice& dice);
ColliderShape draw_sphere(double size, Dice& dice) { return Sphere{{}, draw_side(size, dice)}; }
ColliderShape draw_box(double size, Dice& dice) { return Box{{}, draw_sides(size, dice)}; }
ColliderShape draw_ellipsoid(double size, Dice& dice) { return Ellipsoid{{}, draw_sides(size, dice)}; }
ColliderShape draw_capsule(double size, Dice& dice) {
    const double length = draw_side(size, dice);
    const Vec3 half = times(length, dice.direction());
    const double from = 0.5 * draw_side(size, dice), to = 0.5 * draw_side(size, dice);
    return Capsule{times(-1, half), half, {from, to}};
}
/// In the order of the kinds. `add_plane` draws planes, and a mesh is a file.
constexpr DrawShape shape_drawings[] = {nullptr, draw_sphere, draw_box, draw_ellipsoid, draw_capsule, nullptr};
static_assert(std::size(shape_drawings) == std::variant_size_v<ColliderShape>);

ColliderShape draw_solid(double size, Dice& dice) {
    std::vector<DrawShape> drawn;
    for (const DrawShape draw : shape_drawings)
        if (draw) drawn.push_back(draw);
    return drawn[dice.below(static_cast<std::uint32_t>(drawn.size()))](size, dice);
}

/// Moves a shape that is about the origin.
void move_to(ColliderShape& shape, const Vec3& place) {
    std::visit(
        ForEachKind{[](Plane&) {}, [&](Sphere& sphere) { sphere.center = place; },
                    [&](Box& box) { box.center = place; }, [&](Ellipsoid& ellipsoid) { ellipsoid.center = place; },
                    [&](Capsule& capsule) {
                        capsule.from = along(capsule.from, 1, place);
                        capsule.to = along(capsule.to, 1, place);
                    },
                    [&](Mesh& mesh) { mesh.position = place; }},
        shape);
}

bool clear_of(const std::vector<Cloth>& cloths, const Ball& ball) {
    for (const Cloth& cloth : cloths)
        for (int i = 0; i <= 16; ++i)
            for (int j = 0; j <= 16; ++j) {
                const Vec3 apart = along(point_of(cloth, i / 16.0, j / 16.0), -1, ball.center);
                // The points are up to a 32nd of the sides from everything between them.
                const double room = ball.radius + 0.02 + cloth.thickness + (cloth.size[0] + cloth.size[1]) / 32;
                if (dot(apart, apart) < room * room) return false;
            }
    return true;
}

void add_plane(SceneDescription& scene, Dice& dice) {
    const Vec3 up = dice.chance(0.7) ? Vec3{0, 1, 0} : dice.leaning({0, 1, 0}, 0.6);
    double lowest = 1e300;
    for (const Cloth& cloth : scene.cloths)
        for (const double s : {0.0, 1.0})
            for (const double t : {0.0, 1.0}) lowest = std::min(lowest, dot(up, point_of(cloth, s, t)));
    Collider plane{Plane{up, lowest - dice.uniform(0.05, 0.6)}};
    plane.friction = dice.uniform(0, 1);
    scene.colliders.push_back(plane);
}

/// Beside a cloth, mostly where gravity takes it.
void add_solid(SceneDescription& scene, Dice& dice) {
    const Cloth& cloth = scene.cloths[dice.below(static_cast<std::uint32_t>(scene.cloths.size()))];
    Collider solid{draw_solid(dice.log_uniform(0.1, 0.6) * std::max(cloth.size[0], cloth.size[1]), dice)};
    const bool falls = dot(scene.gravity, scene.gravity) > 0 && dice.chance(0.7);
    const Vec3 way = falls ? dice.leaning(unit_of(scene.gravity), 0.5) : dice.direction();
    const double s = dice.uniform(0, 1), t = dice.uniform(0, 1);
    Ball ball{point_of(cloth, s, t), bounding_radius(solid.shape)};
    const double step = 0.1 * ball.radius + 0.02;
    for (int k = 0; k < 400 && !clear_of(scene.cloths, ball); ++k) ball.center = along(ball.center, step, way);
    move_to(solid.shape, ball.center);
    solid.friction = dice.uniform(0, 1);
    if (dice.chance(0.5))
        for (double& angle : solid.rotate) angle = dice.uniform(-180, 180);
    if (dice.chance(0.4)) solid.path = draw_path(duration(scene), dice.log_uniform(0.1, 3), dice);
    scene.colliders.push_back(solid);
}

/// A blade through a cloth, at rest or swept along.
void add_cutter(SceneDescription& scene, Dice& dice) {
    const Cloth& cloth = scene.cloths[dice.below(static_cast<std::uint32_t>(scene.cloths.size()))];
    const double s = dice.uniform(0.1, 0.9), t = dice.uniform(0.1, 0.9);
    const Vec3 middle = point_of(cloth, s, t), normal = unit_of(cross(cloth.placement.u, cloth.placement.v));
    const double reach = dice.uniform(0.1, 0.6) * std::max(cloth.size[0], cloth.size[1]),
                 turn = dice.uniform(0, 2 * pi);
    const Vec3 edge = along(times(std::cos(turn), cloth.placement.u), std::sin(turn), cloth.placement.v);
    Cutter cutter;
    cutter.triangle = {along(along(middle, -reach, edge), -0.4 * reach, normal),
                       along(along(middle, reach, edge), -0.4 * reach, normal), along(middle, reach, normal)};
    cutter.begin = dice.uniform(0, 0.8) * duration(scene);
    cutter.end = cutter.begin + dice.uniform(0.05, 0.6) * duration(scene);
    if (dice.chance(0.6)) cutter.path = draw_path(duration(scene), dice.log_uniform(0.2, 3), dice);
    scene.cutters.push_back(cutter);
}

}  // namespace

SceneDescription wild_scene(std::uint32_t seed, std::uint32_t index) {
    Dice dice(seed, index);
    SceneDescription scene;
    scene.name = fmt::format("wild_{}_{}", seed, index);
    scene.time.fps = dice.chance(0.75) ? 60 : dice.chance(0.5) ? 30 : 120;
    scene.time.frame_count = 30 + dice.below(61);
    draw_forces(scene, dice);
    const double many = dice.uniform(0, 1);
    const std::size_t cloth_count = many < 0.7 ? 1 : many < 0.9 ? 2 : 3;
    for (std::size_t number = 0; number < cloth_count; ++number) {
        Cloth cloth;
        cloth.name = fmt::format("cloth{}", number);
        draw_shape(cloth, dice);
        draw_fabric(cloth, dice);
        draw_place(cloth, number, dice);
        draw_pins(cloth, duration(scene), dice);
        scene.cloths.push_back(cloth);
    }
    if (dice.chance(0.5))
        for (std::uint32_t k = 1 + dice.below(4); k > 0; --k)
            dice.chance(0.25) ? add_plane(scene, dice) : add_solid(scene, dice);
    if (dice.chance(0.15))
        for (std::uint32_t k = 1 + dice.below(2); k > 0; --k) add_cutter(scene, dice);
    scene.solver.method = SolverMethod::automatic;
    return scene;
}

}  // namespace drape::bench
