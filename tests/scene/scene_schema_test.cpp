// The published schema agrees with the reader: same keys, same defaults, same limits. Both come from one table; these
// tests hold the published text against the reader's behaviour.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <json/json.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>

#include "drape/scene_reader.h"
#include "full_scene.h"
#include "scene/scene_format.h"
#include "world/cloth_keys.h"

namespace drape {
namespace {

Json::Value parsed(std::string_view text) {
    Json::Value value;
    std::string errors;
    const std::unique_ptr<Json::CharReader> reader(Json::CharReaderBuilder().newCharReader());
    EXPECT_TRUE(reader->parse(text.data(), text.data() + text.size(), &value, &errors)) << errors;
    return value;
}

std::string written(const Json::Value& value) {
    Json::StreamWriterBuilder builder;
    builder["precision"] = 17;
    return Json::writeString(builder, value);
}

const Json::Value& schema() {
    static const Json::Value value = parsed(scene_schema());
    return value;
}

std::vector<const Definition*> scene_objects() {
    std::vector<const Definition*> objects = scene_definitions();
    std::erase_if(objects, [](const Definition* definition) { return definition->keys.empty(); });
    return objects;
}

std::string committed(const std::string& path) {
    std::ifstream file(DRAPE_SOURCE_DIR "/" + path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

const Json::Value& object_schema(std::string_view name) {
    return name == "scene" ? schema() : schema()["definitions"][std::string(name)];
}

// Each kind of object has one place in full_scene, an outline in outlined_scene.
const std::map<std::string_view, std::string> places{{"scene", ""},
                                                     {"time", ".time"},
                                                     {"wind", ".wind"},
                                                     {"wind_key", ".wind.keys[1]"},
                                                     {"gravity_key", ".gravity_keys[1]"},
                                                     {"stiffness_key", ".cloths[3].stiffness_keys[1]"},
                                                     {"gust", ".wind.gust"},
                                                     {"cloth", ".cloths[0]"},
                                                     {"outline", ".cloths[0].outline"},
                                                     {"placement", ".cloths[0].placement"},
                                                     {"self_collision", ".cloths[0].self_collision"},
                                                     {"stiffness", ".cloths[0].stiffness"},
                                                     {"warp_weft", ".cloths[0].stiffness.stretch"},
                                                     {"rigidity", ".cloths[0].stiffness.bend"},
                                                     {"maps", ".cloths[3].maps"},
                                                     {"tear", ".cloths[2].tear"},
                                                     {"pin", ".cloths[0].pins[2]"},
                                                     {"load", ".cloths[0].loads[0]"},
                                                     {"force_key", ".cloths[0].loads[1].force_keys[1]"},
                                                     {"pressure_key", ".cloths[0].loads[3].pressure_keys[1]"},
                                                     {"motion_key", ".cloths[0].pins[2].path[1]"},
                                                     {"appearance", ".cloths[0].appearance"},
                                                     {"colliders", ".colliders"},
                                                     {"plane", ".colliders.planes[0]"},
                                                     {"sphere", ".colliders.spheres[0]"},
                                                     {"box", ".colliders.boxes[0]"},
                                                     {"ellipsoid", ".colliders.ellipsoids[0]"},
                                                     {"capsule", ".colliders.capsules[0]"},
                                                     {"mesh", ".colliders.meshes[0]"},
                                                     {"seam", ".seams[0]"},
                                                     {"seam_side", ".seams[0].a"},
                                                     {"gas", ".gas[0]"},
                                                     {"gas_key", ".gas[0].volume_keys[0]"},
                                                     {"actions", ".actions"},
                                                     {"frame_actions", ".actions.steps[0]"},
                                                     {"cutter", ".cutters[0]"},
                                                     {"solver", ".solver"},
                                                     {"camera", ".camera"},
                                                     {"camera_key", ".camera.keys[1]"},
                                                     {"light", ".lights[0]"},
                                                     {"image", ".image"},
                                                     {"oracle", ".oracles[0]"}};

std::string pointer_of(const std::string& path) {
    std::string pointer;
    for (const char c : path) {
        if (c == '.' || c == '[') pointer += '/';
        if (c != '.' && c != '[' && c != ']') pointer += c;
    }
    return pointer;
}

// Returns the pointers of the errors of an object's scene with one value replaced.
std::set<std::string> error_pointers(std::string_view object, const std::string& path, const Json::Value& replacement) {
    Json::Value scene = parsed(object == "outline" ? testing::outlined_scene : testing::full_scene);
    Json::Path(places.at(object) + path).make(scene) = replacement;
    std::set<std::string> pointers;
    for (const SceneError& error : read_scene_text(written(scene), "s").errors) pointers.insert(error.pointer);
    return pointers;
}

TEST(SceneSchema, IsTheCommittedFile) {
    EXPECT_TRUE(scene_schema() == committed("engine/scene/scene.schema.json"))
        << "build/drape schema > engine/scene/scene.schema.json";
    EXPECT_EQ(schema()["$schema"].asString(), "http://json-schema.org/draft-07/schema#");
    EXPECT_EQ(schema()["$id"].asString(), "urn:drape:scene");
}

TEST(SceneFormat, IsTheCommittedDocument) {
    EXPECT_TRUE(scene_format_markdown() == committed("engine/docs/scene_format.md"))
        << "build/drape schema --markdown > engine/docs/scene_format.md";
}

TEST(SceneFormat, HasEveryKeyOfACloth) {
    constexpr std::string_view maps = "/maps/";
    for (const ClothKey key : cloth_keys) {
        const std::string_view pointer = pointer_of(key);
        const bool is_map = pointer.starts_with(maps);
        const Json::Value& keys = object_schema(is_map ? "maps" : "cloth")["properties"];
        EXPECT_TRUE(keys.isMember(std::string(pointer.substr(is_map ? maps.size() : 1)))) << pointer;
    }
}

TEST(SceneFormat, DocumentHasEveryKeyAndItsDefault) {
    const std::string document = scene_format_markdown();
    for (const Definition* object : scene_objects()) {
        const std::size_t begin = document.find(fmt::format("\n## {}\n", object->name));
        ASSERT_NE(begin, std::string::npos) << object->name;
        const std::string section = document.substr(begin, document.find("\n## ", begin + 1) - begin);
        for (const KeyText& key : object->keys) {
            const std::size_t row = section.find(fmt::format("\n- `{}`: ", key.name));
            ASSERT_NE(row, std::string::npos) << key.name;
            const std::string item = section.substr(row + 1, section.find("\n- ", row + 1) - row - 1);
            EXPECT_NE(item.find(key.default_value.empty() ? "" : "`" + key.default_value + "`"), std::string::npos)
                << item;
        }
    }
}

TEST(SceneFormat, DocumentHasTheLimitsOfArrays) {
    const std::string document = scene_format_markdown();
    int count = 0;
    for (const Definition* object : scene_objects())
        for (const KeyText& key : object->keys) {
            const Json::Value value = object_schema(object->name)["properties"][std::string(key.name)];
            const int least = value["minItems"].asInt(), most = value["maxItems"].asInt();
            if (most == least) continue;  // points and ranges, whose documents say how many numbers
            const std::string limits =
                least > 0 ? fmt::format("{} to {}", least, most) : fmt::format("at most {}", most);
            EXPECT_NE(document.find(fmt::format("\n- `{}`: array of {} ", key.name, limits)), std::string::npos)
                << object->name << " " << key.name << " " << limits;
            ++count;
        }
    EXPECT_GT(count, 10);
}

TEST(SceneSchema, HasExactlyTheKeysOfTheFormat) {
    std::set<std::string> objects;
    for (const Definition* object : scene_objects()) {
        std::set<std::string> keys;
        for (const KeyText& key : object->keys) keys.emplace(key.name);
        const std::vector<std::string> properties = object_schema(object->name)["properties"].getMemberNames();
        EXPECT_EQ(std::set<std::string>(properties.begin(), properties.end()), keys) << object->name;
        const Json::Value& others = object_schema(object->name)["additionalProperties"];
        EXPECT_EQ(others.isBool() && !others.asBool(), object->other_keys.empty()) << object->name;
        EXPECT_TRUE(objects.emplace(object->name).second) << object->name;
    }
    for (const std::string& definition : schema()["definitions"].getMemberNames())
        EXPECT_EQ(schema()["definitions"][definition].isMember("properties"), objects.contains(definition))
            << definition;
}

TEST(SceneSchema, EveryReferenceResolves) {
    std::vector<const Json::Value*> open{&schema()};
    int reference_count = 0;
    while (!open.empty()) {
        const Json::Value& value = *open.back();
        open.pop_back();
        if (value.isObject() && value.isMember("$ref") && value["$ref"].isString()) {
            const std::string target = value["$ref"].asString();
            ASSERT_TRUE(target.starts_with("#/definitions/")) << target;
            EXPECT_TRUE(schema()["definitions"].isMember(target.substr(14))) << target;
            ++reference_count;
        }
        for (const Json::Value& member : value) open.push_back(&member);
    }
    EXPECT_GT(reference_count, 30);
}

TEST(SceneSchema, EveryKeyIsDescribed) {
    for (const Definition* object : scene_objects())
        for (const Json::Value& property : object_schema(object->name)["properties"])
            EXPECT_FALSE(property["description"].asString().empty()) << object->name;
}

TEST(SceneReader, ReadsEveryKeyOfTheFormat) {
    Json::Value wrong(Json::objectValue);
    wrong["no such key"] = true;
    for (const Definition* object : scene_objects()) {
        ASSERT_TRUE(places.contains(object->name)) << object->name;
        for (const KeyText& key : object->keys) {
            const std::string path = fmt::format(".{}", key.name);
            const std::string pointer = pointer_of(places.at(object->name) + path);
            const std::set<std::string> pointers = error_pointers(object->name, path, wrong);
            const bool is_reported = std::any_of(pointers.begin(), pointers.end(), [&](const std::string& where) {
                return where == pointer || where == pointer + "/no such key";
            });
            EXPECT_TRUE(is_reported) << pointer;
        }
    }
}

// Returns an object of a kind with every default of the schema written out.
constexpr const char* box_file = DRAPE_SOURCE_DIR "/tests/scene/box.obj";

Json::Value written_defaults(std::string_view object) {
    Json::Value result(Json::objectValue);
    const Json::Value& properties = object_schema(object)["properties"];
    for (const std::string& key : properties.getMemberNames())
        if (properties[key].isMember("default")) result[key] = properties[key]["default"];
    return result;
}

TEST(SceneSchema, DocumentsTheDefaultsOfTheDescription) {
    Json::Value scene = written_defaults("scene");
    for (const char* key : {"time", "wind", "colliders", "solver", "camera", "image"})
        scene[key] = written_defaults(key);
    scene["wind"]["gust"] = written_defaults("gust");
    scene["lights"][0] = written_defaults("light");
    Json::Value cloth = written_defaults("cloth");
    for (const char* key : {"placement", "stiffness", "appearance"}) cloth[key] = written_defaults(key);
    cloth["pins"][0]["edge"] = "left";
    cloth["pins"][0]["path"][0] = written_defaults("motion_key");
    cloth["pins"][0]["path"][0]["t"] = 0;
    scene["cloths"][0] = cloth;
    scene["colliders"]["planes"][0] = written_defaults("plane");
    scene["colliders"]["spheres"][0] = written_defaults("sphere");
    scene["colliders"]["boxes"][0] = written_defaults("box");
    scene["colliders"]["ellipsoids"][0] = written_defaults("ellipsoid");
    scene["colliders"]["capsules"][0] = written_defaults("capsule");
    scene["colliders"]["meshes"][0] = written_defaults("mesh");
    scene["colliders"]["meshes"][0]["file"] = box_file;

    SceneDescription expected;
    expected.cloths.resize(1);
    expected.cloths[0].name = "cloth";
    expected.cloths[0].pins.resize(1);
    expected.cloths[0].pins[0].particles = {{0, 0}, {0, 1}};
    expected.cloths[0].pins[0].path.keys.resize(1);
    Mesh mesh{.file = box_file};
    read_file(mesh);
    expected.colliders = {{Plane{}}, {Sphere{}}, {Box{}}, {Ellipsoid{}}, {Capsule{}}, {mesh}};
    expected.camera = Camera{};
    // Directions are made unit length by the reader; the default lights are not written as such.
    const SceneResult result = read_scene_text(written(scene), "s");
    for (const SceneError& error : result.errors) ADD_FAILURE() << error.text();
    ASSERT_TRUE(result.scene.has_value());
    EXPECT_EQ(written(scene["lights"][0]["direction"]), written(parsed("[0.75, -0.9, -0.5]")));
    ASSERT_EQ(result.scene->lights.size(), expected.lights.size());
    for (std::size_t i = 0; i < expected.lights.size(); ++i)
        expected.lights[i].direction = result.scene->lights[i].direction;
    EXPECT_EQ(*result.scene, expected);
}

TEST(SceneSchema, OnlyTheseKeysHaveNoDefault) {
    const std::map<std::string_view, std::set<std::string>> without{
        {"scene", {"$schema", "gravity_keys", "cloths", "forces", "actions", "camera"}},
        {"wind", {"keys"}},
        {"wind_key", {"t", "velocity"}},
        {"gravity_key", {"t", "gravity"}},
        {"stiffness_key", {"t", "factor"}},
        {"cloth", {"name", "fabric", "outline", "start", "stiffness_keys", "velocities", "tear", "maps"}},
        {"outline", {"path", "file", "element", "scale"}},
        {"warp_weft", {"warp", "weft"}},
        {"rigidity", {"warp", "weft", "twist"}},
        {"tear", {"strain", "tension"}},
        {"maps", {"holes", "stiffness", "density", "tear", "friction", "thickness"}},
        {"self_collision", {"thickness", "friction"}},
        {"pin", {"edge", "corner", "at", "box", "point", "release", "path", "pivot"}},
        {"load", {"edge", "corner", "at", "box", "point", "force", "force_keys", "pressure", "pressure_keys", "map"}},
        {"force_key", {"t", "force"}},
        {"pressure_key", {"t", "pressure"}},
        {"motion_key", {"t"}},
        {"appearance", {"back", "texture"}},
        {"camera", {"keys"}},
        {"camera_key", {"t", "position", "target"}},
        {"plane", {"path"}},
        {"sphere", {"path", "mass", "inertia"}},
        {"box", {"path", "mass", "inertia"}},
        {"ellipsoid", {"path", "mass", "inertia"}},
        {"capsule", {"radii", "path", "mass", "inertia"}},
        {"mesh", {"file", "shell", "spacing", "frames", "path", "mass", "inertia"}},
        {"seam", {"a", "b", "rip"}},
        {"gas", {"cloths", "volume", "volume_keys", "outside"}},
        {"gas_key", {"t", "volume"}},
        {"seam_side", {"cloth", "edge", "from", "to"}},
        {"actions", {"controls", "hands", "steps"}},
        {"frame_actions",
         {"frame", "wind", "gravity", "pins", "colliders", "holds", "loads", "hands", "grasps", "body_forces",
          "body_impulses", "body_velocities", "body_sets"}},
        {"cutter", {"triangle", "active", "path"}},
        {"solver", {"estimate_error"}},
        {"oracle", {"check"}}};
    for (const Definition* object : scene_objects()) {
        std::set<std::string> keys;
        const Json::Value& properties = object_schema(object->name)["properties"];
        for (const std::string& key : properties.getMemberNames())
            if (!properties[key].isMember("default")) keys.insert(key);
        const auto expected = without.find(object->name);
        EXPECT_EQ(keys, expected == without.end() ? std::set<std::string>{} : expected->second) << object->name;
    }
}

struct Probe {
    Json::Value value;
    bool is_allowed;
};

std::vector<Probe> probes_of(const Json::Value& property) {
    const double step = property["type"].asString() == "integer" ? 1.0 : 0.001;
    std::vector<Probe> probes;
    if (property.isMember("minimum")) {
        probes.push_back({property["minimum"], true});
        probes.push_back({property["minimum"].asDouble() - step, false});
    }
    if (property.isMember("maximum")) {
        probes.push_back({property["maximum"], true});
        probes.push_back({property["maximum"].asDouble() + step, false});
    }
    if (property.isMember("exclusiveMinimum")) {
        probes.push_back({property["exclusiveMinimum"], false});
        // A closer one, a thousandth of a frame per second, is another error: cloth falls too far in a frame.
        probes.push_back({property["exclusiveMinimum"].asDouble() + 1, true});
    }
    for (const Json::Value& choice : property["enum"]) probes.push_back({choice, true});
    if (property.isMember("enum")) probes.push_back({"no such choice", false});
    return probes;
}

TEST(SceneSchema, StatesTheLimitsOfTheReader) {
    int probe_count = 0;
    for (const Definition* object : scene_objects()) {
        const Json::Value& properties = object_schema(object->name)["properties"];
        for (const std::string& key : properties.getMemberNames()) {
            if (key == "inertia") continue;  // it has no default, whose second element could be another
            // An array's limits are tried on its second element.
            const bool is_array = properties[key].isMember("items");
            const std::string path = "." + key + (is_array ? "[1]" : "");
            for (const Probe& probe : probes_of(is_array ? properties[key]["items"] : properties[key])) {
                // The allowed thickness of layers depends on the grid.
                if (probe.is_allowed && path == ".thickness" && object->name == "self_collision") continue;
                // A cloth rests as it starts only beside a file that says how.
                if (probe.is_allowed && path == ".rest") continue;
                // What a scene is told comes before its end.
                if (probe.is_allowed && path == ".frame") continue;
                const bool is_reported = error_pointers(object->name, path, probe.value)
                                             .contains(pointer_of(places.at(object->name) + path));
                EXPECT_EQ(is_reported, !probe.is_allowed) << object->name << path << " = " << written(probe.value);
                ++probe_count;
            }
        }
    }
    EXPECT_GT(probe_count, 80);
}

}  // namespace
}  // namespace drape
