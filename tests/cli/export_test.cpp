// --export writes every format beside the others and beside pictures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "input/positions_file.h"
#include "output/frame_writer.h"
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
    std::string all = "ply";
    for (const OutputFormat* format : output_formats()) {
        if (!exported(*format, false)) continue;
        alone.merge(run(std::string(format->name)));
        all.insert(0, std::string(format->name) + ",");
    }
    // npy npz pc2, obj and ply with the plane, usda of cloth, plane and both, vtu with two collections, mgn,
    // eight kinds of layers of four frames
    EXPECT_EQ(alone.size(), 1u + 1 + 2 + 5 + 5 + 3 + 7 + 1 + 8 * 4);
    EXPECT_EQ(run(all), alone);
    EXPECT_EQ(alone.at("positions.pc2").substr(32), alone.at("positions.npy").substr(128));
    EXPECT_EQ(lasting_manifest(folder.out(all))["files"].size(), alone.size());
}

TEST(Export, TakesOneWordSoThatTheSceneMayFollow) {
    const SceneFolder folder(small_scene(2));
    const Outcome outcome = drape({"simulate", "-q", "-o", folder.out(), "--export", "obj,ply", folder.scene()});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(without_manifest(everything_below(folder.out())).size(), 2u * (2 + 1));
    const Outcome twice =
        drape({"simulate", "-q", "-o", folder.out("twice"), "--export", "obj", "--export", "ply", folder.scene()});
    EXPECT_EQ(twice.code, 0) << twice.err;
    EXPECT_EQ(without_manifest(everything_below(folder.out("twice"))),
              without_manifest(everything_below(folder.out())));
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
    EXPECT_THAT(names_in(folder.out()),
                testing::ElementsAre("colliders.obj", "manifest.json", "mesh_0000.obj", "mesh_0001.obj"));
}

// The ball is where its path has it in the frame; what stands still is written once.
TEST(Export, CollidersThatMoveHaveAFilePerFrame) {
    const SceneFolder folder(R"({"time": {"frames": 91, "fps": 60}, "solver": {"method": "relax", "substeps": 4},
        "cloths": [{"grid": [4, 4], "placement": {"origin": [0, 3, 0]}}],
        "colliders": {"boxes": [{"center": [5, 0, 0]}],
                      "spheres": [{"center": [0, 1, 0], "radius": 0.25, "path": [{"t": 0}, {"t": 1, "translate": [2, 0, 0]}]}]}})");
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--step", "30", "--export", "obj"}).code, 0);
    EXPECT_THAT(names_in(folder.out()),
                testing::ElementsAre("colliders.obj", "colliders_0000.obj", "colliders_0030.obj", "colliders_0060.obj",
                                     "colliders_0090.obj", "manifest.json", "mesh_0000.obj", "mesh_0030.obj",
                                     "mesh_0060.obj", "mesh_0090.obj"));
    EXPECT_EQ(lasting_manifest(folder.out())["files"].size(), 9u);
    EXPECT_THAT(read_text(folder / "out/colliders.obj"), testing::HasSubstr("\no collider_1_box\n"));
    for (const auto& [frame, x] : std::map<std::string, double>{{"0000", 0}, {"0030", 1}, {"0060", 2}, {"0090", 2}}) {
        std::istringstream lines(read_text(folder / ("out/colliders_" + frame + ".obj")));
        double low = 1e9, high = -1e9;
        for (std::string line; std::getline(lines, line);) {
            double at = 0;
            if (std::sscanf(line.c_str(), "v %lf", &at) != 1) continue;
            low = std::min(low, at), high = std::max(high, at);
        }
        EXPECT_NEAR(low, x - 0.25, 1e-6) << frame;
        EXPECT_NEAR(high, x + 0.25, 1e-6) << frame;
    }
}

// Its last frame can still be the start of another run.
TEST(Export, ArchivesMayBePacked) {
    const SceneFolder folder(small_scene(4));
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out("plain"), "-q"}).code, 0);
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out("packed"), "-q", "--compress"}).code, 0);
    EXPECT_EQ(read_text(folder / "packed/positions.npy"), read_text(folder / "plain/positions.npy"));
    EXPECT_LT(read_text(folder / "packed/positions.npz").size(), read_text(folder / "plain/positions.npz").size() / 2);
    const auto shape = [&](const char* run) { return input::read_positions(folder / run / "positions.npz", 8, 6); };
    EXPECT_EQ(shape("packed"), shape("plain"));
    const Outcome none = drape({"simulate", folder.scene(), "-o", folder.out("obj"), "--export", "obj", "--compress"});
    EXPECT_EQ(none.code, 2);
    EXPECT_THAT(none.err, testing::HasSubstr("--compress: no format that is written is an archive"));
}

TEST(Export, PointCachesAndMeshesOfAClothWithAHoleAreStartsOfIt) {
    const SceneFolder folder(R"({"time": {"frames": 3}, "cloths": [{"grid": [9, 7], "size": [0.8, 0.6],
        "holes": [[[2, 2], [4, 4]]], "pins": [{"edge": "top"}]}]})");
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out("a"), "--export", "npz,pc2", "-q"}).code, 0);
    const auto all = input::read_positions(folder / "a/positions.npz", 9, 7);
    for (const std::string kind : {"pc2", "obj"}) {
        const Outcome outcome = drape({"simulate", folder.scene(), "-o", folder.out(kind), "-q", "--set",
                                       "/cloths/0/start=\"a/positions." + kind + "\"", "--set", "/time/frames=1"});
        ASSERT_EQ(outcome.code, 0) << outcome.err;
    }
    const auto found = input::read_positions(folder / "pc2/positions.npz", 9, 7);
    for (std::size_t i = 0; i < all.size(); ++i)
        if (i != 3 * 9 + 3) {  // that one lies in the hole
            EXPECT_EQ(found[i], all[i]) << i;
        }
}

