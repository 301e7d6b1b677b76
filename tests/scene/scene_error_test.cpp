// These are golden messages of malformed scenes: users and editors rely on place, pointer and words.
#include <gtest/gtest.h>

#include "drape/scene_reader.h"

namespace drape {
namespace {

struct Malformed {
    const char* name;
    std::string text;
    std::vector<std::string> errors;  ///< all errors, in order, without the file's name
};

// The test runner prints this of a case.
void PrintTo(const Malformed& malformed, std::ostream* out) { *out << malformed.name; }

// Members of a scene beside its cloths, or of its only cloth, begin at line 2, column 1.
std::string scene(const std::string& members) { return "{\"cloths\": [{}],\n" + members + "}"; }
std::string cloth(const std::string& members) { return "{\"cloths\": [{\n" + members + "}]}"; }

std::string nested(std::size_t depth) {
    return "{\"cloths\": " + std::string(depth, '[') + std::string(depth, ']') + "}";
}

std::string repeated(std::string_view text, std::size_t count) {
    std::string all;
    for (std::size_t i = 0; i < count; ++i) all += text;
    return all;
}

class SceneErrors : public ::testing::TestWithParam<Malformed> {};

TEST_P(SceneErrors, AreExactlyThese) {
    const SceneResult result = read_scene_text(GetParam().text, "s");
    EXPECT_FALSE(result.scene.has_value());
    std::vector<std::string> texts;
    for (const SceneError& error : result.errors) texts.push_back(error.text());
    std::vector<std::string> expected;
    for (const std::string& error : GetParam().errors) expected.push_back("s:" + error);
    EXPECT_EQ(texts, expected) << GetParam().text.substr(0, 400);
}

TEST(SceneErrorPlaces, OfKeysWithEscapesAreTheirs) {
    const SceneResult result =
        read_scene_text("{\"cloths\": [{\"\\u00e9\": 1,\n  \"\\u20ac\": 2, \"a\\tb\": 3,\n \"c\\/d\": 4}]}", "s");
    std::vector<std::string> places;
    for (const SceneError& error : result.errors)
        places.push_back(error.text().substr(0, error.text().find(": expected")));
    EXPECT_EQ(places, (std::vector<std::string>{"s:1:14: /cloths/0/\xc3\xa9", "s:2:3: /cloths/0/\xe2\x82\xac",
                                                "s:2:16: /cloths/0/a\\x09b", "s:3:2: /cloths/0/c~1d"}));
}

const auto name_of = [](const auto& info) { return std::string(info.param.name); };

const Malformed syntax_cases[] = {
    {"Empty", "", {"1:1: Syntax error: value, object or array expected"}},
    {"NotJson", "cloth", {"1:1: Syntax error: value, object or array expected"}},
    {"NotAnObject", "[]", {"1:1: expected an object, got []"}},
    {"CutOff", "{\n", {"2:1: Missing '}' or object member name"}},
    {"TrailingComma", "{\"cloths\": [{},]}", {"1:15: expected no comma after the last member"}},
    {"TrailingCommasHideNothing",
     "{\"cloths\": [{\"damping\": -1, // ,]\n}],\n\"name\": \",}\",\n \"wind\": {\"lift\": -2,}}",
     {"1:25: /cloths/0/damping: expected a number >= 0 (single precision), got -1",
      "1:27: expected no comma after the last member",
      "4:19: /wind/lift: expected a number >= 0 (single precision), got -2",
      "4:21: expected no comma after the last member"}},
    {"TrailingCommaAndWorse",
     "{\"cloths\": [{},], \"a\" 1}",
     {"1:15: expected no comma after the last member", "1:23: Missing ':' after object member name"}},
    {"OnlyAComma", "{\"cloths\": [,]}", {"1:13: Syntax error: value, object or array expected"}},
    {"TwoCommas", "{\"cloths\": [{},,]}", {"1:16: Syntax error: value, object or array expected"}},
    {"MissingColon", "{\"cloths\" [{}]}", {"1:11: Missing ':' after object member name"}},
    {"MissingComma", scene("\"gravity\": [0 1, 2]"), {"2:15: Missing ',' or ']' in array declaration"}},
    {"TextAfterTheEnd", "{\"cloths\": [{}]} x", {"1:18: Extra non-whitespace after JSON value"}},
    {"TwoDocuments", "{\"cloths\": [{}]}\n{}", {"2:1: Extra non-whitespace after JSON value"}},
    {"DuplicateKey", "{\"cloths\": [{}],\r\n \"cloths\": [{}]}", {"2:2: Duplicate key: 'cloths'"}},
    // A key is the text that its escapes stand for, and is found by it.
    {"DuplicateKeyOnceEscaped",
     "{\"cloths\": [{}],\n \"\xc3\xa9\": 1, \"\\u00e9\": 2}",
     {"2:11: Duplicate key: '\xc3\xa9'"}},
    {"NotANumber", scene("\"gravity\": [0, NaN, 0]"), {"2:16: Syntax error: value, object or array expected"}},
    {"LeadingZero", scene("\"gravity\": [0, 01, 0]"), {"2:16: expected a JSON number, got 01"}},
    {"LoneMinus", scene("\"gravity\": [0, -, 0]"), {"2:16: expected a JSON number, got -"}},
    {"MissingDecimals", scene("\"gravity\": [0, 1., 0]"), {"2:16: expected a JSON number, got 1."}},
    {"OpenString", scene("\"name\": \"abc\n\""), {"2:9: expected a closing quote on the same line"}},
    {"BadEscape", scene("\"name\": \"\\q\""), {"2:9: Bad escape sequence in string"}},
    {"SingleQuotes", scene("\"name\": 'x'"), {"2:9: Syntax error: value, object or array expected"}},
    {"OpenComment", scene("/* open"), {"2:1: Missing '}' or object member name"}},
    {"ControlCharacter", scene("\"name\": \"\x01\""), {"2:10: expected text, got the control character 0x01"}},
    {"ZeroByte", std::string("{\"cloths\": [{}]}\0x", 18), {"1:17: expected text, got the control character 0x00"}},
    {"NotUtf8", scene("\"name\": \"a\xC3(\""), {"2:11: expected UTF-8 text, got the byte 0xC3"}},
    {"OverlongUtf8", scene("\"name\": \"\xC0\x80\""), {"2:10: expected UTF-8 text, got the byte 0xC0"}},
    {"TooDeep", nested(65), {"1:75: expected at most 64 nested arrays and objects"}},
    {"FarTooDeep", nested(1'000'000), {"1:75: expected at most 64 nested arrays and objects"}},
    {"TooManyValues",
     "{\"cloths\": [" + repeated("0,", 8'000'000) + "0]}",
     {"1:1000010: expected a scene of at most 500000 values"}},
    {"TooManyKeys",
     "{\"cloths\": [{" + repeated("\"a\":0,", 2'000'000) + "\"a\":0}]}",
     {"1:6013: expected at most 1000 keys in an object"}},
    {"EndlessKey",
     "{\"cloths\": [{}],\n\"" + std::string(16'000'000, 'k') + "\": 0}",
     {"2:1: /" + std::string(77, 'k') +
      "...: expected one of $schema, name, time, up, gravity, gravity_keys, wind, cloths, "
      "seams, gas, colliders, overlap, cutters, solver, forces, actions, camera, lights, ambient, ambient_ground, "
      "image, "
      "oracles, "
      "got the "
      "unknown "
      "key \"" +
      std::string(37, 'k') + "...\""}},
};
INSTANTIATE_TEST_SUITE_P(Syntax, SceneErrors, ::testing::ValuesIn(syntax_cases), name_of);

const Malformed key_cases[] = {
    {"Misspelt", scene("\"gravty\": 1"), {"2:1: /gravty: expected \"gravity\", got the unknown key \"gravty\""}},
    {"MisspeltInside",
     cloth("\"pins\": [{\"edgee\": \"left\", \"corner\": \"top_left\"}]"),
     {"2:11: /cloths/0/pins/0/edgee: expected \"edge\", got the unknown key \"edgee\""}},
    {"EscapedKey", scene("\"t\\u0069m\": {}"), {"2:1: /tim: expected \"time\", got the unknown key \"tim\""}},
    {"AfterAComment",
     scene("/* \"fsp\": 0 */ \"time\": { // \"fsp\"\n  \"fsp\" : 3}"),
     {"3:3: /time/fsp: expected \"fps\", got the unknown key \"fsp\""}},
    {"NothingNear",
     scene("\"time\": {\"duration\": 3}"),
     {"2:10: /time/duration: expected \"frames\" (seconds times fps, plus one), got the unknown key \"duration\""}},
    {"SizeOfABox",
     scene("\"colliders\": {\"boxes\": [{\"size\": [1, 1, 1]}]}"),
     {"2:26: /colliders/boxes/0/size: expected \"half_extents\" (half the edge lengths in metres, [x, y, z]), got the "
      "unknown key \"size\""}},
    {"VelocityOfASphere",
     scene("\"colliders\": {\"spheres\": [{\"velocity\": [0, -1, 0]}]}"),
     {"2:40: /colliders/spheres/0/velocity: expected a mass too, got none"}},
    {"MassOfACloth",
     cloth("\"mass\": 1"),
     {"2:1: /cloths/0/mass: expected \"areal_density\" (kg/m^2), got the unknown key \"mass\""}},
    {"Fabric", cloth("\"fabric\": \"cottn\""), {"2:11: /cloths/0/fabric: expected \"cotton\", got \"cottn\""}},
    {"UnknownFabric",
     cloth("\"fabric\": \"paper\""),
     {"2:11: /cloths/0/fabric: expected \"cotton\" or \"silk\" or \"denim\" or \"wool\" or \"jersey\" or \"canvas\" or "
      "\"leather\", got \"paper\""}},
    {"PointerIsEscaped",
     scene("\"time\": {\"a/b~c\": 3}"),
     {"2:10: /time/a~1b~0c: expected one of fps, frames, got the unknown key \"a/b~c\""}},
    {"ShortKeysAreNotGuessed",
     scene("\"colliders\": {\"planes\": [{\"path\": [{\"t\": 0, \"xy\": 1}]}]}"),
     {"2:45: /colliders/planes/0/path/0/xy: expected one of t, translate, rotate, got the unknown key "
      "\"xy\""}},
};
INSTANTIATE_TEST_SUITE_P(Keys, SceneErrors, ::testing::ValuesIn(key_cases), name_of);

const Malformed setting_cases[] = {
    {"NoCloths", "\n{}", {"2:1: /cloths: expected an array of 1 to 1024 cloths, got nothing"}},
    {"EmptyCloths", "{\"cloths\": []}", {"1:12: /cloths: expected an array of 1 to 1024 cloths, got []"}},
    {"WrongTypes",
     scene("\"name\": 3, \"time\": [], \"gravity\": \"down\", \"wind\": null, \"camera\": true"),
     {"2:9: /name: expected a string, got 3", "2:20: /time: expected an object, got []",
      "2:35: /gravity: expected an array of 3 numbers, got \"down\"", "2:51: /wind: expected an object, got null",
      "2:67: /camera: expected an object, got true"}},
    {"ShortVector",
     scene("\"gravity\": [0, -9.81]"),
     {"2:12: /gravity: expected an array of 3 numbers, got [0, -9.81]"}},
    {"Overflow",
     scene("\"gravity\": [0, -1e999, 1e39]"),
     {"2:16: /gravity/1: expected a number of at most 3.4e38 in magnitude, got -1e999",
      "2:24: /gravity/2: expected a number of at most 3.4e38 in magnitude, got 1e39"}},
    {"Time",
     scene("\"time\": {\"fps\": 0, \"frames\": 2.5}"),
     {"2:17: /time/fps: expected a number in (0, 10000], got 0",
      "2:30: /time/frames: expected an integer from 1 to 1000000, got 2.5"}},
    {"TooManyFrames",
     scene("\"time\": {\"fps\": 10001, \"frames\": 1000001}"),
     {"2:17: /time/fps: expected a number in (0, 10000], got 10001",
      "2:34: /time/frames: expected an integer from 1 to 1000000, got 1000001"}},
    {"Wind",
     scene("\"wind\": {\"drag\": -1, \"gust\": {\"period\": 0, \"seed\": -1}}"),
     {"2:18: /wind/drag: expected a number >= 0 (single precision), got -1",
      "2:41: /wind/gust/period: expected a number > 0 (single precision), got 0",
      "2:52: /wind/gust/seed: expected an integer from 0 to 4294967295, got -1"}},
    {"Cutters",
     scene("\"cutters\": [{}, {\"triangle\": [[0, 0, 0], [1, 0, 0], [2, 0, 1e-7]], \"active\": [2, 1], \"spin\": 1}]"),
     {"2:13: /cutters/0/triangle: expected three points, got nothing",
      "2:13: /cutters/0/active: expected [begin, end] in seconds, got nothing",
      "2:30: /cutters/1/triangle: expected a triangle with an area, got a degenerate one",
      "2:78: /cutters/1/active: expected an end that is not before the beginning",
      "2:86: /cutters/1/spin: expected one of triangle, active, path, crumbs, got the unknown key \"spin\""}},
    {"Solver",
     scene("\"solver\": {\"method\": \"magic\", \"substeps\": 0, \"iterations\": 1025,\n\"collide\": 1, "
           "\"tolerance\": -1,\n\"tethers\": 1}"),
     {"2:22: /solver/method: expected \"relax\" or \"explicit\" or \"line\" or \"auto\", got \"magic\"",
      "2:43: /solver/substeps: expected an integer from 1 to 4096, got 0",
      "2:60: /solver/iterations: expected an integer from 1 to 1024, got 1025",
      "3:12: /solver/collide: expected \"iteration\" or \"substep\", got 1",
      "3:28: /solver/tolerance: expected a number >= 0 (single precision), got -1",
      "4:12: /solver/tethers: expected true or false, got 1"}},
    {"Camera",
     scene("\"camera\": {\"position\": [1, 2, 3], \"target\": [1, 2, 3], \"fov\": 171}"),
     {"2:11: /camera: expected a target away from the camera's position, got the same point",
      "2:63: /camera/fov: expected a number in (0, 170], got 171"}},
    {"FiveLights",
     scene("\"lights\": [{}, {}, {}, {}, {}]"),
     {"2:11: /lights: expected an array of at most 4 lights, got [{}, {}, {}, {}, {}]"}},
    {"DarkLight",
     scene("\"lights\": [{\"direction\": [0, 0, 0], \"color\": [0, 0, 1.5]}], \"ambient\": [0, -1, 0]"),
     {"2:26: /lights/0/direction: expected a vector that is not zero, got [0, 0, 0]",
      "2:53: /lights/0/color/2: expected a number in [0, 1], got 1.5",
      "2:76: /ambient/1: expected a number in [0, 1], got -1"}},
    {"Image",
     scene("\"image\": {\"size\": [0, 16385], \"samples\": 2}"),
     {"2:20: /image/size/0: expected an integer from 1 to 16384, got 0",
      "2:23: /image/size/1: expected an integer from 1 to 16384, got 16385",
      "2:42: /image/samples: expected 1 or 4, got 2"}},
    {"Oracles",
     scene("\"oracles\": [{}, {\"check\": \"nonsense\", \"speed\": 1}, {\"check\": \"strech\"}, {\"check\": 3}]"),
     {"2:13: /oracles/0/check: expected the name of a check, got nothing",
      "2:27: /oracles/1/check: expected the name of a check, one of stretch, penetration, uncrossed, supported, "
      "borne, pins_hold, pins_follow, released, drawn, falls, body_flies, rebounds, bodies_apart, swing, torque, "
      "blown, mirror, carried, cut_pieces, mass_kept, stretch_law, got \"nonsense\"",
      "2:62: /oracles/2/check: expected the name of a check, perhaps \"stretch\", got \"strech\"",
      "2:83: /oracles/3/check: expected the name of a check, got 3"}},
    {"OracleLimits",
     scene("\"oracles\": [{\"check\": \"stretch\", \"strian\": 1}, {\"check\": \"falls\", \"cloth\": 1, \"from_row\": "
           "0.5, \"until_frame\": 0, \"error\": \"low\"}]"),
     {"2:13: /oracles/0: expected the limit \"strain\" of check stretch: largest RMS strain",
      "2:34: /oracles/0/strian: expected \"strain\", got the unknown key \"strian\"",
      "2:76: /oracles/1/cloth: expected the number of one of the 1 cloths, from 0, got 1",
      "2:91: /oracles/1/from_row: expected an integer from 0 to 4294967295, got 0.5",
      "2:123: /oracles/1/error: expected a number of at most 3.4e38 in magnitude, got \"low\""}},
};
INSTANTIATE_TEST_SUITE_P(Settings, SceneErrors, ::testing::ValuesIn(setting_cases), name_of);

const Malformed cloth_cases[] = {
    {"NotAnObject", "{\"cloths\": [7]}", {"1:13: /cloths/0: expected an object, got 7"}},
    {"Name",
     cloth("\"name\": \"a/b\""),
     {"2:9: /cloths/0/name: expected a name of 1 to 64 letters, digits, _ and - (it becomes a file name), "
      "got "
      "\"a/b\""}},
    {"SameName",
     "{\"cloths\": [{\"name\": \"cloth2\"},\n{\"placement\": {\"origin\": [0, 0, 9]}}]}",
     {"2:1: /cloths/1/name: expected a name no other cloth has, got \"cloth2\""}},
    {"Grid",
     cloth("\"grid\": [1, 2.5]"),
     {"2:10: /cloths/0/grid/0: expected an integer from 2 to 16384, got 1",
      "2:13: /cloths/0/grid/1: expected an integer from 2 to 16384, got 2.5"}},
    {"BillionParticles",
     cloth("\"grid\": [40000, 25000]"),
     {"2:9: /cloths/0/grid: expected at most 16000000 particles in all cloths together, got 1000000000",
      "2:10: /cloths/0/grid/0: expected an integer from 2 to 16384, got 40000",
      "2:17: /cloths/0/grid/1: expected an integer from 2 to 16384, got 25000"}},
    {"TooManyInAll",
     "{\"cloths\": [{\"grid\": [4000, 2000]},\n{\"grid\": [4000, 2001], \"placement\": {\"origin\": [0, 0, "
     "9]}}]}",
     {"2:10: /cloths/1/grid: expected at most 16000000 particles in all cloths together, got 16004000"}},
    {"CountDoesNotWrapAround",
     "{\"cloths\": [{\"grid\": [4294967295, 4294967295]},\n{\"grid\": [4294967295, 4294967295]}]}",
     {"1:22: /cloths/0/grid: expected at most 16000000 particles in all cloths together, got "
      "18446744065119617025",
      "1:23: /cloths/0/grid/0: expected an integer from 2 to 16384, got 4294967295",
      "1:35: /cloths/0/grid/1: expected an integer from 2 to 16384, got 4294967295",
      "2:11: /cloths/1/grid/0: expected an integer from 2 to 16384, got 4294967295",
      "2:23: /cloths/1/grid/1: expected an integer from 2 to 16384, got 4294967295"}},
    {"Numbers",
     cloth("\"size\": [1, 0], \"areal_density\": 1e-60, \"damping\": -1,\n\"friction\": -0.1, \"thickness\": "
           "[]"),
     {"2:13: /cloths/0/size/1: expected a number > 0 (single precision), got 0",
      "2:34: /cloths/0/areal_density: expected a number > 0 (single precision), got 1e-60",
      "2:52: /cloths/0/damping: expected a number >= 0 (single precision), got -1",
      "3:13: /cloths/0/friction: expected a number >= 0 (single precision), got -0.1",
      "3:32: /cloths/0/thickness: expected a number >= 0 (single precision), got []"}},
    {"ObliquePlacement",
     cloth("\"placement\": {\"u\": [1, 0, 0], \"v\": [1, -1, 0]}"),
     {"2:14: /cloths/0/placement: expected u and v at right angles, got a cosine of 0.707107"}},
    {"ZeroDirection",
     cloth("\"placement\": {\"u\": [0, 0, 0]}"),
     {"2:20: /cloths/0/placement/u: expected a vector that is not zero, got [0, 0, 0]"}},
    {"FarAway",
     cloth("\"placement\": {\"origin\": [0, 3e7, 0]}, \"size\": [4, 4]"),
     {"1:13: /cloths/0: expected a cloth that single precision resolves: at 3e+07 m from the origin it is "
      "exact to 2 "
      "m, more than a quarter of the edge length 4 m"}},
    {"StiffnessWord",
     cloth("\"stiffness\": \"stiff\""),
     {"2:14: /cloths/0/stiffness: expected \"rigid\" or an object, got \"stiff\""}},
    {"Bending",
     cloth("\"stiffness\": {\"bend\": -1e-5, \"shear\": -1}"),
     {"2:23: /cloths/0/stiffness/bend: expected a number >= 0 (single precision), got -1e-5",
      "2:39: /cloths/0/stiffness/shear: expected a number >= 0 (single precision), got -1"}},
    {"Compression",
     cloth("\"stiffness\": {\"compression\": 0}"),
     {"2:30: /cloths/0/stiffness/compression: expected a number in [0.001, 1], got 0"}},
    {"TearLimits",
     cloth("\"tear\": {\"strain\": 0, \"tension\": -3}"),
     {"2:9: /cloths/0/tear: expected exactly one of strain and tension, got both",
      "2:20: /cloths/0/tear/strain: expected a number > 0 (single precision), got 0",
      "2:34: /cloths/0/tear/tension: expected a number > 0 (single precision), got -3"}},
    {"TearWithoutALimit",
     cloth("\"tear\": {}"),
     {"2:9: /cloths/0/tear: expected exactly one of strain and tension, got none"}},
    {"TearOfRigidCloth",
     cloth("\"tear\": {\"strain\": 0.2}, \"stiffness\": \"rigid\""),
     {"2:9: /cloths/0/tear: expected springs that stretch, got stiffness \"rigid\": what rigid ones stretch is the "
      "solver's error"}},
    {"TearOfShearAlone",
     cloth("\"tear\": {\"tension\": 200}, \"stiffness\": {\"stretch\": 0}"),
     {"2:9: /cloths/0/tear: expected springs along rows and columns, got stiffness.stretch 0: there is nothing to "
      "tear"}},
    {"TearByError",
     cloth("\"tear\": {\"tension\": 9}"),
     {"2:9: /cloths/0/tear: expected a limit above the stretch error that the solver may make, 0.01 "
      "(solver.tolerance): the cloth tears at a strain of 0.009"}},
    {"TearMapWithoutTear",
     cloth("\"maps\": {\"tear\": \"" DRAPE_SOURCE_DIR "/tests/scene/given/cells.png\"}"),
     {"2:18: /cloths/0/maps/tear: expected a cloth with tear, whose limit the map scales, got one without"}},
    {"Appearance",
     cloth("\"appearance\": {\"front\": [0, 0, 2], \"pattern\": \"dots\"}"),
     {"2:32: /cloths/0/appearance/front/2: expected a number in [0, 1], got 2",
      "2:47: /cloths/0/appearance/pattern: expected \"plain\" or \"checker\" or \"stripes\", got \"dots\""}},
};
INSTANTIATE_TEST_SUITE_P(Cloth, SceneErrors, ::testing::ValuesIn(cloth_cases), name_of);

const Malformed world_cases[] = {
    {"Up", scene("\"up\": \"x\""), {"2:7: /up: expected \"y\" or \"z\", got \"x\""}},
    {"UpOfAnotherKind", scene("\"up\": [0, 0, 1]"), {"2:7: /up: expected \"y\" or \"z\", got [0, 0, 1]"}},
    {"UpByAnotherName",
     scene("\"up_axis\": \"z\""),
     {"2:1: /up_axis: expected \"up\" (\"y\" or \"z\"), got the unknown key \"up_axis\""}},
    {"WindKeysThatGoBack",
     scene("\"wind\": {\"keys\": [{\"t\": 1, \"velocity\": [1, 0, 0]}, {\"t\": 0.5, \"velocity\": [1, 0, 0]}]}"),
     {"2:58: /wind/keys/1/t: expected a time after the previous key's 1, got 0.5"}},
    {"GravityKeysAtOneTime",
     scene("\"gravity_keys\": [{\"t\": 1, \"gravity\": [0, -1, 0]}, {\"t\": 1, \"gravity\": [0, 1e999, 0]}]"),
     {"2:57: /gravity_keys/1/t: expected a time after the previous key's 1, got 1",
      "2:75: /gravity_keys/1/gravity/1: expected a number of at most 3.4e38 in magnitude, got 1e999"}},
    {"KeysWithoutValues",
     scene("\"wind\": {\"keys\": [{\"t\": 0}, {\"velocity\": [1, 0, 0]}]}, \"gravity_keys\": []"),
     {"2:19: /wind/keys/0/velocity: expected a velocity of 3 numbers, got nothing",
      "2:29: /wind/keys/1/t: expected a time in seconds, got nothing",
      "2:72: /gravity_keys: expected an array of at least 1 key, got []"}},
    {"StiffnessKeysThatGoBackOrTooFar",
     cloth("\"stiffness_keys\": [{\"t\": 1, \"factor\": 0}, {\"t\": 1, \"factor\": 1.5}]"),
     {"2:39: /cloths/0/stiffness_keys/0/factor: expected a number in [0.001, 1], got 0",
      "2:49: /cloths/0/stiffness_keys/1/t: expected a time after the previous key's 1, got 1",
      "2:62: /cloths/0/stiffness_keys/1/factor: expected a number in [0.001, 1], got 1.5"}},
    {"StiffnessKeysOfRigidCloth",
     cloth("\"stiffness\": \"rigid\", \"stiffness_keys\": [{\"t\": 0, \"factor\": 0.5}]"),
     {"2:41: /cloths/0/stiffness_keys: expected springs whose stiffness can change, got stiffness \"rigid\""}},
    {"StiffnessKeysOfClothThatTearsByATension",
     cloth("\"stiffness_keys\": [{\"t\": 0, \"factor\": 0.5}], \"tear\": {\"tension\": 9}"),
     {"2:54: /cloths/0/tear: expected a strain beside stiffness_keys, got a tension: it is known only where the "
      "stiffness stays"}},
    {"GravityThatGetsTooStrong",
     scene("\"gravity_keys\": [{\"t\": 0, \"gravity\": [0, 0, 0]}, {\"t\": 1, \"gravity\": [0, -3e38, 0]}]"),
     {"2:17: /gravity_keys: expected less gravity: cloth \"cloth\" would fall 4.97e+27 of its edge lengths in a "
      "substep (gravity 3e+38 m/s^2, 60 frames/s), and at most 1e+04 can be simulated"}},
};
INSTANTIATE_TEST_SUITE_P(World, SceneErrors, ::testing::ValuesIn(world_cases), name_of);

const Malformed pin_cases[] = {
    {"NoSelector",
     cloth("\"pins\": [{}]"),
     {"2:10: /cloths/0/pins/0: expected exactly one of edge, corner, at, box and point, got 0 of them"}},
    {"TwoSelectors",
     cloth("\"pins\": [{\"edge\": \"left\", \"at\": [0, 0]}]"),
     {"2:10: /cloths/0/pins/0: expected exactly one of edge, corner, at, box and point, got 2 of them"}},
    {"EdgeAndCorner",
     cloth("\"pins\": [{\"edge\": \"up\"}, {\"corner\": \"left\"}]"),
     {"2:19: /cloths/0/pins/0/edge: expected \"left\" or \"right\" or \"top\" or \"bottom\", got \"up\"",
      "2:37: /cloths/0/pins/1/corner: expected \"top_left\" or \"top_right\" or \"bottom_left\" or "
      "\"bottom_right\", got "
      "\"left\""}},
    {"OutsideTheGrid",
     cloth("\"grid\": [4, 3], \"pins\": [{\"at\": [4, 0]}, {\"box\": [[0, 0], [3, 3]]}]"),
     {"2:34: /cloths/0/pins/0/at/0: expected an integer from 0 to 3, got 4",
      "2:63: /cloths/0/pins/1/box/1/1: expected an integer from 0 to 2, got 3"}},
    {"GridFaultIsNotRepeatedByPins",
     cloth("\"grid\": [0, 3], \"pins\": [{\"at\": [4, 0]}]"),
     {"2:10: /cloths/0/grid/0: expected an integer from 2 to 16384, got 0"}},
    {"BackwardBox",
     cloth("\"grid\": [9, 9], \"pins\": [{\"box\": [[3, 0], [2, 5]]}]"),
     {"2:34: /cloths/0/pins/0/box: expected the first particle of a box not beyond its last, got [[3, 0], "
      "[2, 5]]"}},
    {"Hole",
     cloth("\"grid\": [9, 9], \"holes\": [[[0, 5], [9, 2]], [1, 2]]"),
     {"2:37: /cloths/0/holes/0/1/0: expected an integer from 0 to 8, got 9",
      "2:46: /cloths/0/holes/1/0: expected a particle [column, row], got 1",
      "2:49: /cloths/0/holes/1/1: expected a particle [column, row], got 2"}},
    {"HolesThatLeaveNothing",
     cloth("\"grid\": [3, 3], \"holes\": [[[0, 0], [1, 2]], [[0, 0], [2, 1]], [[1, 0], [2, 2]]]"),
     {"2:26: /cloths/0/holes: expected holes that leave a cell of the cloth, got none left"}},
    {"ReleaseAndPivot",
     cloth("\"pins\": [{\"edge\": \"left\", \"release\": -1, \"pivot\": 0}]"),
     {"2:38: /cloths/0/pins/0/release: expected a number >= 0 (single precision), got -1",
      "2:51: /cloths/0/pins/0/pivot: expected an array of 3 numbers, got 0"}},
};
INSTANTIATE_TEST_SUITE_P(Pins, SceneErrors, ::testing::ValuesIn(pin_cases), name_of);

const Malformed collider_cases[] = {
    {"EmptyPath",
     scene("\"colliders\": {\"spheres\": [{\"path\": []}]}"),
     {"2:36: /colliders/spheres/0/path: expected an array of at least 1 key, got []"}},
    {"PathTimes",
     scene("\"colliders\": {\"spheres\": [{\"path\": [{\"t\": 1}, {\"t\": 1}, {}, {\"t\": 0}, {\"t\": -1}]}]}"),
     {"2:53: /colliders/spheres/0/path/1/t: expected a time after the previous key's 1, got 1",
      "2:57: /colliders/spheres/0/path/2/t: expected a time in seconds, got nothing",
      "2:77: /colliders/spheres/0/path/4/t: expected a time after the previous key's 0, got -1"}},
    {"Shapes",
     scene("\"colliders\": {\"planes\": [{\"normal\": [0, 0, 0]}], \"spheres\": [{\"radius\": 0}],\n"
           "\"boxes\": [{\"half_extents\": [1, 1, 0]}], \"ellipsoids\": [{\"radii\": [1, -1, 1]}]}"),
     {"2:37: /colliders/planes/0/normal: expected a vector that is not zero, got [0, 0, 0]",
      "2:73: /colliders/spheres/0/radius: expected a number > 0 (single precision), got 0",
      "3:35: /colliders/boxes/0/half_extents/2: expected a number > 0 (single precision), got 0",
      "3:70: /colliders/ellipsoids/0/radii/1: expected a number > 0 (single precision), got -1"}},
    {"Capsules",
     scene("\"colliders\": {\"capsules\": [{\"radius\": 1, \"radii\": [1, 2]},\n{\"radius\": [1, 2]}, {\"radii\": [1, "
           "0]}, "
           "{\"center\": 0}]}"),
     {"2:28: /colliders/capsules/0: expected radius or radii, got both",
      "3:12: /colliders/capsules/1/radius: expected a number > 0 (single precision), got [1, 2]",
      "3:35: /colliders/capsules/2/radii/1: expected a number > 0 (single precision), got 0",
      "3:41: /colliders/capsules/3/center: expected \"from\" and \"to\" (centres of both ends, metres), got the "
      "unknown "
      "key \"center\""}},
    {"Meshes",
     scene("\"colliders\": {\"meshes\": [{}, {\"file\": 3},\n{\"file\": \"/there/is/no.obj\"}, {\"file\": "
           "\"x.obj\", \"scale\": 0}, {\"file\": \"/dev/null\"}]}"),
     {"2:26: /colliders/meshes/0/file: expected the name of a file, got nothing",
      "2:39: /colliders/meshes/1/file: expected a string, got 3",
      "3:10: /colliders/meshes/2/file: cannot read /there/is/no.obj: No such file or directory",
      "3:58: /colliders/meshes/3/scale: expected a number > 0 (single precision), got 0",
      "3:71: /colliders/meshes/4/file: cannot read /dev/null: it is not a file"}},
    {"MeshesThatDeform",
     scene("\"colliders\": {\"meshes\": [{\"loop\": true, \"file\": \"" DRAPE_SOURCE_DIR
           "/tests/scene/box.obj\"},\n{\"frames\": \"/there/is/no.pc2\", \"file\": \"" DRAPE_SOURCE_DIR
           "/tests/scene/box.obj\"},\n{\"frames_per_second\": 0, \"frames\": \"x.npy\", \"file\": \"y.obj\"}]}"),
     {"2:35: /colliders/meshes/0/loop: expected frames too, got none",
      "3:12: /colliders/meshes/1/frames: cannot read '/there/is/no.pc2': No such file or directory",
      "4:23: /colliders/meshes/2/frames_per_second: expected a number > 0 (single precision), got 0"}},
    {"FieldsOfMeshes",
     scene("\"colliders\": {\"meshes\": [{\"file\": \"" DRAPE_SOURCE_DIR
           "/tests/scene/box.obj\", \"position\": [0, 9, 0]},\n"
           "{\"spacing\": 0.001, \"position\": [0, 9, 9], \"file\": \"" DRAPE_SOURCE_DIR "/tests/scene/box.obj\"}]}"),
     {"3:13: /colliders/meshes/1/spacing: expected distances to all meshes at no more than 8388608 points, got "
      "8601896583 up to this one, which has a spacing of 0.001 m"}},
    {"Common",
     scene("\"colliders\": {\"planes\": {}, \"boxes\": [{\"friction\": -1, \"color\": \"red\", \"rotate\": "
           "90}]}"),
     {"2:25: /colliders/planes: expected an array of at most 1024 colliders, got an empty object",
      "2:52: /colliders/boxes/0/friction: expected a number >= 0 (single precision), got -1",
      "2:65: /colliders/boxes/0/color: expected an array of 3 numbers, got \"red\"",
      "2:82: /colliders/boxes/0/rotate: expected an array of 3 numbers, got 90"}},
};
INSTANTIATE_TEST_SUITE_P(Colliders, SceneErrors, ::testing::ValuesIn(collider_cases), name_of);

/// Method auto is judged with its most substeps, 4096.
const Malformed fall_cases[] = {
    {"Gravity",
     scene("\"gravity\": [0, -3e38, 0]"),
     {"2:12: /gravity: expected less gravity: cloth \"cloth\" would fall 4.97e+27 of its edge lengths in a substep "
      "(gravity 3e+38 m/s^2, 60 frames/s), and at most 1e+04 can be simulated"}},
    {"FrameRate",
     scene("\"time\": {\"fps\": 1e-10}"),
     {"2:17: /time/fps: expected more frames per second: cloth \"cloth\" would fall 5.85e+13 of its edge lengths in a "
      "substep (gravity 9.81 m/s^2, 1e-10 frames/s), and at most 1e+04 can be simulated"}},
    {"DefaultFrameRate",
     scene("\"gravity\": [0, -37000000, 0], \"solver\": {\"method\": \"relax\", \"substeps\": 1}"),
     {"2:12: /gravity: expected less gravity: cloth \"cloth\" would fall 1.03e+04 of its edge lengths in a substep "
      "(gravity 3.7e+07 m/s^2, 60 frames/s), and at most 1e+04 can be simulated"}},
    {"EdgesOfNoLength",
     "{\"time\": {\"fps\": 60}, \"cloths\": [\n{\"size\": [1e-16, 1], \"placement\": {\"origin\": [0, 0, 0], \"v\": "
     "[0, 0, "
     "1]}}]}",
     {"2:1: /cloths/0: expected a cloth that single precision resolves: at 1 m from the origin it is exact to 1.19e-07 "
      "m, more than a quarter of the edge length 1e-16 m"}},
};
INSTANTIATE_TEST_SUITE_P(Fall, SceneErrors, ::testing::ValuesIn(fall_cases), name_of);

TEST(SceneErrorTable, HoldsAtLeastFortyScenes) {
    EXPECT_GE(std::size(syntax_cases) + std::size(key_cases) + std::size(setting_cases) + std::size(cloth_cases) +
                  std::size(pin_cases) + std::size(collider_cases) + std::size(fall_cases),
              40u);
}

TEST(SceneErrorText, LeavesOutWhatIsNotKnown) {
    EXPECT_EQ((SceneError{"a.json", 2, 5, "/x", "bad"}.text()), "a.json:2:5: /x: bad");
    EXPECT_EQ((SceneError{"a.json", 2, 5, "", "bad"}.text()), "a.json:2:5: bad");
    EXPECT_EQ((SceneError{"--set '/x=1'", 0, 0, "/x", "bad"}.text()), "--set '/x=1': /x: bad");
}

}  // namespace
}  // namespace drape
