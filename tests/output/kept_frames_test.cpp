#include "output/kept_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "output/manifest.h"
#include "output/png.h"
#include "output/png_sequence.h"
#include "temporary_folder.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string key = run_key({"scene", "64x48"});

// Writes three frames of a run as the program does.
std::vector<FileRecord> write_frames(const fs::path& path, const std::string& of_run) {
    OutputFolder folder(path, ExistingFiles::resume);
    PngSequence sequence(folder, 4, 2, of_run);
    for (std::uint64_t frame = 0; frame < 3; ++frame)
        sequence.submit(frame, 5, 3, std::vector<std::uint8_t>(5 * 3 * 4, static_cast<std::uint8_t>(frame)));
    return sequence.finish();
}

std::string refusal(const fs::path& path, const std::string& of_run = key) {
    const std::set<std::string> before = names_in(path);
    const std::string text = error_text<OutputError>([&] {
        const OutputFolder folder(path, ExistingFiles::resume);
        kept_frames(folder, of_run);
    });
    EXPECT_EQ(names_in(path), before);
    return text;
}

TEST(KeptFrames, AreListedAsTheyWereWritten) {
    const TemporaryFolder temporary;
    const std::vector<FileRecord> written = write_frames(temporary / "out", key);
    write_text(temporary / "out/notes.txt", "x");
    write_text(temporary / "out/frame_0007.png.tmp-12", "x");
    const OutputFolder folder(temporary / "out", ExistingFiles::resume);
    std::vector<FileRecord> kept;
    for (const auto& [name, frame] : kept_frames(folder, key)) {
        EXPECT_EQ(name, frame.file.name);
        EXPECT_TRUE(frame.values.empty());
        kept.push_back(frame.file);
    }
    EXPECT_EQ(kept, written);
}

TEST(KeptFrames, GiveTheirValuesBackToTheLastBit) {
    const TemporaryFolder temporary;
    const FrameValues values{{"sheet/stretch_rms", 1.0 / 3}, {"energy_j", -2e-300}, {"penetration_m", 0}, {"count", 7}};
    OutputFolder folder(temporary / "out");
    {
        PngSequence sequence(folder, 4, 1, key);
        sequence.submit(12, 5, 3, std::vector<std::uint8_t>(5 * 3 * 4, 9), values);
        sequence.finish();
    }
    EXPECT_EQ(kept_frames(folder, key).at("frame_0012.png").values, values);
    fs::rename(temporary / "out/frame_0012.png", temporary / "out/frame_0013.png");
    EXPECT_THAT(error_text<OutputError>([&] { kept_frames(folder, key); }),
                HasSubstr("frame_0013.png' holds frame 12: "));
}

TEST(KeptFrames, ValuesThatAreNoNumbersAreDamage) {
    for (const char* tail : {" {\"a\": \"b\"}", " {\"a\": 1", " {\"a\": [1]}"}) {
        const TemporaryFolder temporary;
        std::vector<std::uint8_t> png;
        encode_png(5, 3, std::vector<std::uint8_t>(5 * 3 * 4, 1), png, frame_text(key, 0) + tail);
        fs::create_directory(temporary / "out");
        write_text(temporary / "out/frame_0000.png", std::string(png.begin(), png.end()));
        EXPECT_THAT(refusal(temporary / "out"), HasSubstr("frame_0000.png' is damaged")) << tail;
    }
}

TEST(FrameText, HoldsNoNumberThatIsNotFinite) {
    EXPECT_EQ(frame_text("key", 3), "key frame 3");
    EXPECT_EQ(frame_text("key", 3, {{"b", 0.5}, {"a", 1e-7}}), "key frame 3 {\"a\": 1e-07, \"b\": 0.5}");
    EXPECT_THROW(frame_text("key", 3, {{"a", std::numeric_limits<double>::infinity()}}), OutputError);
}

TEST(KeptFrames, NothingIsKeptOfAnEmptyFolder) {
    const TemporaryFolder temporary;
    const OutputFolder folder(temporary / "new", ExistingFiles::resume);
    EXPECT_TRUE(kept_frames(folder, key).empty());
}

TEST(KeptFrames, ThoseOfAnotherRunAreRefused) {
    const TemporaryFolder temporary;
    write_frames(temporary / "out", key);
    EXPECT_EQ(refusal(temporary / "out"), "");
    EXPECT_THAT(refusal(temporary / "out", run_key({"scene", "64x49"})),
                AllOf(HasSubstr("cannot resume: '" + (temporary / "out/frame_0000.png").string() +
                                "' was drawn by another run"),
                      HasSubstr("--overwrite")));
}

TEST(KeptFrames, ForeignAndDamagedPicturesAreRefused) {
    const TemporaryFolder temporary;
    write_frames(temporary / "none", "");
    EXPECT_THAT(refusal(temporary / "none"), HasSubstr("frame_0000.png' does not say which run drew it"));

    write_frames(temporary / "cut", key);
    const std::string whole = read_text(temporary / "cut/frame_0001.png");
    write_text(temporary / "cut/frame_0001.png", whole.substr(0, whole.size() - 20));
    EXPECT_THAT(refusal(temporary / "cut"), HasSubstr("frame_0001.png' is damaged"));
    write_text(temporary / "cut/frame_0001.png", "");
    EXPECT_THAT(refusal(temporary / "cut"), HasSubstr("frame_0001.png' is damaged"));

    write_frames(temporary / "link", key);
    fs::remove(temporary / "link/frame_0002.png");
    fs::create_symlink("frame_0001.png", temporary / "link/frame_0002.png");
    EXPECT_THAT(refusal(temporary / "link"), HasSubstr("cannot read"));
}

TEST(KeptFrames, ARenamedPictureIsRefused) {
    const TemporaryFolder temporary;
    write_frames(temporary / "out", key);
    fs::rename(temporary / "out/frame_0002.png", temporary / "out/frame_0010.png");
    EXPECT_THAT(refusal(temporary / "out"), HasSubstr("frame_0010.png' holds frame 2"));
    // The same frame among more digits is the same frame.
    fs::rename(temporary / "out/frame_0010.png", temporary / "out/frame_00002.png");
    EXPECT_EQ(refusal(temporary / "out"), "");
}

TEST(KeptFrames, AnotherRunsManifestIsRefused) {
    const TemporaryFolder temporary;
    {
        OutputFolder folder(temporary / "out");
        Manifest manifest;
        manifest.run_key = key;
        write_manifest(folder, manifest);
    }
    EXPECT_EQ(refusal(temporary / "out"), "");
    EXPECT_THAT(refusal(temporary / "out", run_key({"other"})), HasSubstr("manifest.json' is that of another run"));
}

TEST(RunKey, TellsWhereOnePartEnds) {
    EXPECT_NE(run_key({"ab", "c"}), run_key({"a", "bc"}));
    EXPECT_NE(run_key({"a"}), run_key({"a", ""}));
    EXPECT_EQ(run_key({"a", "b"}), run_key({"a", "b"}));
    EXPECT_EQ(run_key({}).size(), 32u);
}

}  // namespace
}  // namespace drape
