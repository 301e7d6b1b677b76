// What only pictures know: what is wrong there is an error of the scene, with its place.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drape/scene_reader.h"

namespace drape {
namespace {

std::vector<std::string> texts(const std::vector<SceneError>& errors) {
    std::vector<std::string> texts;
    for (const SceneError& error : errors) texts.push_back(error.text());
    return texts;
}

std::vector<std::string> errors_of(const std::string& text) { return texts(read_scene_text(text, "s").errors); }

std::string cloth(const std::string& inside) { return "{\"cloths\": [{" + inside + "}]}"; }

using Texts = std::vector<std::string>;

TEST(Look, OfAClothIsChecked) {
    EXPECT_EQ(errors_of(cloth("\"appearance\": {\"roughness\": 0.05, \"sheen\": 2, \"weave\": -1}")),
              (Texts{"s:1:42: /cloths/0/appearance/roughness: expected a number in [0.1, 1], got 0.05",
                     "s:1:57: /cloths/0/appearance/sheen: expected a number in [0, 1], got 2",
                     "s:1:69: /cloths/0/appearance/weave: expected a number >= 0 (single precision), got -1"}));
    EXPECT_EQ(
        errors_of(cloth("\"size\": [2, 1], \"appearance\": {\"hem\": 0.3}")),
        (Texts{"s:1:52: /cloths/0/appearance/hem: expected at most a quarter of the cloth's shorter side, 0.25 m, "
               "got 0.3"}));
    EXPECT_EQ(errors_of(cloth("\"outline\": {\"path\": \"M0 0H8V8H0Z\", \"spacing\": 0.5}, \"appearance\": {\"hem\": "
                              "0.1}")),
              (Texts{"s:1:88: /cloths/0/appearance/hem: expected no hem of a cloth with an outline, got one"}));
}

TEST(Look, TexturesAreRead) {
    const std::vector<std::string> errors = errors_of(cloth("\"appearance\": {\"texture\": \"nowhere.png\"}"));
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_TRUE(errors[0].starts_with("s:1:40: /cloths/0/appearance/texture: cannot")) << errors[0];
    const std::string no_png = DRAPE_SOURCE_DIR "/tests/scene/given/shape.obj";
    EXPECT_EQ(errors_of(cloth("\"appearance\": {\"texture\": \"" + no_png + "\"}")).size(), 1u);
    Appearance look;
    look.texture = DRAPE_SOURCE_DIR "/tests/scene/given/cells.png";
    read_file(look);
    ASSERT_TRUE(look.image);
    EXPECT_EQ(look.image->rgb.size(), std::size_t{3} * look.image->width * look.image->height);
}

TEST(Look, FabricsHaveTheirOwn) {
    const SceneResult result = read_scene_text(cloth("\"fabric\": \"silk\", \"appearance\": {\"sheen\": 0.9}"), "s");
    ASSERT_TRUE(result.scene);
    EXPECT_EQ(result.scene->cloths[0].appearance.roughness, 0.35);
    EXPECT_EQ(result.scene->cloths[0].appearance.sheen, 0.9);
}

TEST(Look, OfAMovingCameraIsChecked) {
    const std::string way =
        "[{\"t\": 1, \"position\": [0, 0, 1], \"target\": [0, 0, 1]}, {\"t\": 1, \"position\": [1, 0, "
        "1]}]";
    EXPECT_EQ(errors_of("{\"cloths\": [{}], \"camera\": {\"keys\": " + way + "}}"),
              (Texts{"s:1:38: /camera/keys/0: expected a target away from the camera's position, got the same point",
                     "s:1:92: /camera/keys/1/target: expected a target of 3 numbers, got nothing",
                     "s:1:98: /camera/keys/1/t: expected a time after the previous key's 1, got 1"}));
    const SceneResult beside = read_scene_text(
        "{\"cloths\": [{}], \"camera\": {\"position\": [1, 1, 1], \"keys\": [{\"t\": 0, "
        "\"position\": [0, 0, 1], \"target\": [0, 0, 0]}]}}",
        "s");
    EXPECT_EQ(texts(beside.warnings),
              (Texts{"s:1:41: /camera/position: position is ignored beside keys, which have the camera's"}));
}

}  // namespace
}  // namespace drape
