#include "scene/weather.h"

#include <algorithm>
#include <functional>

#include "base/vectors.h"

namespace drape {
namespace {

Vec3 strongest(const std::vector<VectorKey>& keys, const Vec3& steady) {
    if (keys.empty()) return steady;
    return std::ranges::max(keys, {}, [](const VectorKey& key) { return length(key.value); }).value;
}

}  // namespace

Vec3 value_at(const std::vector<VectorKey>& keys, const Vec3& steady, double time) {
    if (keys.empty()) return steady;
    const auto later = std::ranges::upper_bound(keys, time, {}, &VectorKey::time);
    if (later == keys.begin()) return keys.front().value;
    const VectorKey& from = later[-1];
    if (later == keys.end()) return from.value;
    const double share = (time - from.time) / (later->time - from.time);
    Vec3 value;
    for (std::size_t k = 0; k < 3; ++k) value[k] = from.value[k] + share * (later->value[k] - from.value[k]);
    return value;
}

bool is_steady(const std::vector<VectorKey>& keys, double from, double to) {
    if (keys.empty()) return true;
    const Vec3 first = value_at(keys, {}, from);
    return first == value_at(keys, {}, to) && std::ranges::all_of(keys, [&](const VectorKey& key) {
               return key.time <= from || key.time >= to || key.value == first;
           });
}

Vec3 gravity_at(const SceneDescription& scene, double time) {
    return value_at(scene.gravity_keys, scene.gravity, time);
}

bool gravity_changes(const SceneDescription& scene) {
    return std::ranges::adjacent_find(scene.gravity_keys, std::ranges::not_equal_to(), &VectorKey::value) !=
           scene.gravity_keys.end();
}

bool has_weather(const SceneDescription& scene) { return scene.wind.blows() || gravity_changes(scene); }

Vec3 strongest_gravity(const SceneDescription& scene) { return strongest(scene.gravity_keys, scene.gravity); }

Vec3 strongest_wind(const Wind& wind) { return strongest(wind.keys, wind.velocity); }

}  // namespace drape
