#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "contact_scenes.h"
#include "world/random.h"

namespace drape::test {

namespace {

using Triple = std::array<double, 3>;

template <class Numbers>
std::string listed(const Numbers& numbers) {
    return fmt::format("[{:.9g}]", fmt::join(numbers, ", "));
}

/// Draws a scene, key by key.
class SceneDraw {
  public:
    SceneDraw(std::uint64_t seed, std::uint64_t index) : state_(splitmix64(splitmix64(seed) + index)) {}

    std::string scene() {
        const bool weightless = chance(0.2);
        const std::array<const char*, 3> methods{"line", "line", "explicit"};
        const std::string method = chance(0.2) ? "relax" : methods[below(3)];
        const std::uint32_t substeps = method == "explicit" ? 20 + below(40) : 4 + below(20), count = 1 + below(3);
        wild_ = chance(0.3);
        std::vector<std::string> cloths;
        for (std::uint32_t k = 0; k < count; ++k) cloths.push_back(cloth(k));
        std::string text = fmt::format(
            R"({{"name": "random", "time": {{"frames": 17}}, "solver": {{"method": "{}", "substeps": {}}},
 "gravity": {}, "cloths": [{}])",
            method, substeps, listed(weightless ? Triple{} : Triple{0, -9.81, 0}), fmt::join(cloths, ",\n "));
        text += colliders();
        if (chance(0.3))
            text += fmt::format(R"(, "wind": {{"velocity": {}, "gust": {{"amplitude": {:.3f}, "period": 0.3}}}})",
                                listed(vector(wild_ ? 30 : 6)), uniform(0, 5));
        if (chance(0.15))
            text += fmt::format(R"(, "cutters": [{{"triangle": [{}, {}, {}], "active": [0.02, 0.2]}}])",
                                listed(vector(0.6)), listed(vector(0.6)), listed(vector(0.6)));
        return text + "}";
    }

  private:
    double uniform(double low, double high) {
        state_ += splitmix64_step;
        return low + (high - low) * unit_interval_of(splitmix64(state_));
    }
    double log_uniform(double low, double high) { return low * std::pow(high / low, uniform(0, 1)); }
    bool chance(double probability) { return uniform(0, 1) < probability; }
    std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(uniform(0, count)); }
    Triple vector(double most) {
        const double x = uniform(-most, most), y = uniform(-most, most);
        return {x, y, uniform(-most, most)};
    }

    std::string path() {
        const double reach = wild_ ? 1.2 : 0.25, turn = chance(0.5) ? 0 : wild_ ? 300 : 60, end = uniform(0.1, 0.3);
        const std::string translate = listed(vector(reach)), rotate = listed(vector(turn));
        return fmt::format(R"("path": [{{"t": 0}}, {{"t": {:.9g}, "translate": {}, "rotate": {}}}])", end, translate,
                           rotate);
    }

    /// A sheet's middle and its directions.
    struct Pose {
        Triple middle, u, v, normal;
    };

    Pose anywhere() {
        const double turn = uniform(0, 2 * std::numbers::pi), tilt = uniform(0, 2 * std::numbers::pi);
        const double c = std::cos(turn), s = std::sin(turn), down = std::cos(tilt), back = std::sin(tilt);
        return {vector(chance(0.3) ? 0.6 : 0.2), {c, 0, s}, {-s * back, -down, c * back}, {s * down, -back, -c * down}};
    }

    /// Lays a sheet beside the first one, turned within its plane.
    Pose layer(std::uint32_t number) {
        const double angle = uniform(0, 2 * std::numbers::pi), c = std::cos(angle), s = std::sin(angle);
        const double height = number * uniform(0.02, 0.15);
        Pose pose = first_;
        for (std::size_t k = 0; k < 3; ++k) {
            pose.middle[k] += height * first_.normal[k] + uniform(-0.1, 0.1) * first_.u[k];
            pose.u[k] = c * first_.u[k] + s * first_.v[k];
            pose.v[k] = c * first_.v[k] - s * first_.u[k];
        }
        return pose;
    }

