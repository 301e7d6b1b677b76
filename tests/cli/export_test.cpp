// --export: every format beside the others and beside pictures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;

Files without_manifest(Files files) {
    files.erase("manifest.json");
    return files;
}

TEST(Export, FormatsTogetherAreWhatEachIsAlone) {
    const SceneFolder folder(small_scene(4));
    const auto run = [&](const std::string& formats) {
        const Outcome outcome =
            drape({"simulate", folder.scene(), "-o", folder.out(formats), "-q", "--export", formats});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return without_manifest(everything_below(folder.out(formats)));
    };
    Files alone;
    for (const char* format : {"npy", "npz", "pc2", "obj", "ply"}) alone.merge(run(format));
    EXPECT_EQ(alone.size(), 1u + 1 + 2 + 4 + 4);
    EXPECT_EQ(run("npy,ply,npz,obj,pc2,ply"), alone);
    EXPECT_EQ(alone.at("positions.pc2").substr(32), alone.at("positions.npy").substr(128));
    EXPECT_EQ(lasting_manifest(folder.out("npy,ply,npz,obj,pc2,ply"))["files"].size(), alone.size());
}

TEST(Export, BesidePicturesChangesNeitherAndResumes) {
    const SceneFolder folder(small_scene(4));
    const std::vector<std::string> both{"render", folder.scene(), "-o",     folder.out("both"),
                                        "-q",     "--export",     "npy,obj"};
    ASSERT_EQ(drape(both).code, 0);
    ASSERT_EQ(drape({"render", folder.scene(), "-o", folder.out("drawn"), "-q"}).code, 0);
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out("plain"), "-q", "--export", "npy,obj"}).code, 0);
    Files expected = everything_below(folder.out("drawn"));
    expected.merge(without_manifest(everything_below(folder.out("plain"))));
    const Files files = everything_below(folder.out("both"));
    EXPECT_EQ(without_manifest(files), without_manifest(expected));

    const Json::Value manifest = lasting_manifest(folder.out("both"));
    for (const char* name : {"manifest.json", "frame_0001.png", "positions.npy"})
        fs::remove(folder / ("both/" + std::string(name)));
    std::vector<std::string> again = both;
    again.push_back("--resume");
    ASSERT_EQ(drape(again).code, 0);
    EXPECT_EQ(without_manifest(everything_below(folder.out("both"))), without_manifest(files));
    EXPECT_EQ(lasting_manifest(folder.out("both")), manifest);
}

TEST(Export, ResumingLeavesNoMeshOfAnotherRun) {
    const SceneFolder folder(small_scene(4));
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--export", "obj"}).code, 0);
    fs::remove(folder / "out/manifest.json");
    ASSERT_EQ(
        drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--export", "obj", "-e", "1", "--resume"}).code,
        0);
    EXPECT_THAT(names_in(folder.out()), testing::ElementsAre("manifest.json", "mesh_0000.obj", "mesh_0001.obj"));
}

}  // namespace
}  // namespace drape
