// Values far beyond what cloth and pictures of it have are warned of where they stand.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drape/scene_reader.h"

namespace drape {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* ordinary = R"({"cloths": [{"name": "sheet", "grid": [5, 5], "size": [1, 1], "areal_density": 0.2,
    "velocity": [0, 0, 0], "pins": [{"edge": "top", "path": [{"t": 0}, {"t": 2, "translate": [0, 1, 0]}]}]}],
"colliders": {"boxes": [{"center": [0, -9000, 0], "half_extents": [1, 1, 1]}],
              "spheres": [{"center": [0, -9, 0], "radius": 1},
                          {"center": [0, -5, 0], "radius": 1, "path": [{"t": 0}, {"t": 2, "translate": [1, 0, 0]}]}]},
"wind": {"velocity": [1, 0, 0]}, "camera": {"fov": 40, "position": [0, 0, 5], "target": [0, 0, 0]}})";

TEST(Doubts, EveryAbsurdValueIsNamedWithItsField) {
    struct Case {
        const char *field, *usual, *absurd;
        const char* text;
    };
    const Case cases[] = {
        {"/cloths/0/size", "[1, 1]", "[1600, 1]", "cloth \"sheet\" is 1600 m long"},
        {"/cloths/0/areal_density", "2", "200", "weighs 200 kg"},
        {"/cloths/0/velocity", "[0, 100, 0]", "[0, 3000, 0]", "starts at 3000 m/s"},
        {"/cloths/0/pins/0/path/1/translate", "[0, 3, 0]", "[0, 700, 0]", "the path leads 700 m far"},
        {"/colliders/spheres/1/path/1/translate", "[3, 0, 0]", "[700, 0, 0]", "the path leads 700 m far"},
        {"/wind/velocity", "[60, 0, 0]", "[5000, 0, 0]", "a wind of 5000 m/s"},
        {"/camera/fov", "10", "0.5", "a field of view of 0.5 degrees"},
    };
    EXPECT_THAT(read_scene_text(ordinary, "o.json").warnings, IsEmpty());
    for (const Case& each : cases) {
        const auto with = [&](const char* value) {
            const std::vector<std::string> overrides{fmt::format("{}={}", each.field, value)};
            return read_scene_text(ordinary, "o.json", overrides);
        };
        EXPECT_THAT(with(each.usual).warnings, IsEmpty()) << each.field;
        const SceneResult result = with(each.absurd);
        EXPECT_TRUE(result.scene) << each.field;
        ASSERT_EQ(result.warnings.size(), 1u) << each.field;
        EXPECT_THAT(result.warnings[0].text(), HasSubstr(each.text));
        EXPECT_THAT(std::string(each.field), testing::StartsWith(result.warnings[0].pointer));
    }
}

TEST(Doubts, ACutterInTheVeryPlaneOfAColumnIsWarnedOf) {
    const auto warnings = [](const char* x) {
        return read_scene_text(fmt::format(R"({{"cloths": [{{"grid": [17, 17], "size": [0.8, 0.8],
            "placement": {{"origin": [-0.4, 1.2, 0]}}, "pins": [{{"edge": "top"}}]}}],
            "cutters": [{{"triangle": [[{0}, 2, -1], [{0}, 2, 1], [{0}, -2, 0]], "active": [0.1, 0.4]}}]}})",
                                           x),
                               "o.json")
            .warnings;
    };
    EXPECT_THAT(warnings("0.01"), IsEmpty());
    EXPECT_THAT(warnings("0.8"), IsEmpty()) << "beside the cloth";
    ASSERT_EQ(warnings("0").size(), 1u);
    EXPECT_THAT(warnings("0")[0].text(),
                testing::AllOf(HasSubstr("/cutters/0"), HasSubstr("17 particles of cloth \"cloth\" start exactly in")));
}

TEST(Doubts, AGridTooCoarseForTheEdgeOfABoxIsWarnedOf) {
    // A square metre of cloth whose middle is at x lies on a box, or is held beside it.
    const auto warnings = [](double thickness, double x, double half_box, const char* more) {
        return read_scene_text(fmt::format(R"({{"cloths": [{{"grid": [41, 41], "size": [1, 1], "thickness": {},
            "placement": {{"origin": [{}, 0.01, -0.5], "u": [1, 0, 0], "v": [0, 0, 1]}}{}}}],
            "colliders": {{"boxes": [{{"center": [0, -1, 0], "half_extents": [{}, 1, 1]}}]}}}})",
                                           thickness, x - 0.5, more, half_box),
                               "o.json")
            .warnings;
    };
    EXPECT_THAT(warnings(0.0051, 0, 0.3, ""), IsEmpty()) << "4.9 thicknesses";
    ASSERT_EQ(warnings(0.0049, 0, 0.3, "").size(), 1u);
    EXPECT_THAT(
        warnings(0.0049, 0, 0.3, "")[0].text(),
        testing::AllOf(HasSubstr("/cloths/0"), HasSubstr("0.025 m apart"), HasSubstr("0.0245 m, 5 thicknesses")));
    EXPECT_THAT(warnings(0.002, 0, 2, ""), IsEmpty()) << "lies on the box's top";
    EXPECT_THAT(warnings(0.002, 3, 0.3, ""), IsEmpty()) << "falls beside it";
    EXPECT_EQ(warnings(0.002, 1.2, 0.3, R"(, "velocity": [-1, 0, 0])").size(), 1u) << "flies towards it";
    EXPECT_EQ(warnings(0.002, 0.6, 0.3, R"(, "pins": [{"edge": "right"}])").size(), 1u) << "hangs over it";
}

}  // namespace
}  // namespace drape
