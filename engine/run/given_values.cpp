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

/// Returns the last of a scene's actions until a frame that tells something; null: none does.
template <class List>
const List* last_told(const SceneActions& actions, std::uint32_t frame, List FrameActions::*list) {
    const List* found = nullptr;
    for (const FrameActions& step : actions.steps) {
        if (step.frame > frame) break;
        if (!(step.*list).empty()) found = &(step.*list);
    }
    return found;
}

/// Adds what no path or key of the scene tells of its actions.
void add_actions(const SceneDescription& scene, std::uint32_t frame, FrameValues& values) {
    const SceneActions& actions = *scene.actions;
    Given given(values, "");
    const auto add_six = [&](const std::string& name, const SixNumbers& six, const char* first, const char* second,
                             const char* unit, const char* unit_about) {
        given.add(name + first, {six[0], six[1], six[2]}, unit);
        given.add(name + second, {six[3], six[4], six[5]}, unit_about);
    };
    if (const auto* const hands = last_told(actions, frame, &FrameActions::hands))
        for (std::size_t k = 0; k < hands->size(); ++k)
            add_six(fmt::format("hands_{}", k), (*hands)[k], "_translate", "_rotate", "m", "deg");
    const auto* const grasps = last_told(actions, frame, &FrameActions::grasps);
    for (std::size_t k = 0; k < actions.controls.hands.size(); ++k)
        given.add(fmt::format("hands_{}_hold", k), grasps && (*grasps)[k][0] >= 0 ? 1 : 0);
    if (const auto* const forces = last_told(actions, frame, &FrameActions::body_forces))
        for (std::size_t k = 0; k < forces->size(); ++k)
            add_six(fmt::format("body_{}", k), (*forces)[k], "_force", "_moment", "n", "n_m");
    const auto* const holds = last_told(actions, frame, &FrameActions::holds);
    std::size_t pin = 0;
    for (const Cloth& cloth : scene.cloths)
        for (std::size_t k = 0; k < cloth.pins.size(); ++k, ++pin)
            if (holds) values[fmt::format("{}/given_pins_{}_hold", cloth.name, k)] = (*holds)[pin] ? 1 : 0;
    for (const FrameActions& step : actions.steps)
        for (std::size_t k = 0; step.frame == frame && k < step.body_impulses.size(); ++k)
            add_six(fmt::format("body_{}", k), step.body_impulses[k], "_impulse", "_twist", "n_s", "n_m_s");
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
    if (scene.actions) add_actions(scene, frame, values);
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
