#include "run/given_values.h"

#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <map>

#include "output/json_file.h"
#include "output/json_text.h"
#include "output/npy.h"
#include "world/gust.h"
#include "world/motion.h"
#include "world/weather.h"

namespace drape {

namespace {

/// Adds numbers under names that begin alike.
class Given {
  public:
    Given(FrameValues& values, std::string before) : values_(values), before_(std::move(before)) {}

    void add(const std::string& name, double value) { values_[before_ + "given_" + name] = value; }
    void add(const std::string& name, const Vec3& value, const char* unit) {
        for (std::size_t k = 0; k < 3; ++k) add(fmt::format("{}_{}_{}", name, "xyz"[k], unit), value[k]);
    }
    void add(const std::string& name, const MotionPath& path, double time) {
        if (!path.moves()) return;
        const MotionKey now = key_at(path, time);
        add(name + "_translate", now.translate, "m");
        add(name + "_rotate", now.rotate, "deg");
    }

  private:
    FrameValues& values_;
    std::string before_;
};

void add_cloth(const SceneDescription& scene, const Cloth& cloth, std::uint32_t frame, FrameValues& values) {
    const double time = frame / scene.time.fps;
    Given given(values, cloth.name + "/");
    if (!cloth.stiffness_keys.empty()) given.add("stiffness_factor", stiffness_factor(scene, cloth, frame));
    for (std::size_t k = 0; k < cloth.loads.size(); ++k) {
        const Load& load = cloth.loads[k];
        if (load.presses())
            given.add(fmt::format("load_{}_pa", k), pressure_at(load, time));
        else
            given.add(fmt::format("load_{}", k), force_at(load, time), "n");
    }
    for (std::size_t k = 0; k < cloth.pins.size(); ++k) {
        const Pin& pin = cloth.pins[k];
        given.add(fmt::format("pins_{}", k), pin.path, time);
        if (pin.release) given.add(fmt::format("pins_{}_hold", k), time < *pin.release ? 1 : 0);
    }
}

std::string set_array(const Json::Value& value) {
    const auto numbers = [&](const std::string& shape, const std::vector<double>& all) {
        return npy_array("<f8", shape, std::as_bytes(std::span(all)));
    };
    if (value.isNumeric()) return numbers("", {value.asDouble()});
    if (!value.isArray() || !std::ranges::all_of(value, [](const Json::Value& each) { return each.isNumeric(); }))
        return text_array(json_line(value));
    std::vector<double> all;
    for (const Json::Value& each : value) all.push_back(each.asDouble());
    return numbers(fmt::format("{},", all.size()), all);
}

}  // namespace

FrameValues given_values(const SceneDescription& scene, std::uint32_t frame) {
    const double time = frame / scene.time.fps;
    FrameValues values;
    Given given(values, "");
    if (scene.wind.blows()) given.add("wind", wind_velocity(scene.wind, time), "m_s");
    if (gravity_changes(scene)) given.add("gravity", gravity_at(scene, time), "m_s2");
    for (std::size_t k = 0; k < scene.colliders.size(); ++k)
        given.add(fmt::format("collider_{}_{}", k, collider_names[scene.colliders[k].shape.index()]),
                  scene.colliders[k].path, time);
    for (const Cloth& cloth : scene.cloths) add_cloth(scene, cloth, frame, values);
    return values;
}

std::vector<std::pair<std::string, std::string>> set_arrays(const std::vector<std::string>& overrides) {
    std::map<std::string, std::string> arrays;
    for (const std::string& override_ : overrides) {
        const std::size_t end = override_.find('=');
        if (end == std::string::npos) continue;
        const auto value = parse_json(override_.substr(end + 1));
        arrays["set" + override_.substr(0, end)] =
            value ? set_array(*value) : set_array(Json::Value(override_.substr(end + 1)));
    }
    return {arrays.begin(), arrays.end()};
}

}  // namespace drape
