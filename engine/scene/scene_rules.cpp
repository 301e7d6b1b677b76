#include "scene/scene_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drape/error.h"
#include "drape/scene_reader.h"
#include "scene/oracle_kinds.h"

namespace drape {
namespace {

/// Returns twice the area over the square of the longest edge: 0 for points on a line, 0.87 for equal edges.
double shape_quality(const std::array<Vec3, 3>& t) {
    const auto edge = [&](std::size_t a, std::size_t b) {
        return Vec3{t[b][0] - t[a][0], t[b][1] - t[a][1], t[b][2] - t[a][2]};
    };
    const auto squared = [](const Vec3& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; };
    const Vec3 u = edge(0, 1), v = edge(0, 2);
    const Vec3 normal{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double longest = std::max({squared(u), squared(v), squared(edge(1, 2))});
    return longest > 0 ? std::sqrt(squared(normal)) / longest : 0;
}

constexpr std::string_view one_key = "an array of at least 1 key";
constexpr std::size_t most_keys = 1'000'000;

/// Reports each key of the list at `node` that is not after the one before it.
template <class Key>
bool times_increase(const SceneNode& node, const std::vector<Key>& keys) {
    bool fits = true;
    for (std::size_t i = 1; i < keys.size(); ++i) {
        const SceneNode time = node.element(i).member("t");
        const double before = keys[i - 1].time;
        if (time.is_number() && node.element(i - 1).member("t").is_number() && keys[i].time <= before)
            fits = time.fail_expected(fmt::format("a time after the previous key's {}", before));
    }
    return fits;
}

}  // namespace

template <class Key>
Value<std::vector<Key>> keys_in_time(const Value<Key>& key) {
    Value<std::vector<Key>> keys = list(key, one_key, 1, most_keys);
    keys.write = nullptr;  // an empty list is no value: without keys nothing changes
    keys.read = [read = keys.read](const SceneNode& node, std::vector<Key>& field) {
        const bool fits = read(node, field);
        return times_increase(node, field) && fits;
    };
    return keys;
}
template Value<std::vector<VectorKey>> keys_in_time(const Value<VectorKey>&);
template Value<std::vector<NumberKey>> keys_in_time(const Value<NumberKey>&);
template Value<std::vector<FactorKey>> keys_in_time(const Value<FactorKey>&);
template Value<std::vector<CameraKey>> keys_in_time(const Value<CameraKey>&);

Value<MotionPath> motion_path(const Value<MotionKey>& key) {
    const Value<std::vector<MotionKey>> keys = list(key, one_key, 1, most_keys);
    return {keys.text, [keys](const SceneNode& node, MotionPath& path) {
                const bool fits = keys.read(node, path.keys);
                return times_increase(node, path.keys) && fits;
            }};
}

Value<Stiffness> rigid_or(const Value<Stiffness>& springs) {
    Value<Stiffness> value = springs;
    value.text.schema = "\"anyOf\": [{\"const\": \"rigid\"}, {" + springs.text.schema + "}]";
    value.text.words = "`\"rigid\"` or " + springs.text.words;
    value.read = [springs](const SceneNode& node, Stiffness& stiffness) {
        if (!node || node.value()->isObject()) return springs.read(node, stiffness);
        stiffness.rigid = node.value()->isString() && *node.value() == "rigid";
        return stiffness.rigid || node.fail_expected("\"rigid\" or an object");
    };
    return value;
}

template <class Each>
Value<Each> number_or(const Value<Each>& apart) {
    Value<Each> value;
    value.text = {"\"anyOf\": [{" + not_negative.schema() + "}, {" + apart.text.schema + "}]",
                  not_negative.words() + " or " + apart.text.words, apart.text.uses};
    value.read = [apart](const SceneNode& node, Each& field) {
        if (!node || node.value()->isObject()) return apart.read(node, field);
        double all = 0;
        if (!node.read(all, not_negative)) return false;
        field = all;
        return true;
    };
    value.write = [](const Each& field) { return directions_text(field); };
    return value;
}
template Value<WarpWeft> number_or(const Value<WarpWeft>&);
template Value<Rigidity> number_or(const Value<Rigidity>&);

bool set_twist(const Members& members, Rigidity& rigidity) {
    if (!members["twist"]) rigidity.twist = std::sqrt(rigidity.warp * rigidity.weft);
    return true;
}

Value<std::optional<SelfCollision>> true_or(const Value<SelfCollision>& object) {
    Value<std::optional<SelfCollision>> value;
    value.text = {"\"anyOf\": [{\"type\": \"boolean\"}, {" + object.text.schema + "}]",
                  "`true`, `false` or " + object.text.words, object.text.uses};
    value.read = [object](const SceneNode& node, std::optional<SelfCollision>& field) {
        if (!node) return true;
        if (!node.value()->isBool() && !node.value()->isObject()) return node.fail_expected("true, false or an object");
        field.reset();
        if (node.value()->isBool() && !node.value()->asBool()) return true;
        field.emplace();
        return node.value()->isBool() || object.read(node, *field);
    };
    value.write = [](const std::optional<SelfCollision>& field) { return field ? "true" : "false"; };
    return value;
}

Value<std::array<Vec3, 3>> triangle(const Value<Vec3>& point) {
    return {{"\"type\": \"array\", \"items\": {" + point.text.schema + "}, \"minItems\": 3, \"maxItems\": 3",
             "array of 3 points", point.text.uses},
            [point](const SceneNode& node, std::array<Vec3, 3>& corners) {
                if (!node.open_array("an array of 3 points", 3, 3)) return !node;
                bool fits = true;
                for (std::size_t i = 0; i < 3; ++i) fits = point.read(node.element(i), corners[i]) && fits;
                // Single precision keeps seven digits: a flatter triangle has no plane there.
                if (fits && shape_quality(corners) < 1e-5)
                    return node.fail("expected a triangle with an area, got a degenerate one");
                return fits;
            }};
}

ValueText how_much_of_forces() {
    return {R"("anyOf": [{"type": "boolean"}, {"enum": ["worst", "fields"]}])",
            "`true`, `false`, `\"worst\"` or `\"fields\"`"};
}

bool read_forces(const SceneNode& node, SceneDescription& scene) {
    if (!node) return true;
    scene.force_fields = node.value()->isString() && *node.value() == "fields";
    scene.worst_forces = scene.force_fields || (node.value()->isString() && *node.value() == "worst");
    scene.forces = scene.worst_forces;
    if (scene.worst_forces) return true;
    if (!node.value()->isBool()) return node.fail_expected("true, false, \"worst\" or \"fields\"");
    return node.read(scene.forces);
}

bool check_cutter_times(const SceneNode& node, Cutter& cutter) {
    std::array<double, 2> times{};
    if (!two_numbers(not_negative).read(node, times)) return false;
    cutter.begin = times[0];
    cutter.end = times[1];
    return times[0] <= times[1] || node.fail("expected an end that is not before the beginning");
}

bool check_wind(const Members& members, Wind& wind) {
    if (members["velocity"] && members["keys"])
        members["velocity"].warn("velocity is ignored beside keys, which have the wind's");
    if (members.fit({"velocity", "keys"}) && !wind.blows() && wind.gust.amplitude > 0.0)
        members["gust"].warn("the gust does nothing: it blows along the wind's velocity, which is zero");
    return true;
}

bool check_solver(const Members& members, SolverSettings& solver) {
    const bool is_automatic = solver.method == SolverMethod::automatic;
    const SolverMethodName& method = named(solver.method);
    for (const std::string_view key : {"substeps", "iterations"})
        if (is_automatic && members[key] && members.fit({key}))
            members[key].warn(fmt::format("{} is ignored by method auto, which chooses: name a method to set it", key));
    if (!method.iterates() && !is_automatic && solver.iterations > 1)
        members["iterations"].warn(
            fmt::format("iterations is ignored by method {}: {}", method.name, method.ignores_iterations));
    if (members["strain_damping"] && members.fit({"strain_damping"}) && !method.damps_strain && !is_automatic)
        members["strain_damping"].warn(fmt::format("strain_damping is ignored by method {}", method.name));
    return true;
}

bool check_camera(const Members& members, Camera& camera) {
    for (const std::string_view key : {"position", "target"})
        if (members["keys"] && members[key])
            members[key].warn(fmt::format("{} is ignored beside keys, which have the camera's", key));
    if (!members.fit({"position", "target"}) || camera.position != camera.target) return true;
    return members.object().fail("expected a target away from the camera's position, got the same point");
}

bool check_camera_key(const Members& members, CameraKey& key) {
    if (!members.all_fit() || key.position != key.target) return true;
    return members.object().fail("expected a target away from the camera's position, got the same point");
}

bool check_appearance(const Members& members, Appearance& appearance) {
    const SceneNode texture = members["texture"];
    if (!texture || !members.fit({"texture"})) return true;
    appearance.texture = texture.file(appearance.texture).string();
    try {
        read_file(appearance);
    } catch (const Error& error) {
        return texture.fail(error.what());
    }
    return true;
}

bool check_hem(const Members& members, const Cloth& cloth) {
    const double hem = cloth.appearance.hem;
    const SceneNode node = members["appearance"].member("hem");
    if (hem == 0 || !node) return true;
    if (!cloth.panel.empty()) return node.fail("expected no hem of a cloth with an outline, got one");
    const double most = 0.25 * std::min(cloth.size[0], cloth.size[1]);
    if (hem <= most) return true;
    return node.fail(
        fmt::format("expected at most a quarter of the cloth's shorter side, {:.6g} m, got {:.6g}", most, hem));
}

Value<std::string> check_name() {
    std::string names;
    for (const OracleKind& kind : oracle_kinds()) names += (names.empty() ? "" : ", ") + quoted(kind.name);
    return {{"\"enum\": [" + names + "]", "a [check](#oracles)"}, [](const SceneNode& node, std::string& name) {
                if (!node.value()->isString()) return node.fail_expected("the name of a check");
                name = node.value()->asString();
                if (find_oracle_kind(name)) return true;
                const std::string_view nearest = oracle_names().nearest_key(name);
                std::string all;
                for (const OracleKind& kind : oracle_kinds()) all += (all.empty() ? "" : ", ") + std::string(kind.name);
                return node.fail_expected(nearest.empty() ? "the name of a check, one of " + all
                                                          : "the name of a check, perhaps " + quoted(nearest));
            }};
}

bool read_oracle_limits(const Members& members, Oracle& oracle) {
    const OracleKind* kind = find_oracle_kind(oracle.check);
    if (!kind) return true;  // it was reported already
    const SceneNode& object = members.object();
    bool fits = object.open_object(oracle_definition(*kind));
    for (const OracleLimit& limit : kind->limits) {
        const SceneNode node = members[limit.name];
        double value = 0;
        std::uint32_t count = 0;
        if (!node)
            fits = object.fail(
                fmt::format("expected the limit {} of check {}: {}", quoted(limit.name), kind->name, limit.help));
        else if (limit.counts ? node.read(count, 0, 0xFFFFFFFFu) : node.read(value, any_number))
            oracle.limits.emplace_back(limit.name, limit.counts ? count : value);
        else
            fits = false;
    }
    return fits;
}

void check_oracles(const SceneNode& node, const SceneDescription& scene) {
    if (!node) return;
    for (std::size_t i = 0; i < scene.oracles.size(); ++i) {
        const Oracle& oracle = scene.oracles[i];
        const OracleKind* kind = find_oracle_kind(oracle.check);
        if (!kind) continue;
        const SceneNode element = node.element(i);
        if (const std::string_view lack = kind->obstacle(scene); !lack.empty())
            element.warn(fmt::format("check {} says nothing here: {}", kind->name, lack));
        for (const auto& [name, value] : oracle.limits) {
            if (name == "cloth" && value >= static_cast<double>(scene.cloths.size()))
                element.member(name).fail_expected(
                    fmt::format("the number of one of the {} cloths, from 0", scene.cloths.size()));
            if ((name == "from_frame" || name == "until_frame") && value >= scene.time.frame_count)
                element.member(name).warn(fmt::format("the scene's last frame is {}", scene.time.frame_count - 1));
        }
    }
}

}  // namespace drape
