#include "bench/random_scenes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>

#include "reference/model_scenes.h"

namespace drape::bench {

namespace {

/// The same numbers on every machine: the standard's distributions are not.
class Draw {
  public:
    explicit Draw(std::uint32_t seed) : random_(seed) {}
    double between(double low, double high) {
        return low + (high - low) * (static_cast<double>(random_()) / 4294967295.0);
    }
    /// On a logarithmic scale.
    double scaled(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
    std::uint32_t integer(std::uint32_t low, std::uint32_t high) {
        return low + static_cast<std::uint32_t>(random_() % (high - low + 1));
    }

  private:
    std::mt19937 random_;
};

void add_ball(SceneDescription& scene, Draw& draw) {
    Sphere ball;
    ball.radius = draw.between(0.2, 0.45);
    ball.center = {draw.between(-0.2, 0.2), -draw.between(0.05, 0.3) - ball.radius, draw.between(-0.2, 0.2)};
    scene.colliders.push_back({ball, draw.between(0, 0.8)});
}

/// How the cloth is held and what acts on it: by an edge, swinging; by two corners; on a ball; as a flag; by all edges.
void set_situation(SceneDescription& scene, Draw& draw) {
    using model_scenes::pin_box;
    Cloth& cloth = scene.cloths[0];
    const std::uint32_t right = cloth.grid[0] - 1, bottom = cloth.grid[1] - 1;
    const double angle = draw.between(0, 90) * std::numbers::pi / 180;
    const double left_edge = -cloth.size[0] / 2, front_edge = -cloth.size[1] / 2;
    cloth.placement = {{left_edge, 0, front_edge}, {1, 0, 0}, {0, 0, 1}};
    switch (draw.integer(0, 4)) {
        case 0:
            cloth.placement.v = {0, -std::cos(angle), std::sin(angle)};
            cloth.pins = {pin_box(0, 0, right, 0)};
            break;
        case 1:
            cloth.pins = {pin_box(0, 0, 0, 0), pin_box(right, 0, right, 0)};
            break;
        case 2:
            add_ball(scene, draw);
            break;
        case 3:
            cloth.placement.v = {0, -1, 0};
            cloth.pins = {pin_box(0, 0, 0, bottom)};
            scene.wind.velocity = {draw.between(2, 8), 0, draw.between(-2, 2)};
            scene.wind.gust = {draw.between(0, 2), 1, draw.integer(1, 1000)};
            break;
        default:
            cloth.pins = {pin_box(0, 0, right, 0), pin_box(0, bottom, right, bottom), pin_box(0, 0, 0, bottom),
                          pin_box(right, 0, right, bottom)};
    }
}

void add_wind(SceneDescription& scene, Draw& draw) {
    const double speed = draw.scaled(1, 30), angle = draw.between(0, 2 * std::numbers::pi);
    const double up = draw.between(-0.3, 0.3);
    scene.wind.velocity = {speed * std::cos(angle), speed * up, speed * std::sin(angle)};
    const double amplitude = draw.between(0, 0.5) * speed, period = draw.between(0.3, 2);
    scene.wind.gust = {amplitude, period, draw.integer(1, 100000)};
}

/// A grid from 2 x 2 to 30 x 129, pins and all taken along.
void narrow(Cloth& cloth, Draw& draw) {
    const std::array<std::uint32_t, 2> before = cloth.grid;
    cloth.grid = {draw.integer(2, 30), static_cast<std::uint32_t>(draw.scaled(2, 129.99))};
    for (Pin& pin : cloth.pins)
        for (std::array<std::uint32_t, 2>* corner : {&pin.particles.first, &pin.particles.last})
            for (std::size_t axis = 0; axis < 2; ++axis)
                (*corner)[axis] = (*corner)[axis] == before[axis] - 1 ? cloth.grid[axis] - 1 : 0;
}

/// To and fro, all pins alike.
void shake(Cloth& cloth, double seconds, Draw& draw) {
    const double reach = draw.between(0.05, 0.6), beat = draw.between(0.15, 0.5);
    const std::size_t axis = draw.integer(0, 2);
    MotionPath path;
    for (std::uint32_t k = 0; k * beat <= seconds; ++k) {
        MotionKey key{k * beat, {}, {}};
        key.translate[axis] = k % 2 == 1 ? reach : 0;
        path.keys.push_back(key);
    }
    for (Pin& pin : cloth.pins) pin.path = path;
}

/// Below the cloth, which starts in the plane y = 0 or hangs from it.
void add_obstacle(SceneDescription& scene, double seconds, Draw& draw) {
    const double depth = draw.between(0.3, 0.6), x = draw.between(-0.5, 0.5), z = draw.between(-0.5, 0.5);
    const double hang = scene.cloths[0].placement.v[1] < -0.1 ? scene.cloths[0].size[1] : 0;
    const double radius = draw.between(0.1, 0.25), y = -hang - depth;
    Collider obstacle;
    const ColliderShape shapes[] = {Plane{{0, 1, 0}, y - radius}, Box{{x, y, z}, {radius, 0.7 * radius, 0.5 * radius}},
                                    Capsule{{x - 0.2, y, z}, {x + 0.2, y, z}, {radius, 0.5 * radius}},
                                    Ellipsoid{{x, y, z}, {radius, 0.5 * radius, 0.8 * radius}}};
    constexpr std::size_t not_drawn = 2;  // a sphere is thrown elsewhere, and a mesh is a file
    static_assert(std::size(shapes) + not_drawn == std::variant_size_v<ColliderShape>);
    obstacle.shape = shapes[draw.integer(0, std::size(shapes) - 1)];
    obstacle.friction = draw.between(0, 0.8);
    if (draw.integer(0, 2) == 0) {
        const double lift = draw.between(0, depth), shift = draw.between(-0.5, 0.5);
        obstacle.path.keys = {{0, {}, {}}, {seconds, {shift, lift, 0}, {}}};
    }
    scene.colliders.push_back(obstacle);
}

void add_blade(SceneDescription& scene, double seconds, Draw& draw) {
    const Cloth& cloth = scene.cloths[0];
    const double s = draw.between(0.2, 0.8) * cloth.size[0], t = draw.between(0.2, 0.8) * cloth.size[1];
    Vec3 at = cloth.placement.origin;
    for (std::size_t k = 0; k < 3; ++k) at[k] += s * cloth.placement.u[k] + t * cloth.placement.v[k];
    Cutter blade;
    blade.triangle = {
        Vec3{at[0], at[1] - 0.3, at[2] - 0.3}, {at[0], at[1] + 0.3, at[2]}, {at[0], at[1] - 0.3, at[2] + 0.3}};
    blade.begin = draw.between(0, 0.5) * seconds;
    blade.end = blade.begin + 0.2 * seconds;
    scene.cutters.push_back(blade);
}

}  // namespace

SceneDescription random_scene(std::uint32_t seed) {
    Draw draw(seed);
    // One by one: the order in which a call's arguments are drawn would be the compiler's.
    const std::uint32_t columns = draw.integer(20, 90), rows = draw.integer(20, 90);
    const double width = draw.between(0.5, 2), height = draw.between(0.5, 2);
    SceneDescription scene = model_scenes::sheet(columns, rows, width, height, 1);
    Cloth& cloth = scene.cloths[0];
    cloth.areal_density = draw.scaled(0.08, 0.5);
    cloth.stiffness.stretch = draw.scaled(500, 10000);
    cloth.stiffness.shear = draw.scaled(0.02, 0.3) * cloth.stiffness.stretch;
    cloth.damping = draw.between(0, 2);
    cloth.friction = draw.between(0, 0.8);
    set_situation(scene, draw);
    scene.time.frame_count = 46;
    return scene;
}

SceneDescription full_random_scene(std::uint32_t seed, std::uint32_t index) {
    SceneDescription scene = random_scene(1000003 * seed + 2 * index);
    Draw draw(1000003 * seed + 2 * index + 1);
    const auto one_of = [&draw](std::uint32_t count) { return draw.integer(1, count) == 1; };
    scene.time.frame_count = draw.integer(30, 90);
    const double seconds = (scene.time.frame_count - 1) / scene.time.fps;
    Cloth& cloth = scene.cloths[0];
    if (one_of(4)) narrow(cloth, draw);
    if (one_of(2)) add_wind(scene, draw);
    if (one_of(10)) scene.gravity = {0, 0, 0};
    if (one_of(8)) cloth.stiffness.rigid = true;
    if (one_of(2)) cloth.stiffness.bend = draw.scaled(1e-7, 1e-3);
    if (one_of(4)) shake(cloth, seconds, draw);
    for (Pin& pin : cloth.pins)
        if (one_of(5)) pin.release = draw.between(0.05, 0.9) * seconds;
    if (one_of(3))
        for (std::uint32_t k = draw.integer(1, 2); k > 0; --k) add_obstacle(scene, seconds, draw);
    if (one_of(8)) add_blade(scene, seconds, draw);
    if (one_of(6)) {
        Cloth second = random_scene(1000003 * seed + 2 * index + 500000).cloths[0];
        second.name = "second";
        second.placement.origin[2] += 5;
        scene.cloths.push_back(second);
    }
    scene.solver.method = SolverMethod::automatic;
    return scene;
}

}  // namespace drape::bench
