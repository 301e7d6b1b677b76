#include "contact_scenes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

namespace drape::test {

namespace {

/// Cloth that is easily folded.
constexpr std::string_view limp = R"("stiffness": {"stretch": 200, "shear": 40, "bend": 1e-4}, "friction": 0.4)";

std::string scene(std::string_view name, std::uint32_t frames, std::uint32_t substeps, std::string_view parts) {
    return fmt::format(
        R"({{"name": "{}", "time": {{"frames": {}}}, "solver": {{"method": "line", "substeps": {}}},
 {}}})",
        name, frames, substeps, parts);
}

/// Pins the first and the last column with keys, `keys(side)`, that turn against each other.
template <class Keys>
std::string bars(std::uint32_t columns, std::uint32_t rows, const Keys& keys) {
    return fmt::format(
        R"([{{"box": [[0, 0], [0, {1}]], "path": [{2}]}}, {{"box": [[{0}, 0], [{0}, {1}]], "path": [{3}]}}])",
        columns - 1, rows - 1, keys(-1), keys(1));
}

std::string key(double time, double along, double degrees) {
    return fmt::format(R"({{"t": {}, "translate": [{}, 0, 0], "rotate": [{}, 0, 0]}})", time, along, degrees);
}

/// An upright sheet of n x n particles that falls on its lower edge.
std::string folding_parts(std::uint32_t n) {
    return fmt::format(R"("cloths": [{{"name": "sheet", "grid": [{0}, {0}],
  "placement": {{"origin": [-0.5, 1.05, 0], "u": [1, 0, 0.02], "v": [-0.001, -1, 0.05]}}, {1}, "damping": 1,
  "self_collision": {{"thickness": {2}}}}}], "colliders": {{"planes": [{{"friction": 0.6}}]}})",
                       n, limp, 0.5 / (n - 1));
}

}  // namespace

std::string twisted_strip(std::uint32_t n, std::uint32_t frames, std::uint32_t substeps) {
    const std::uint32_t columns = 9 * n + 1, rows = n + 1;
    const auto keys = [&](int side) {
        return key(0, 0, 0) + ", " + key((frames - 1) / 60.0, -0.02 * side, 4 * 360.0 * side);
    };
    return scene(
        "twist", frames, substeps,
        fmt::format(R"("gravity": [0, 0, 0], "cloths": [{{"name": "strip", "grid": [{}, {}], "size": [1.8, 0.2],
  "placement": {{"origin": [-0.9, 1.5, 0]}}, "stiffness": {{"stretch": 100, "shear": 20, "bend": 1e-4}}, "damping": 2,
  "self_collision": {{"thickness": {}, "friction": 0.3}}, "pins": {}}}])",
                    columns, rows, 0.3 * 0.2 / n, bars(columns, rows, keys)));
}

std::string wrung_strip(std::uint32_t frames) {
    const auto keys = [&](int side) {
        std::string text = key(0, 0, 0);
        int way = side;
        for (double time = 3; time < frames / 60.0 + 6; time += 6, way = -way)
            text += ", " + key(time, -0.05 * side, 225.0 * way);
        return text;
    };
    return scene("wrung", frames, 10,
                 fmt::format(R"("cloths": [{{"name": "strip", "grid": [25, 9], "size": [1, 0.32],
  "placement": {{"origin": [-0.5, 1.5, 0]}}, {}, "damping": 1, "self_collision": {{"thickness": 0.016, "friction": 0.3}},
  "pins": {}}}])",
                             limp, bars(25, 9, keys)));
}

std::string folding_sheet(std::uint32_t n, std::uint32_t frames, std::uint32_t substeps) {
    return scene("fold", frames, substeps, folding_parts(n));
}

std::string cut_folds(std::uint32_t n, std::uint32_t frames, std::uint32_t substeps) {
    // The blade is far larger than the folds, and aslant, so that it splits triangles of every layer.
    return scene("cut folds", frames, substeps, folding_parts(n) + R"(,
 "cutters": [{"triangle": [[-0.1, -1, -3], [0.25, -1, 3], [0.1, 5, 0]], "active": [0.7, 0.7]}])");
}

