#include "bench/random_scenes.h"

#include <algorithm>
#include <cmath>
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
    cloth.stiffness.shear = draw.scaled(0.02, 0.3) * cloth.stiffness.stretch.warp;
    cloth.damping = draw.between(0, 2);
    cloth.friction = draw.between(0, 0.8);
    set_situation(scene, draw);
    scene.time.frame_count = 46;
    return scene;
}

}  // namespace drape::bench
