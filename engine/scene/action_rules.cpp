// The rules of what a scene is told while it is simulated, as far as the scene's text tells them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/scene_rules.h"

namespace drape {
namespace {

constexpr std::string_view three_or_six = "an array of 3 or 6 numbers";
constexpr std::string_view grasp_words = "[column, row] or [column, row, column, row], or -1 of each";

/// It is something that a step may be told, with the control that it needs and how many entries it has.
struct List {
    std::string_view name, control;
    std::size_t told, expected;
};

std::size_t sum_over(const std::vector<Cloth>& cloths, const auto& count) {
    std::size_t sum = 0;
    for (const Cloth& cloth : cloths) sum += count(cloth);
    return sum;
}

std::vector<List> lists_of(const FrameActions& step, const SceneDescription& scene) {
    const std::size_t pins = sum_over(scene.cloths, [](const Cloth& cloth) { return cloth.pins.size(); });
    const std::size_t loads = sum_over(scene.cloths, [](const Cloth& cloth) { return cloth.loads.size(); });
    const std::size_t hands = scene.actions->controls.hands.size();
    const auto bodies = static_cast<std::size_t>(
        std::ranges::count_if(scene.colliders, [](const Collider& each) { return each.mass.has_value(); }));
    return {{"pins", "pins", step.pins.size(), pins},
            {"colliders", "colliders", step.colliders.size(), scene.colliders.size()},
            {"holds", "holds", step.holds.size(), pins},
            {"loads", "loads", step.loads.size(), loads},
            {"hands", "hands", step.hands.size(), hands},
            {"grasps", "hands", step.grasps.size(), hands},
            {"body_forces", "bodies", step.body_forces.size(), bodies},
            {"body_impulses", "bodies", step.body_impulses.size(), bodies},
            {"body_velocities", "bodies", step.body_velocities.size(), bodies},
            {"body_sets", "bodies", step.body_sets.size(), bodies}};
}

bool is_control(const EnsembleControls& controls, std::string_view name) {
    if (name == "hands") return !controls.hands.empty();
    for (const auto& control : control_spellings)
        if (control.name == name) return controls.*control.value;
    return false;
}

bool check_control(const SceneNode& told, const EnsembleControls& controls, std::string_view name) {
    if (!told || is_control(controls, name)) return true;
    return told.fail(name == "hands" ? "expected hands in actions, got none"
                                     : fmt::format("expected \"{}\" among the controls of actions, got it not", name));
}

bool check_grasps(const SceneNode& node, const FrameActions& step, const SceneDescription& scene) {
    bool fits = true;
    for (std::size_t k = 0; k < step.grasps.size(); ++k) {
        const Grasp& held = step.grasps[k];
        const Cloth& cloth = scene.cloths[scene.actions->controls.hands[k]];
        const auto columns = static_cast<std::int32_t>(cloth.grid[0]), rows = static_cast<std::int32_t>(cloth.grid[1]);
        const bool none = std::ranges::all_of(held, [](std::int32_t each) { return each == -1; });
        const bool inside = held[0] >= 0 && held[1] >= 0 && held[0] <= held[2] && held[1] <= held[3] &&
                            held[2] < columns && held[3] < rows;
        if (!none && !inside)
            fits =
                node.element(k).fail(fmt::format("expected particles of cloth \"{}\", which has {} columns and {} "
                                                 "rows, got columns {} to {} of rows {} to {}",
                                                 cloth.name, columns, rows, held[0], held[2], held[1], held[3]));
    }
    return fits;
}

bool check_pressures(const SceneNode& node, const FrameActions& step, const SceneDescription& scene) {
    std::size_t k = 0;
    bool fits = true;
    for (const Cloth& cloth : scene.cloths)
        for (const Load& load : cloth.loads) {
            if (k < step.loads.size() && load.presses() && (step.loads[k][1] != 0 || step.loads[k][2] != 0))
                fits = node.element(k).fail("expected 0, 0 after a pressure, which has no direction");
            ++k;
        }
    return fits;
}

bool check_step(const SceneNode& node, const FrameActions& step, const SceneDescription& scene) {
    const EnsembleControls& controls = scene.actions->controls;
    bool fits = check_control(node.member("wind"), controls, "wind");
    fits = check_control(node.member("gravity"), controls, "gravity") && fits;
    if (step.frame >= scene.time.frame_count)
        fits = node.member("frame").fail_expected(
            fmt::format("a frame of the scene, whose last one is {}", scene.time.frame_count - 1));
    for (const List& each : lists_of(step, scene)) {
        const SceneNode told = node.member(each.name);
        if (!check_control(told, controls, each.control))
            fits = false;
        else if (told && each.told != each.expected)
            fits = told.fail(fmt::format("expected {} entries, got {}", each.expected, each.told));
    }
    if (!step.body_sets.empty() && step.body_velocities.empty())
        fits = node.member("body_sets").fail("expected body_velocities too, got none");
    if (!fits) return false;
    fits = check_grasps(node.member("grasps"), step, scene);
    return check_pressures(node.member("loads"), step, scene) && fits;
}

bool find_cloths(const SceneNode& hands, SceneDescription& scene) {
    bool fits = true;
    for (std::size_t k = 0; hands && k < hands.size(); ++k) {
        std::string name;
        hands.element(k).read(name);
        const auto found = std::ranges::find(scene.cloths, name, &Cloth::name);
        if (found == scene.cloths.end())
            fits = hands.element(k).fail_expected("the name of a cloth");
        else
            scene.actions->controls.hands.push_back(static_cast<std::size_t>(found - scene.cloths.begin()));
    }
    return fits;
}

}  // namespace

Value<SixNumbers> three_or_six_numbers() {
    Value<SixNumbers> value;
    value.text = {"\"type\": \"array\", \"items\": {" + any_number.schema() + "}, \"minItems\": 3, \"maxItems\": 6",
                  "array of 3 or 6 numbers"};
    value.read = [](const SceneNode& node, SixNumbers& field) {
        if (!node) return true;
        if (!node.open_array(three_or_six, 3, 6)) return false;
        if (node.size() != 3 && node.size() != 6) return node.fail_expected(three_or_six);
        bool fits = true;
        for (std::size_t k = 0; k < node.size(); ++k) fits = node.element(k).read(field[k], any_number) && fits;
        return fits;
    };
    return value;
}

Value<Grasp> grasp() {
    Value<Grasp> value;
    value.text = {
        "\"type\": \"array\", \"items\": {\"type\": \"integer\", \"minimum\": -1}, \"minItems\": 2, "
        "\"maxItems\": 4",
        "array of 2 or 4 integers"};
    value.read = [](const SceneNode& node, Grasp& field) {
        if (!node) return true;
        if (!node.open_array(grasp_words, 2, 4)) return false;
        if (node.size() == 3) return node.fail_expected(grasp_words);
        for (std::size_t k = 0; k < field.size(); ++k) {
            double number = 0;
            if (!node.element(k % node.size()).read(number, {-1, grid_axis_limit, false})) return false;
            if (number != std::floor(number)) return node.element(k % node.size()).fail_expected("an integer");
            field[k] = static_cast<std::int32_t>(number);
        }
        return true;
    };
    return value;
}

Value<std::vector<bool>> flags() {
    Value<std::vector<bool>> value;
    value.text = {R"("type": "array", "items": {"type": "boolean"})", "array of `true` or `false`"};
    value.read = [](const SceneNode& node, std::vector<bool>& field) {
        if (!node.open_array("an array of true or false", 0, 1'000'000)) return !node;
        bool fits = true;
        for (std::size_t k = 0; k < node.size(); ++k) {
            bool flag = false;
            fits = node.element(k).read(flag) && fits;
            field.push_back(flag);
        }
        return fits;
    };
    return value;
}

Value<EnsembleControls> controls() {
    Value<EnsembleControls> value;
    std::string names;
    for (const auto& control : control_spellings) names += (names.empty() ? "" : ", ") + quoted(control.name);
    value.text = {"\"type\": \"array\", \"items\": {\"enum\": [" + names + "]}", "array of names"};
    value.read = [names](const SceneNode& node, EnsembleControls& field) {
        if (!node.open_array("an array of controls", 0, std::size(control_spellings))) return !node;
        bool fits = true;
        for (std::size_t k = 0; k < node.size(); ++k) {
            std::string name;
            const SceneNode element = node.element(k);
            if (element.value()->isString()) element.read(name);
            const auto* const found =
                std::ranges::find(control_spellings, name, [](const auto& each) { return each.name; });
            if (found == std::end(control_spellings))
                fits = element.fail_expected("one of " + names);
            else
                field.*found->value = true;
        }
        return fits;
    };
    return value;
}

bool read_hands(const SceneNode& node, SceneActions&) {
    std::vector<std::string> names;
    return list(text(), hand_list, 0, most_hands).read(node, names);
}

bool check_steps(const Members& members, SceneActions& actions) {
    if (!members.fit({"steps"})) return true;
    bool fits = true;
    for (std::size_t k = 1; k < actions.steps.size(); ++k)
        if (actions.steps[k].frame <= actions.steps[k - 1].frame)
            fits = members["steps"].element(k).member("frame").fail_expected(
                fmt::format("a frame after that of the entry before, {}", actions.steps[k - 1].frame));
    return fits;
}

bool check_actions(const Members& members, SceneDescription& scene) {
    const SceneNode node = members["actions"];
    if (!node || !scene.actions) return true;
    if (!find_cloths(node.member("hands"), scene)) return false;
    const EnsembleControls& controls = scene.actions->controls;
    const auto lacks = [&](bool is, const char* what) { return is || node.member("controls").fail(what); };
    bool fits = lacks(
        !controls.loads || std::ranges::any_of(scene.cloths, [](const Cloth& each) { return !each.loads.empty(); }),
        "expected loads of a cloth, of 0 N where only actions are to pull, got none");
    fits = lacks(!controls.bodies ||
                     std::ranges::any_of(scene.colliders, [](const Collider& each) { return each.mass.has_value(); }),
                 "expected a collider with a mass beside bodies, got none") &&
           fits;
    if (!scene.seams.empty() && (controls.holds || controls.gravity || !controls.hands.empty()))
        fits = node.fail(
            "expected no seams where actions let pins go, take particles or turn gravity: they do not "
            "follow these yet");
    for (std::size_t k = 0; fits && k < scene.actions->steps.size(); ++k)
        fits = check_step(node.member("steps").element(k), scene.actions->steps[k], scene);
    return fits;
}

}  // namespace drape
