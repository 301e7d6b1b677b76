#include "world/weather.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/vectors.h"

namespace drape {
namespace {

Vec3 strongest(const std::vector<VectorKey>& keys, const Vec3& steady) {
    if (keys.empty()) return steady;
    return std::ranges::max(keys, {}, [](const VectorKey& key) { return length(key.value); }).value;
}

/// The keys on both sides of a time, and the time's share of the interval between them; beyond an end, its key is on
/// both sides.
template <class Key>
struct Around {
    const Key &from, &to;
    double share;
};

template <class Key>
Around<Key> around(const std::vector<Key>& keys, double time) {
    const auto later = std::ranges::upper_bound(keys, time, {}, &Key::time);
    if (later == keys.begin()) return {keys.front(), keys.front(), 0};
    const Key& from = later[-1];
    if (later == keys.end()) return {from, from, 0};
    return {from, *later, (time - from.time) / (later->time - from.time)};
}

/// Returns whether the value that keys have (`at`) is the same from one time to another.
template <class Key, class Value>
bool keeps(const std::vector<Key>& keys, double from, double to, const Value& at) {
    if (keys.empty()) return true;
    const auto first = at(from);
    return first == at(to) && std::ranges::all_of(keys, [&](const Key& key) {
               return key.time <= from || key.time >= to || key.value == first;
           });
}

}  // namespace

Vec3 value_at(const std::vector<VectorKey>& keys, const Vec3& steady, double time) {
    if (keys.empty()) return steady;
    const auto [from, to, share] = around(keys, time);
    Vec3 value;
    for (std::size_t k = 0; k < 3; ++k) value[k] = from.value[k] + share * (to.value[k] - from.value[k]);
    return value;
}

double value_at(const std::vector<NumberKey>& keys, double steady, double time) {
    if (keys.empty()) return steady;
    const auto [from, to, share] = around(keys, time);
    return from.value + share * (to.value - from.value);
}

Vec3 force_at(const Load& load, double time) { return value_at(load.force_keys, load.force, time); }

double pressure_at(const Load& load, double time) {
    return value_at(load.pressure_keys, load.pressure.value_or(0), time);
}

double strongest(const Load& load) {
    if (!load.presses()) return length(strongest(load.force_keys, load.force));
    double most = load.pressure_keys.empty() ? std::abs(*load.pressure) : 0;
    for (const NumberKey& key : load.pressure_keys) most = std::max(most, std::abs(key.value));
    return most;
}

double stiffness_factor(const SceneDescription& scene, const Cloth& cloth, std::uint32_t frame) {
    if (cloth.stiffness_keys.empty()) return 1;
    const double middle = frame == 0 ? 0 : (frame - 0.5) / scene.time.fps;
    const auto [from, to, share] = around(cloth.stiffness_keys, middle);
    return from.factor + share * (to.factor - from.factor);
}

bool is_steady(const std::vector<VectorKey>& keys, double from, double to) {
    return keeps(keys, from, to, [&](double time) { return value_at(keys, {}, time); });
}

bool is_steady(const std::vector<NumberKey>& keys, double from, double to) {
    return keeps(keys, from, to, [&](double time) { return value_at(keys, 0, time); });
}

Vec3 gravity_at(const SceneDescription& scene, double time) {
    return value_at(scene.gravity_keys, scene.gravity, time);
}

bool gravity_changes(const SceneDescription& scene) {
    return std::ranges::adjacent_find(scene.gravity_keys, std::ranges::not_equal_to(), &VectorKey::value) !=
           scene.gravity_keys.end();
}

bool has_weather(const SceneDescription& scene) {
    return scene.wind.blows() || gravity_changes(scene) || !scene.gas.empty() ||
           std::ranges::any_of(scene.cloths, [](const Cloth& cloth) { return !cloth.loads.empty(); });
}

Vec3 strongest_gravity(const SceneDescription& scene) { return strongest(scene.gravity_keys, scene.gravity); }

double fastest_steady_wind(const Wind& wind) {
    const Vec3 fastest = strongest(wind.keys, wind.velocity);
    return std::hypot(fastest[0], fastest[1], fastest[2]);
}

double fastest_wind(const Wind& wind) {
    return wind.blows() ? fastest_steady_wind(wind) + std::abs(wind.gust.amplitude) : 0;
}

bool weather_stays(const SceneDescription& scene, double from, double to) {
    if (has_weather(scene) && scene.wind.gust.amplitude != 0) return false;
    for (const Cloth& cloth : scene.cloths)
        for (const Load& load : cloth.loads)
            if (!is_steady(load.force_keys, from, to) || !is_steady(load.pressure_keys, from, to)) return false;
    for (const Gas& gas : scene.gas)
        if (!is_steady(gas.volume_keys, from, to)) return false;
    return is_steady(scene.wind.keys, from, to) && is_steady(scene.gravity_keys, from, to);
}

}  // namespace drape
