// The manifest holds the view of `drape render --view`, which is part of the run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/value.h>

#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::HasSubstr;

TEST(View, IsInTheManifestWithItsRange) {
    const SceneFolder folder(small_scene(2));
    for (const char* view : {"shaded", "stretch", "warp", "weft", "wire", "normals"}) {
        ASSERT_EQ(drape({"render", folder.scene(), "-o", folder.out(view), "-e", "1", "--view", view, "--size",
                         "200x150", "--validate"})
                      .code,
                  0)
            << view;
        EXPECT_TRUE(is_whole_picture(folder / view / "frame_0001.png", 200, 150));
        const Json::Value picture = lasting_manifest(folder / view)["picture"];
        EXPECT_EQ(picture["view"].asString(), std::string(view) == "shaded" ? "" : view);
        const bool heat = std::string(view) == "stretch" || std::string(view) == "warp" || std::string(view) == "weft";
        EXPECT_EQ(picture.isMember("strain_range"), heat) << view;
    }
    ASSERT_EQ(drape({"render", folder.scene(), "-o", folder.out("ranged"), "-e", "0", "--view", "warp", "--view-range",
                     "2.5"})
                  .code,
              0);
    EXPECT_DOUBLE_EQ(lasting_manifest(folder / "ranged")["picture"]["strain_range"].asDouble(), 0.025);
}

TEST(View, IsPartOfTheRun) {
    const SceneFolder folder(small_scene(3));
    ASSERT_EQ(drape({"render", folder.scene(), "-o", folder.out(), "--view", "wire"}).code, 0);
    std::filesystem::remove(folder / "out/manifest.json");
    const Outcome other = drape({"render", folder.scene(), "-o", folder.out(), "--resume"});
    EXPECT_EQ(other.code, 1);
    EXPECT_THAT(other.err, HasSubstr("was drawn by another run (other scene, size, samples, view,"));
    EXPECT_EQ(drape({"render", folder.scene(), "-o", folder.out(), "--view", "wire", "--resume"}).code, 0);
}

}  // namespace
}  // namespace drape