std::string falling_stack(std::uint32_t count, std::uint32_t n, std::uint32_t frames, std::uint32_t substeps,
                          std::uint32_t apart_mm) {
    std::vector<std::string> cloths;
    for (std::uint32_t k = 0; k < count; ++k) {
        const double c = std::cos(0.4 * k), s = std::sin(0.4 * k);
        cloths.push_back(fmt::format(R"({{"name": "sheet{0}", "grid": [{1}, {1}], "size": [0.7, 0.7],
  "placement": {{"origin": [{2}, {3}, {4}], "u": [{5}, 0, {6}], "v": [{7}, 0, {5}]}}, {8}, "damping": 1,
  "self_collision": {{"thickness": {9}}}}})",
                                     k, n, -0.35 * (c - s), 0.36 + 1e-3 * apart_mm * k, -0.35 * (c + s), c, s, -s, limp,
                                     0.15 * 0.7 / (n - 1)));
    }
    return scene("stack", frames, substeps,
                 fmt::format(R"("cloths": [{}], "colliders": {{"spheres": [{{"radius": 0.3, "friction": 0.4}}],
  "planes": [{{"offset": -0.3, "friction": 0.4}}]}})",
                             fmt::join(cloths, ",\n ")));
}

std::string crumpled_sheet(std::uint32_t n, std::uint32_t frames, std::uint32_t substeps) {
    return scene(
        "crumple", frames, substeps,
        fmt::format(R"("cloths": [{{"name": "sheet", "grid": [{0}, {0}], "placement": {{"origin": [-0.5, 1.02, 0],
  "u": [1, 0, 0.03], "jitter": 1e-3, "seed": 5}}, {1}, "damping": 1, "self_collision": {{"thickness": {2}}}}}],
 "colliders": {{"planes": [{{"friction": 0.6}}, {{"normal": [0, -1, 0], "offset": -1.06, "friction": 0.6,
  "path": [{{"t": 0}}, {{"t": 6, "translate": [0, -1, 0]}}]}}]}})",
                    n, limp, 0.4 / (n - 1)));
}

std::string led_sheet() {
    const auto sheet = [](std::string_view name, double x, double y, double slope, std::string_view pins) {
        return fmt::format(R"({{"name": "{}", "grid": [9, 9], "size": [0.4, 0.4], "placement":
   {{"origin": [{}, {}, {}], "u": [1, 0, 0], "v": [0, {}, 1]}}, "self_collision": {{"thickness": 0.008}}{}}})",
                           name, x, y, x, slope, pins);
    };
    return scene("led", 40, 8,
                 fmt::format(R"("gravity": [0, 0, 0], "cloths": [{},
  {}], "colliders": {{"planes": [{{}}]}})",
                             sheet("low", -0.2, -0.03, 0, ""),
                             sheet("held", -0.19, -0.022, 0.03, R"(, "pins": [{"box": [[0, 0], [8, 8]]}])")));
}

std::string collapsing_strip(std::uint32_t n, std::uint32_t frames, std::uint32_t substeps) {
    return scene("heap", frames, substeps,
                 fmt::format(R"("cloths": [{{"name": "strip", "grid": [{}, {}], "size": [0.09, 0.72],
  "placement": {{"origin": [-0.045, 0.75, 0], "u": [1, 0, 0], "v": [0, -1, 0], "jitter": 1e-5, "seed": 1}},
  "stiffness": {{"stretch": 400, "shear": 60, "bend": 2e-5}}, "damping": 1.5, "friction": 0.4,
  "self_collision": {{"thickness": 0.002}}}}], "colliders": {{"planes": [{{"friction": 0.6}}]}})",
                             n / 8 + 1, n + 1));
}

}  // namespace drape::test