    /// Places a sheet that flies to the origin, or to the first one.
    std::string placement(std::uint32_t number, double width, double height) {
        const bool layered = number > 0 && chance(0.8);
        const Pose pose = layered ? layer(number) : anywhere();
        if (number == 0) first_ = pose;
        const Triple across = vector(wild_ ? 15 : 2);
        const double back = wild_ ? 20 : 5, to_first = layered ? uniform(0, wild_ ? 20 : 4) : 0;
        Triple origin{}, velocity{};
        for (std::size_t k = 0; k < 3; ++k) {
            origin[k] = pose.middle[k] - 0.5 * (width * pose.u[k] + height * pose.v[k]);
            velocity[k] = across[k] - back * pose.middle[k] - to_first * pose.normal[k];
        }
        std::string text = fmt::format(R"("placement": {{"origin": {}, "u": {}, "v": {})", listed(origin),
                                       listed(pose.u), listed(pose.v));
        // A sheet that is pressed together crumples at once.
        if (chance(0.35)) text += fmt::format(R"(, "scale": [{:.9g}, {:.9g}])", uniform(0.5, 1.05), uniform(0.5, 1.05));
        if (chance(0.5)) text += fmt::format(R"(, "jitter": {:.9g}, "seed": {})", log_uniform(1e-5, 4e-2), below(1000));
        return text + fmt::format(R"(}}, "velocity": {})", listed(velocity));
    }

    std::string cloth(std::uint32_t number) {
        const std::uint32_t columns = 5 + below(11), rows = 5 + below(11);
        const double width = uniform(0.25, 0.9), height = width * (chance(0.6) ? 1 : uniform(0.3, 1.5));
        const double spacing = std::min(width / (columns - 1), height / (rows - 1));
        std::string text =
            fmt::format(R"({{"grid": [{}, {}], "size": [{:.9g}, {:.9g}], {}, "areal_density": {:.9g})", columns, rows,
                        width, height, placement(number, width, height), log_uniform(0.05, 0.8));
        text += fmt::format(R"(, "stiffness": {{"stretch": {:.9g}, "shear": {:.9g}, "bend": {:.9g}}})",
                            log_uniform(50, 4000), log_uniform(5, 400), log_uniform(1e-6, 1e-3));
        text += fmt::format(R"(, "damping": {:.9g}, "friction": {:.9g}, "thickness": {:.9g})", uniform(0, 2),
                            uniform(0, 1), uniform(0, 0.5) * spacing);
        if (number == 0 || chance(0.7))
            text += fmt::format(R"(, "self_collision": {{"thickness": {:.9g}, "friction": {:.9g}}})",
                                uniform(0.1001, 0.9999) * spacing, uniform(0, 1));
        if (chance(0.15))
            text += fmt::format(R"(, "holes": [[[1, 1], [{}, {}]]])", 2 + below(columns - 3), 2 + below(rows - 3));
        if (chance(0.5)) text += pins(columns, rows);
        return text + "}";
    }

    std::string pin(std::uint32_t columns, std::uint32_t rows) {
        const std::array<const char*, 4> edges{"left", "right", "top", "bottom"};
        std::string text = chance(0.6) ? fmt::format(R"({{"edge": "{}")", edges[below(4)])
                                       : fmt::format(R"({{"at": [{}, {}])", below(columns), below(rows));
        if (chance(0.7)) text += ", " + path();
        if (chance(0.2)) text += fmt::format(R"(, "release": {:.9g})", uniform(0.02, 0.2));
        return text + "}";
    }

    std::string pins(std::uint32_t columns, std::uint32_t rows) {
        std::string text = pin(columns, rows);
        if (chance(0.6)) text += ", " + pin(columns, rows);
        return fmt::format(R"(, "pins": [{}])", text);
    }

    std::string colliders() {
        std::string text;
        const auto moving = [&] { return chance(0.4) ? ", " + path() : std::string(); };
        if (chance(0.5)) text += fmt::format(R"(, "planes": [{{"offset": {:.9g}{}}}])", uniform(-0.7, -0.4), moving());
        if (chance(0.3))
            text += fmt::format(R"(, "spheres": [{{"center": {}, "radius": {:.9g}{}}}])", listed(vector(0.6)),
                                uniform(0.1, 0.3), moving());
        if (chance(0.2))
            text += fmt::format(R"(, "boxes": [{{"center": {}, "half_extents": [0.2, 0.1, 0.15]{}}}])",
                                listed(vector(0.6)), moving());
        if (chance(0.15))
            text += fmt::format(R"(, "capsules": [{{"from": {}, "to": {}, "radius": 0.1{}}}])", listed(vector(0.6)),
                                listed(vector(0.6)), moving());
        return text.empty() ? "" : fmt::format(R"(, "colliders": {{{}}})", text.substr(2));
    }

    std::uint64_t state_;
    bool wild_ = false;
    Pose first_{};
};

}  // namespace

std::string random_contact_scene(std::uint64_t seed, std::uint32_t index) { return SceneDraw(seed, index).scene(); }

}  // namespace drape::test
