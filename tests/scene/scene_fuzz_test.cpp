// Random damage to a valid scene never crashes the reader, and always gives either a scene or an error.
#include <gtest/gtest.h>

#include <random>

#include "drape/scene_reader.h"
#include "full_scene.h"

namespace drape {
namespace {

constexpr std::string_view digits = "0123456789";
constexpr std::string_view telling = "{}[]\",:-0123456789.eE/\\*tn \n\x01\x80\xC3";

// Sanitizers see more in a round than its result, and take forty times as long for one: they have a fifth as many.
#ifdef __SANITIZE_ADDRESS__
constexpr unsigned round_count = 400;
#else
constexpr unsigned round_count = 2000;
#endif

std::string damaged(std::mt19937& random, std::string text) {
    const auto below = [&](std::size_t limit) { return random() % limit; };
    const std::size_t change_count = 1 + below(4);
    for (std::size_t i = 0; i < change_count && !text.empty(); ++i) {
        const std::size_t at = below(text.size());
        const char telling_char = telling[below(telling.size())];
        switch (below(6)) {
            case 0:
                text[at] = static_cast<char>(below(256));
                break;
            case 1:
                text[at] = telling_char;
                break;
            case 2:
                text.insert(at, 1, telling_char);
                break;
            case 3:
                text.erase(at, 1 + below(8));
                break;
            case 4:
                // Another digit leaves the text well-formed, so that what is read as well is damaged, too.
                if (const auto digit = text.find_first_of(digits, at); digit != std::string::npos)
                    text[digit] = digits[below(digits.size())];
                break;
            default:
                text.insert(at, text.substr(below(text.size()), below(64)));
                break;
        }
    }
    return text;
}

TEST(SceneFuzz, DamagedScenesGiveASceneOrErrors) {
    std::mt19937 random(20261129);  // its output is fixed by the standard
    std::size_t scene_count = 0;
    for (unsigned round = 0; round < round_count; ++round) {
        const std::string text = damaged(random, testing::full_scene);
        const SceneResult result = read_scene_text(text, "fuzz");
        ASSERT_NE(result.scene.has_value(), !result.errors.empty()) << text;
        for (const SceneError& error : result.errors) {
            ASSERT_FALSE(error.message.empty()) << text;
            ASSERT_GE(error.line, 1u) << error.text() << text;
            ASSERT_GE(error.column, 1u) << error.text() << text;
        }
        scene_count += result.scene.has_value();
    }
    // Both outcomes must occur, or the damage is not the right kind.
    EXPECT_GT(scene_count, round_count / 100);
    EXPECT_LT(scene_count, round_count / 4 * 3);
}

TEST(SceneFuzz, DamagedOverridesGiveASceneOrErrors) {
    std::mt19937 random(42);
    const std::vector<std::string> sound{"/cloths/0/pins/2/path/1/t=2.5", "/solver={\"substeps\": [1, {\"a\": null}]}",
                                         "/cloths/0/stiffness=rigid", "/a~1b~0/c=\"\\u00e4\""};
    for (unsigned round = 0; round < round_count / 2; ++round) {
        const std::vector<std::string> overrides{damaged(random, sound[random() % sound.size()])};
        const SceneResult result = read_scene_text(testing::full_scene, "fuzz", overrides);
        ASSERT_NE(result.scene.has_value(), !result.errors.empty()) << overrides[0];
    }
}

}  // namespace
}  // namespace drape
