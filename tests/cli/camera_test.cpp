// `drape camera` finds a camera whose pictures hold a scene's motion with a tenth to spare, and no more.
#include "picture/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/reader.h>
#include <json/value.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::HasSubstr;

Camera camera_of(const std::string& text) {
    Json::Value json;
    std::istringstream(text) >> json;
    Camera camera;
    for (Json::ArrayIndex k = 0; k < 3; ++k) {
        camera.position[k] = json["position"][k].asDouble();
        camera.target[k] = json["target"][k].asDouble();
    }
    camera.fov = json["fov"].asDouble();
    return camera;
}

/// Returns how far from the picture's middle some vertex of OBJ files is: 1 at an edge.
double farthest(const Camera& camera, const std::filesystem::path& folder) {
    double most = 0;
    for (const auto& file : std::filesystem::directory_iterator(folder)) {
        if (file.path().extension() != ".obj") continue;
        std::ifstream lines(file.path());
        for (std::string word; lines >> word;) {
            Vec3 at;
            if (word != "v" || !(lines >> at[0] >> at[1] >> at[2])) continue;
            const PixelPosition seen = project(camera, 64, 48, at);
            most = std::max({most, std::abs(seen.x / 32 - 1), std::abs(seen.y / 24 - 1)});
        }
    }
    return most;
}

TEST(Camera, HoldsTheMotionWithATenthToSpare) {
    const SceneFolder folder(small_scene(31));
    // Without the floor, of which the files have a square.
    const std::vector<std::string> blown{"--set", R"(/wind={"velocity": [0, 0, 9]})", "--set", "/colliders={}"};
    const auto with_wind = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), blown.begin(), blown.end());
        return drape(arguments);
    };
    ASSERT_EQ(with_wind({"simulate", folder.scene(), "-o", folder.out(), "--export", "obj"}).code, 0);
    const Outcome found = with_wind({"camera", folder.scene(), "--validate"});
    ASSERT_EQ(found.code, 0) << found.err;
    EXPECT_NEAR(farthest(camera_of(found.out), folder / "out"), 0.9, 2e-3);
    const Outcome first = with_wind({"camera", folder.scene(), "-e", "0"});
    EXPECT_GT(farthest(camera_of(first.out), folder / "out"), 1) << "the wind blows it out of the start's picture";
    EXPECT_EQ(
        with_wind({"render", folder.scene(), "-o", folder.out("drawn"), "-e", "1", "--set", "/camera=" + found.out})
            .code,
        0);
}

TEST(Camera, NeedsAFrame) {
    const SceneFolder folder(small_scene(3));
    const Outcome late = drape({"camera", folder.scene(), "-s", "5"});
    EXPECT_EQ(late.code, 2);
    EXPECT_THAT(late.err, HasSubstr("--start 5 is after the last frame 2"));
}

}  // namespace
}  // namespace drape
