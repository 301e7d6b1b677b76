// Writes what a scene is told as its text has it: each number by the fewest digits that read back as the same.
#include <fmt/format.h>

#include <cmath>

#include "drape/scene_reader.h"
#include "scene/scene_value.h"

namespace drape {
namespace {

/// JSON libraries take -0 for an integer, which has no such sign.
std::string text_of(double number) { return number == 0 && std::signbit(number) ? "-0.0" : fmt::format("{}", number); }
std::string text_of(std::int32_t number) { return fmt::format("{}", number); }
std::string text_of(bool flag) { return flag ? "true" : "false"; }

template <class List>
std::string text_of(const List& list) {
    std::string text;
    for (const auto& each : list) text += (text.empty() ? "" : ", ") + text_of(each);
    return "[" + text + "]";
}

/// The keys of an object, one after another.
class Keys {
  public:
    void add(std::string_view name, const std::string& value) {
        text_ += (text_.empty() ? "" : ", ") + drape::quoted(name) + ": " + value;
    }
    template <class T>
    void add_list(std::string_view name, const std::vector<T>& list) {
        if (!list.empty()) add(name, text_of(list));
    }
    std::string text() const { return "{" + text_ + "}"; }

  private:
    std::string text_;
};

std::string text_of(const FrameActions& step) {
    Keys keys;
    keys.add("frame", fmt::format("{}", step.frame));
    if (step.wind) keys.add("wind", text_of(*step.wind));
    if (step.gravity) keys.add("gravity", text_of(*step.gravity));
    keys.add_list("pins", step.pins);
    keys.add_list("colliders", step.colliders);
    keys.add_list("holds", step.holds);
    keys.add_list("loads", step.loads);
    keys.add_list("hands", step.hands);
    keys.add_list("grasps", step.grasps);
    keys.add_list("body_forces", step.body_forces);
    keys.add_list("body_impulses", step.body_impulses);
    keys.add_list("body_velocities", step.body_velocities);
    keys.add_list("body_sets", step.body_sets);
    return keys.text();
}

/// Returns the text of actions before a scene's last frame.
std::string text_of(const SceneActions& actions, const SceneDescription& scene) {
    std::string controls, hands, steps;
    const auto add = [](std::string& all, const std::string& more) { all += (all.empty() ? "" : ", ") + more; };
    for (const auto& control : control_spellings)
        if (actions.controls.*control.value) add(controls, drape::quoted(control.name));
    for (const std::size_t cloth : actions.controls.hands) {
        if (cloth >= scene.cloths.size()) throw Error(fmt::format("a hand takes cloth {}, which is none", cloth));
        add(hands, drape::quoted(scene.cloths[cloth].name));
    }
    for (const FrameActions& step : actions.steps)
        if (step.frame < scene.time.frame_count) steps += (steps.empty() ? "\n" : ",\n") + text_of(step);
    return fmt::format("{{\"controls\": [{}], \"hands\": [{}], \"steps\": [{}]}}", controls, hands, steps);
}

}  // namespace

std::string scene_with_actions(std::string_view text, const SceneActions& actions, std::uint32_t last,
                               std::span<const std::string> overrides, const std::string& folder) {
    std::vector<std::string> all(overrides.begin(), overrides.end());
    all.push_back(fmt::format("/time/frames={}", last + 1));
    const auto checked = [&](const std::string& json) {
        SceneResult result = read_scene_text(json, "scene", {}, folder);
        if (!result.scene) throw SceneFailure(std::move(result));
        return *result.scene;
    };
    std::string json = resolved_scene(text, all, folder);
    const SceneDescription scene = checked(json);
    if (scene.actions) throw Error("the scene has actions already");
    json.erase(json.rfind('}'));
    json += fmt::format(",\n\"actions\": {}}}\n", text_of(actions, scene));
    checked(json);
    return json;
}

}  // namespace drape
