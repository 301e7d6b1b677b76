#include "small_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <numbers>
#include <vector>

#include "drape/scene.h"

namespace drape::fuzz {

namespace {

std::string text_of(const Vec3& v) { return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", v[0], v[1], v[2]); }

std::string list_of(const std::vector<std::string>& items) { return fmt::format("[{}]", fmt::join(items, ", ")); }

Vec3 vector(Dice& dice, double most) {
    Vec3 v;
    for (double& each : v) each = dice.uniform(-most, most);
    return v;
}

/// Draws mostly from a range that cloths know, now and then far beyond it.
double number(Dice& dice, double low, double high) {
    if (!dice.chance(0.04)) return dice.log_uniform(low, high);
    constexpr double extremes[] = {1e-30, 1e-9, 1e-4, 1e4, 1e9, 1e30};
    return extremes[dice.below(std::size(extremes))];
}

const char* one_of(Dice& dice, std::initializer_list<const char*> words) {
    return words.begin()[dice.below(static_cast<std::uint32_t>(words.size()))];
}

std::string path(Dice& dice, double seconds) {
    std::vector<std::string> keys;
    double time = dice.chance(0.5) ? 0 : dice.uniform(0, 0.5 * seconds);
    const std::uint32_t count = 2 + dice.below(2);
    for (std::uint32_t k = 0; k < count; ++k) {
        const Vec3 translate = vector(dice, dice.chance(0.05) ? 50 : 0.2);
        const Vec3 rotate = dice.chance(0.5) ? Vec3{} : vector(dice, 200);
        keys.push_back(fmt::format(R"({{"t": {:.9g}, "translate": {}, "rotate": {}}})", time, text_of(translate),
                                   text_of(rotate)));
        time += dice.uniform(0.1, 1) * seconds;
    }
    return list_of(keys);
}

std::string box(Dice& dice, const std::array<std::uint32_t, 2>& grid) {
    std::uint32_t first[2], last[2];
    for (int k = 0; k < 2; ++k) {
        first[k] = dice.below(grid[k]);
        last[k] = first[k] + dice.below(grid[k] - first[k]);
    }
    return fmt::format("[[{}, {}], [{}, {}]]", first[0], first[1], last[0], last[1]);
}

std::string pin(Dice& dice, const std::array<std::uint32_t, 2>& grid, double seconds) {
    std::string text;
    switch (dice.below(4)) {
        case 0:
            text = fmt::format(R"("edge": "{}")", one_of(dice, {"left", "right", "top", "bottom"}));
            break;
        case 1:
            text = fmt::format(R"("corner": "{}")",
                               one_of(dice, {"top_left", "top_right", "bottom_left", "bottom_right"}));
            break;
        case 2: {
            const std::uint32_t column = dice.below(grid[0]), row = dice.below(grid[1]);
            text = fmt::format(R"("at": [{}, {}])", column, row);
            break;
        }
        default:
            text = R"("box": )" + box(dice, grid);
    }
    if (dice.chance(0.3)) text += fmt::format(R"(, "release": {:.9g})", dice.uniform(0, seconds));
    if (dice.chance(0.3)) text += R"(, "path": )" + path(dice, seconds);
    if (dice.chance(0.1)) text += R"(, "pivot": )" + text_of(vector(dice, 1));
    return "{" + text + "}";
}

std::string placement(Dice& dice) {
    const double turn = 2 * std::numbers::pi * dice.below(16) / 16, tilt = 2 * std::numbers::pi * dice.below(16) / 16;
    const Vec3 u{std::cos(turn), 0, std::sin(turn)},
        v{-std::sin(turn) * std::sin(tilt), -std::cos(tilt), std::cos(turn) * std::sin(tilt)};
    std::string text =
        fmt::format(R"("origin": {}, "u": {}, "v": {})", text_of(vector(dice, 0.3)), text_of(u), text_of(v));
    if (dice.chance(0.15)) {
        const double along_u = dice.uniform(-1, 2), along_v = dice.chance(0.3) ? 0 : dice.uniform(0, 1.5);
        text += fmt::format(R"(, "scale": [{:.9g}, {:.9g}])", along_u, along_v);
    }
    if (dice.chance(0.25)) text += fmt::format(R"(, "jitter": {:.9g})", dice.log_uniform(1e-5, 0.05));
    return "{" + text + "}";
}

std::string stiffness(Dice& dice) {
    if (dice.chance(0.15)) return "\"rigid\"";
    const double stretch = dice.chance(0.05) ? 0 : number(dice, 1, 1e5),
                 shear = dice.chance(0.1) ? 0 : number(dice, 0.1, 1e4),
                 bend = dice.chance(0.5) ? 0 : number(dice, 1e-8, 1e-2);
    return fmt::format(R"({{"stretch": {:.9g}, "shear": {:.9g}, "bend": {:.9g}}})", stretch, shear, bend);
}

std::string cloth(Dice& dice, const SmallScene& limits, double seconds, bool meets) {
    const std::uint32_t columns = 2 + dice.below(limits.longest_side - 1),
                        rows = 2 + dice.below(limits.longest_side - 1);
    const std::array<std::uint32_t, 2> grid{columns, rows};
    const double cell = number(dice, 0.01, 0.3), aspect = dice.chance(0.7) ? 1 : dice.log_uniform(0.3, 3);
    std::string text = fmt::format(R"("grid": [{}, {}], "size": [{:.9g}, {:.9g}], "placement": {})", columns, rows,
                                   cell * (columns - 1), cell * aspect * (rows - 1), placement(dice));
    text += fmt::format(R"(, "areal_density": {:.9g}, "stiffness": {})", number(dice, 0.02, 2), stiffness(dice));
    if (dice.chance(0.4)) text += fmt::format(R"(, "damping": {:.9g})", number(dice, 0.01, 10));
    if (dice.chance(0.5)) text += fmt::format(R"(, "friction": {:.9g})", dice.uniform(0, 1.5));
    if (dice.chance(0.5)) text += fmt::format(R"(, "thickness": {:.9g})", dice.uniform(0, 0.3 * cell));
    if (dice.chance(0.3)) text += R"(, "contact": "particles")";
    if (meets) text += R"(, "self_collision": true)";
    if (dice.chance(0.3)) text += R"(, "velocity": )" + text_of(vector(dice, dice.chance(0.1) ? 100 : 3));
    std::vector<std::string> holes, pins;
    for (std::uint32_t k = dice.chance(0.3) ? 1 + dice.below(2) : 0; k > 0; --k) holes.push_back(box(dice, grid));
    for (std::uint32_t k = dice.chance(0.75) ? 1 + dice.below(3) : 0; k > 0; --k)
        pins.push_back(pin(dice, grid, seconds));
    return fmt::format(R"({{{}, "holes": {}, "pins": {}}})", text, list_of(holes), list_of(pins));
}

std::string collider_shape(Dice& dice, std::uint32_t kind) {
    const Vec3 place = vector(dice, 0.5);
    const auto side = [&] { return number(dice, 0.03, 0.6); };
    const double a = side(), b = side(), c = side();
    switch (kind) {
        case 0: {
            const Vec3 normal = vector(dice, 1);
            return fmt::format(R"("normal": {}, "offset": {:.9g})", text_of(normal), dice.uniform(-1, 0.2));
        }
        case 1:
            return fmt::format(R"("center": {}, "radius": {:.9g})", text_of(place), a);
        case 2:
            return fmt::format(R"("center": {}, "half_extents": {})", text_of(place), text_of({a, b, c}));
        case 3:
            return fmt::format(R"("center": {}, "radii": {})", text_of(place), text_of({a, b, c}));
        default:
            return fmt::format(R"("from": {}, "to": {}, "radii": [{:.9g}, {:.9g}])", text_of(place),
                               text_of(vector(dice, 0.5)), a, b);
    }
}

std::string colliders(Dice& dice, double seconds) {
    std::array<std::vector<std::string>, std::size(collider_lists) - 1> lists;  // all but meshes, which are files
    for (std::uint32_t k = dice.chance(0.5) ? 1 + dice.below(3) : 0; k > 0; --k) {
        const std::uint32_t kind = dice.below(static_cast<std::uint32_t>(lists.size()));
        std::string text = collider_shape(dice, kind);
        if (dice.chance(0.5)) text += fmt::format(R"(, "friction": {:.9g})", dice.uniform(0, 1.5));
        if (dice.chance(0.4)) text += R"(, "rotate": )" + text_of(vector(dice, 180));
        if (dice.chance(0.4)) text += R"(, "path": )" + path(dice, seconds);
        lists[kind].push_back("{" + text + "}");
    }
    std::vector<std::string> items;
    for (std::size_t kind = 0; kind < lists.size(); ++kind)
        if (!lists[kind].empty())
            items.push_back(fmt::format(R"("{}": {})", collider_lists[kind], list_of(lists[kind])));
    return fmt::format("{{{}}}", fmt::join(items, ", "));
}

std::string cutters(Dice& dice, double seconds) {
    std::vector<std::string> all;
    for (std::uint32_t k = dice.chance(0.3) ? 1 + dice.below(3) : 0; k > 0; --k) {
        const Vec3 a = vector(dice, 1), b = vector(dice, 1), c = vector(dice, 1);
        const double begin = dice.uniform(0, seconds), length = dice.uniform(0, seconds);
        std::string text = fmt::format(R"("triangle": [{}, {}, {}], "active": [{:.9g}, {:.9g}])", text_of(a),
                                       text_of(b), text_of(c), begin, begin + length);
        if (dice.chance(0.5)) text += R"(, "path": )" + path(dice, seconds);
        all.push_back("{" + text + "}");
    }
    return list_of(all);
}

std::string wind(Dice& dice) {
    if (dice.chance(0.6)) return "{}";
    const double speed = dice.log_uniform(0.1, 60);
    std::string text = R"("velocity": )" + text_of(vector(dice, speed));
    if (dice.chance(0.5)) {
        const double amplitude = dice.uniform(0, speed), period = number(dice, 0.01, 3);
        text += fmt::format(R"(, "gust": {{"amplitude": {:.9g}, "period": {:.9g}, "seed": {}}})", amplitude, period,
                            dice.byte());
    }
    if (dice.chance(0.3)) text += fmt::format(R"(, "drag": {:.9g})", number(dice, 0.1, 3));
    if (dice.chance(0.3)) text += fmt::format(R"(, "lift": {:.9g})", number(dice, 0.1, 3));
    return "{" + text + "}";
}

std::string solver(Dice& dice, const SmallScene& limits) {
    const char* method = one_of(dice, {"relax", "explicit", "line"});
    std::string text = fmt::format(R"("method": "{}", "substeps": {})", method, 1 + dice.below(limits.substeps));
    if (dice.chance(0.4)) text += fmt::format(R"(, "iterations": {})", 1 + dice.below(4));
    if (dice.chance(0.3)) text += R"(, "collide": "substep")";
    if (dice.chance(0.2)) text += fmt::format(R"(, "tolerance": {:.9g})", dice.log_uniform(1e-5, 1));
    if (dice.chance(0.25)) text += R"(, "tethers": true)";
    if (dice.chance(0.3)) text += fmt::format(R"(, "strain_damping": {:.9g})", dice.uniform(0, 1));
    return "{" + text + "}";
}

}  // namespace

std::string small_scene(Dice& dice, const SmallScene& limits) {
    const double rates[] = {24, 60, 60, 240}, fps = rates[dice.below(4)], seconds = limits.frames / fps;
    const Vec3 gravity = dice.chance(0.7) ? Vec3{0, -9.81, 0} : vector(dice, dice.chance(0.1) ? 1000 : 20);
    const std::uint32_t count = 1 + dice.below(limits.cloths);
    const bool meets = dice.chance(0.3);
    std::vector<std::string> cloths;
    for (std::uint32_t k = 0; k < count; ++k) cloths.push_back(cloth(dice, limits, seconds, meets));
    std::string text = fmt::format(R"({{"time": {{"fps": {}, "frames": {}}}, "gravity": {}, "cloths": {})", fps,
                                   limits.frames + 1, text_of(gravity), list_of(cloths));
    text += R"(, "solver": )" + solver(dice, limits);
    text += R"(, "wind": )" + wind(dice);
    text += R"(, "colliders": )" + colliders(dice, seconds);
    if (limits.cutters) text += R"(, "cutters": )" + cutters(dice, seconds);
    return text + "}";
}

}  // namespace drape::fuzz