TEST(Export, TheArchiveHasWhatMakesTheRunAgain) {
    if (std::system("/usr/bin/python3 -c 'import numpy' 2>/dev/null") != 0) GTEST_SKIP() << "no NumPy";
    const SceneFolder folder(small_scene(9));
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--set", "/gravity=[0,-5,0]"}).code, 0);
    write_text(folder / "check.py", R"(
import json, numpy
run, manifest = numpy.load("out/positions.npz"), json.load(open("out/manifest.json"))
for frame, statistics in enumerate(manifest["statistics"]):
    for name, value in statistics.items():
        if name.startswith("sheet/"):
            assert run[name[6:]][frame] == value, (frame, name)
speed = numpy.sqrt((run["velocities"].astype(float) ** 2).sum(-1)).max((1, 2))
assert numpy.allclose(speed, run["speed_max_m_s"], rtol=1e-6), (speed, run["speed_max_m_s"])
assert speed[-1] > 0.1 and (run["positions"] == numpy.load("out/positions.npy")).all()
scene = json.loads(run["scene"].item())
assert scene["gravity"] == [0, -5, 0] and scene["wind"]["air_density"] == 1.2 and scene["cloths"][0]["name"] == "sheet"
assert "radii" not in scene["colliders"] and json.loads(run["parameters"].item())["substeps"] == 4
json.dump(scene, open("again.json", "w"))
)");
    ASSERT_EQ(std::system(("cd " + folder.path().string() + " && /usr/bin/python3 check.py").c_str()), 0);
    ASSERT_EQ(drape({"simulate", (folder / "again.json").string(), "-o", folder.out("again"), "-q"}).code, 0);
    EXPECT_EQ(read_text(folder / "again/positions.npy"), read_text(folder / "out/positions.npy"));
}

/// A strip is drawn apart by its ends.
constexpr const char* torn_strip = R"({"time": {"frames": 31}, "gravity": [0, 0, 0],
  "cloths": [{"grid": [5, 13], "size": [0.1, 0.3], "tear": {"tension": 120}, "damping": 5,
              "pins": [{"edge": "top"}, {"edge": "bottom", "path": [{"t": 0}, {"t": 0.5, "translate": [0, -0.06, 0]}]}]}],
  "solver": {"method": "line", "substeps": 8}})";

TEST(Export, WhatTearsIsToldOfAndIsNoTrajectory) {
    const SceneFolder folder(torn_strip);
    ASSERT_EQ(drape({"simulate", folder.scene(), "-o", folder.out(), "-q", "--export", "obj"}).code, 0);
    std::uint32_t torn = 0, split = 0, pieces = 0;
    const Json::Value manifest = lasting_manifest(folder.out());
    for (const Json::Value& cut : manifest["cuts"]) {
        EXPECT_EQ(cut["torn"], cut["springs"]) << "there is no cutter";
        torn += cut["torn"].asUInt();
        split += cut["triangles"].asUInt();
        pieces = cut["pieces"].asUInt();
    }
    EXPECT_GE(torn, 5u + 4u + 4u);
    EXPECT_EQ(pieces, 2u);
    const auto faces = [&](const std::string& frame) {
        const std::string text = read_text(fs::path(folder.out()) / ("mesh_" + frame + ".obj"));
        std::uint32_t count = 0;
        for (std::size_t at = text.find("\nf "); at != text.npos; at = text.find("\nf ", at + 1)) ++count;
        return count;
    };
    EXPECT_EQ(faces("0000"), 2u * 4 * 12);
    EXPECT_EQ(faces("0030"), faces("0000") - split);
    const Outcome refused =
        drape({"simulate", folder.scene(), "-o", folder.out("trajectory"), "-q", "--export", "mgn"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, testing::HasSubstr("its faces cannot change, but the scene has cloth that tears"));
}

TEST(Video, IsAllThatStdoutGetsAndWhatAFileWouldHave) {
    const SceneFolder folder(small_scene(4));
    const Outcome piped = drape({"render", folder.scene(), "-o", "-"}, {.folder = folder.path()});
    EXPECT_EQ(piped.code, 0) << piped.err;
    EXPECT_THAT(piped.err, testing::HasSubstr("4 frames to stdout"));
    EXPECT_THAT(piped.out, testing::StartsWith("YUV4MPEG2 W64 H48 F60:1 "));
    EXPECT_EQ(piped.out.size(), piped.out.find('\n') + 1 + 4 * (6 + 64 * 48 * 3 / 2));
    EXPECT_THAT(names_in(folder.path()), testing::ElementsAre("scene.json"));
    const Outcome pixels = drape({"render", folder.scene(), "-o", "-", "-q", "--export", "rgb"});
    ASSERT_EQ(drape({"render", folder.scene(), "-o", folder.out(), "-q", "--export", "y4m,rgb"}).code, 0);
    EXPECT_TRUE(piped.out == read_text(folder / "out/video.y4m"));
    EXPECT_TRUE(pixels.out == read_text(folder / "out/video.rgb"));
    EXPECT_EQ(lasting_manifest(folder.out())["files"].size(), 6u);
}

}  // namespace
}  // namespace drape
