// Random scenes in winds from a breeze to 200 m/s test what no wind may do.
#pragma once

#include <random>

#include "support/sheets.h"

namespace drape::test {

/// The seeded generator's numbers are the same on every platform, which std's distributions do not promise.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// Draws evenly over the orders of magnitude.
    double over_orders(double low, double high) { return low * std::pow(high / low, unit()); }
    std::uint32_t count(std::uint32_t low, std::uint32_t high) {
        return low + static_cast<std::uint32_t>(unit() * (high - low + 1));
    }
    bool chance(double share) { return unit() < share; }
    Vec3 direction() {
        const double z = between(-1, 1), angle = between(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }

  private:
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    std::mt19937_64 engine_;
};

inline std::vector<Pin> some_pins(Dice& dice, const Cloth& cloth) {
    const std::uint32_t right = cloth.grid[0] - 1, down = cloth.grid[1] - 1;
    switch (dice.count(0, 5)) {
        case 0:
            return {};
        case 1:
            return {pin_box(0, 0, 0, 0), pin_box(right, 0, right, 0)};
        case 2:
            return {pin_box(0, 0, 0, down)};
        case 3:
            return {pin_box(0, 0, 0, 0), pin_box(right, 0, right, 0), pin_box(0, down, right, down)};
        case 4: {
            Pin released = pin_top(cloth);
            released.release = dice.between(0, 1);
            return {released};
        }
        default:
            return {pin_top(cloth)};
    }
}

/// Returns scene `seed`: one cloth of 8 to 32 particles a side and 0.01 to 1 kg/m^2, 30 to 120 frames, 1 to 20
/// substeps, gusts in half of them, a collider in every fifth; methods take turns, `auto` included.
inline SceneDescription windy_scene(std::uint64_t seed) {
    Dice dice(seed);
    SceneDescription scene = sheet(dice.count(8, 32), dice.count(8, 32), dice.between(0.5, 2), dice.between(0.5, 2),
                                   dice.count(1, 20), dice.chance(0.3) ? dice.count(2, 5) : 1);
    scene.time.frame_count = dice.count(30, 120) + 1;
    constexpr SolverMethod methods[] = {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line,
                                        SolverMethod::automatic};
    scene.solver.method = methods[seed % 4];
    const double speed = dice.between(0, 200);
    const Vec3 direction = dice.direction();
    scene.wind.velocity = {speed * direction[0], speed * direction[1], speed * direction[2]};
    if (dice.chance(0.5))
        scene.wind.gust = {dice.between(0, 0.5) * speed, dice.over_orders(0.02, 1), dice.count(0, 1000)};
    scene.wind.drag = dice.between(0.5, 1.5);
    scene.wind.lift = dice.between(0, 1);
    Cloth& cloth = scene.cloths[0];
    cloth.areal_density = dice.over_orders(0.01, 1);
    cloth.stiffness = {dice.chance(0.1), dice.over_orders(50, 1e5), dice.over_orders(1, 1e4),
                       dice.chance(0.4) ? dice.over_orders(1e-6, 1e-2) : 0};
    if (dice.chance(0.5)) cloth.placement.v = {0, 0, 1};
    if (dice.chance(0.3)) cloth.damping = dice.between(0, 2);
    cloth.pins = some_pins(dice, cloth);
    if (dice.chance(0.2)) scene.colliders = {{Sphere{{0.5, -0.5, 0.2}, 0.3}, 0.3}, {Plane{{0, 1, 0}, -1.5}, 0.3}};
    return scene;
}

}  // namespace drape::test
