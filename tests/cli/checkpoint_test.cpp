// Killed runs go on from their checkpoints to the bytes of a run that was never disturbed; a file that is no such
// checkpoint is refused, and nothing is changed.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <xxhash.h>

#include <algorithm>
#include <csignal>
#include <cstring>

#include "base/byte_stream.h"
#include "output/journal.h"
#include "output/output_folder.h"
#include "output/section_file.h"
#include "program.h"
#include "run/checkpoints.h"
#include "scenes.h"
#include "simulation/state_checksum.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

/// Method auto, a ball that flies through, a pin that lets go, a blade, two cloths. The cloth that flaps after the pin
/// let go would take 2048 substeps at the default tolerance of motion; so substeps are 12 to 96, and frames are redone
/// all the same.
std::string eventful_scene(int frame_count) {
    return fmt::format(R"({{
  "time": {{"fps": 60, "frames": {}}},
  "wind": {{"velocity": [2, 0, 1], "gust": {{"amplitude": 1}}}},
  "cloths": [
    {{"name": "a", "grid": [10, 9], "size": [0.5, 0.4], "placement": {{"origin": [0, 1, 0]}}, "areal_density": 0.2,
      "pins": [{{"corner": "top_left"}}, {{"corner": "top_right", "release": 0.25}}]}},
    {{"name": "b", "grid": [8, 7], "size": [0.3, 0.4], "placement": {{"origin": [0, 1, 0.3]}}, "areal_density": 0.2,
      "pins": [{{"edge": "top"}}]}}],
  "colliders": {{"spheres": [{{"center": [0.2, 0.8, 0.6], "radius": 0.1,
                              "path": [{{"t": 0}}, {{"t": 0.4, "translate": [0, 0, -0.9]}}]}}]}},
  "cutters": [{{"triangle": [[-0.1, 0.8, -1], [0.5, 0.75, 1], [-0.1, 0.78, 1]], "active": [0.08, 0.2]}}],
  "solver": {{"tolerance_motion": 0.05}},
  "image": {{"size": [48, 32], "samples": 1}}
}})",
                       frame_count);
}

/// Returns the frames from which checkpoints in the folder go on, ascending.
std::vector<int> checkpoints_in(const fs::path& folder) {
    std::vector<int> frames;
    if (!fs::exists(folder)) return frames;
    for (const std::string& name : names_in(folder))
        if (name.starts_with("checkpoint_") && name.ends_with(".drape")) frames.push_back(std::stoi(name.substr(11)));
    std::ranges::sort(frames);
    return frames;
}

std::string checkpoint_name(int frame) { return fmt::format("checkpoint_{:010}.drape", frame); }

/// Kills the program once a checkpoint of frame `least` or later is there; returns the newest one's frame.
int kill_after(int least, const SceneFolder& folder, std::vector<std::string> arguments, int signal = SIGKILL) {
    arguments.insert(arguments.end(), {"-q", "--checkpoint", "0"});
    Running program(DRAPE_PROGRAM, arguments);
    const auto there = [&] {
        const auto frames = checkpoints_in(folder.out());
        return !frames.empty() && frames.back() >= least;
    };
    EXPECT_TRUE(program.wait_until(there)) << program.wait().err;
    program.send(signal);
    EXPECT_EQ(program.wait().code, 128 + signal);
    const auto frames = checkpoints_in(folder.out());
    EXPECT_FALSE(frames.empty());
    EXPECT_LE(frames.size(), 3u);  // two, and one that was about to be removed
    return frames.empty() ? 0 : frames.back();
}

void expect_whole(const SceneFolder& folder, std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"-o", folder.out("whole"), "-q"});
    ASSERT_EQ(drape(arguments).code, 0);
    EXPECT_EQ(lasting_manifest(folder.out()), lasting_manifest(folder.out("whole")));
    auto files = everything_below(folder.out()), whole = everything_below(folder.out("whole"));
    files.erase("manifest.json");
    whole.erase("manifest.json");
    EXPECT_EQ(files, whole);
}

struct Kill {
    const char* name;
    std::vector<std::string> command;
    std::vector<int> after;
    int signal = SIGKILL;
};
void PrintTo(const Kill& each, std::ostream* out) { *out << each.name; }
class CheckpointKills : public testing::TestWithParam<Kill> {};

TEST_P(CheckpointKills, EndWithTheBytesOfAnUnbrokenRun) {
    const SceneFolder folder(eventful_scene(9000));
    std::vector<std::string> arguments = GetParam().command;
    arguments.insert(arguments.begin() + 1, folder.scene());
    std::vector<std::string> into = arguments;
    into.insert(into.end(), {"-o", folder.out()});
    int newest = 0;
    for (const int least : GetParam().after) {
        newest = kill_after(least, folder, into, GetParam().signal);
        if (into.back() != "--resume") into.push_back("--resume");
    }
    const std::string end = std::to_string(newest + 4);
    into.insert(into.end(), {"-e", end});
    const Outcome resumed = drape(into);
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_THAT(resumed.err, HasSubstr(fmt::format("goes on from the checkpoint of frame {}", newest)));
    arguments.insert(arguments.end(), {"-e", end});
    expect_whole(folder, arguments);
}
INSTANTIATE_TEST_SUITE_P(
    Of, CheckpointKills,
    testing::Values(Kill{"Pictures", {"render"}, {3, 20}}, Kill{"Arrays", {"simulate"}, {2, 9, 24}},
                    Kill{"EverySort", {"render", "--export", "npy,npz,pc2,obj", "-j", "2"}, {11}},
                    Kill{"ArraysTerminated", {"simulate", "--export", "npz", "-s", "4"}, {15}, SIGTERM}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(Checkpoint, KeepsWhatContactLeavesOut) {
    const SceneFolder folder(eventful_scene(9000));
    std::vector<std::string> arguments{"simulate", folder.scene(),
                                       "--set",    "/cloths/1/self_collision=true",
                                       "--set",    R"(/colliders/boxes=[{"half_extents": [0.1, 0.1, 0.1]}])"};
    std::vector<std::string> into = arguments;
    into.insert(into.end(), {"-o", folder.out()});
    const std::string end = std::to_string(kill_after(20, folder, into) + 4);  // the cutters have done their work
    into.insert(into.end(), {"--resume", "-e", end});
    const Outcome resumed = drape(into);
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_THAT(resumed.err, HasSubstr("meet no cloth and no edge of a collider"));
    const Json::Value manifest = lasting_manifest(folder.out());
    EXPECT_EQ(manifest["self_collision"]["not_covered"].size(), 2u);
    arguments.insert(arguments.end(), {"-e", end});
    expect_whole(folder, arguments);
}

TEST(Checkpoint, IsLeftWhereARunIsStoppedAndGoneWhenItIsDone) {
    const SceneFolder folder(eventful_scene(9000));
    Running program(DRAPE_PROGRAM, {"render", folder.scene(), "-o", folder.out(), "-q"});
    ASSERT_TRUE(program.wait_until([&] { return fs::exists(folder / "out/frame_0006.png"); })) << program.wait().err;
    EXPECT_TRUE(checkpoints_in(folder.out()).empty()) << "a minute has not passed";
    program.send(SIGTERM);
    const Outcome stopped = program.wait();
    EXPECT_EQ(stopped.code, 143);
    ASSERT_EQ(checkpoints_in(folder.out()).size(), 1u);
    const int next = checkpoints_in(folder.out())[0];
    EXPECT_THAT(stopped.err, HasSubstr(fmt::format("--resume goes on from frame {}", next)));
    const std::string end = std::to_string(next + 2);
    ASSERT_EQ(drape({"render", folder.scene(), "-o", folder.out(), "-q", "--resume", "-e", end}).code, 0);
    EXPECT_TRUE(checkpoints_in(folder.out()).empty());
    EXPECT_FALSE(fs::exists(folder / "out/journal.drape"));
}

/// Files that grow with the frames (arrays, journal) and others (pictures, meshes) meet the limit at different times.
TEST(Checkpoint, AFileSizeLimitEndsTheRunWithNothingTornAndItGoesOn) {
    if (driver_keeps_memory_in_files()) GTEST_SKIP() << "the limit ends the driver first";
    const SceneFolder folder(eventful_scene(30));
    const std::vector<std::string> arguments{"render", folder.scene(), "--export", "npy,npz,obj", "-q"};
    const auto into = [&](const std::string& out, std::vector<std::string> more) {
        more.insert(more.begin(), arguments.begin(), arguments.end());
        more.insert(more.end(), {"-o", out});
        return more;
    };
    ASSERT_EQ(drape(into(folder.out("whole"), {})).code, 0);
    const auto whole = everything_below(folder.out("whole"));
    std::set<std::string> stopped_at;
    for (const std::uint64_t limit : {2048, 8192, 30000, 60000}) {
        const Outcome stopped = drape(into(folder.out(), {"--checkpoint", "0"}), {.file_size_limit = limit});
        EXPECT_EQ(stopped.code, 1) << limit << ": " << stopped.err;
        EXPECT_FALSE(stopped.by_signal) << limit;
        EXPECT_THAT(stopped.err, AllOf(HasSubstr("drape: cannot write '"), HasSubstr("': File too large"))) << limit;
        stopped_at.insert(stopped.err);
        for (const auto& [name, content] : everything_below(folder.out())) {
            EXPECT_LE(content.size(), limit) << name;
            EXPECT_FALSE(is_temporary_file_name(name)) << name;
            if (name.ends_with(".png") || name.ends_with(".obj")) {
                EXPECT_EQ(content, whole.at(name)) << limit << ": " << name;
            }
        }
        const Outcome resumed = drape(into(folder.out(), {"--resume"}));
        ASSERT_EQ(resumed.code, 0) << limit << ": " << resumed.err;
        auto files = everything_below(folder.out());
        for (const auto& [name, content] : whole)
            if (name != "manifest.json") {
                EXPECT_EQ(files[name], content) << limit << ": " << name;
            }
        EXPECT_EQ(files.size(), whole.size()) << limit;
        fs::remove_all(folder.out());
    }
    EXPECT_GE(stopped_at.size(), 2u);
}

TEST(Checkpoint, NeverIsNone) {
    const SceneFolder folder(eventful_scene(9000));
    Running program(DRAPE_PROGRAM, {"render", folder.scene(), "-o", folder.out(), "--checkpoint", "never"});
    ASSERT_TRUE(program.wait_until([&] { return fs::exists(folder / "out/frame_0006.png"); })) << program.wait().err;
    program.send(SIGINT);
    const Outcome stopped = program.wait();
    EXPECT_EQ(stopped.code, 130);
    EXPECT_THAT(stopped.err, HasSubstr("--resume draws the missing ones"));
    EXPECT_TRUE(checkpoints_in(folder.out()).empty());
    EXPECT_EQ(drape({"render", folder.scene(), "-o", folder.out("other"), "--checkpoint", "-1"}).code, 2);
}

class DamagedCheckpoint : public testing::Test {
  protected:
    DamagedCheckpoint() : folder_(eventful_scene(9000)) {
        newest_ = kill_after(8, folder_, {"simulate", folder_.scene(), "-o", folder_.out()});
        frames_ = checkpoints_in(folder_.out());
    }
    Outcome resume(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments{
            "simulate", folder_.scene(), "-o", folder_.out(), "--resume", "-e", std::to_string(newest_ + 2)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return drape(arguments);
    }
    void expect_refused(const std::vector<std::string>& more, const std::string& why) const {
        const auto before = lasting_files();
        const Outcome outcome = resume(more);
        EXPECT_EQ(outcome.code, 1) << outcome.err;
        EXPECT_THAT(outcome.err, AllOf(HasSubstr("cannot resume"), HasSubstr(why)));
        EXPECT_TRUE(lasting_files() == before) << why;
    }
    /// Returns all files but those that the killed run had not finished, which the next one clears away.
    std::map<std::string, std::string> lasting_files() const {
        auto files = everything_below(folder_.out());
        std::erase_if(files, [](const auto& file) { return file.first.find(".tmp-") != std::string::npos; });
        return files;
    }
    void change(const std::string& name, const std::function<void(std::string&)>& how) const {
        std::string bytes = read_text(folder_ / "out" / name);
        how(bytes);
        write_text(folder_ / "out" / name, bytes);
    }
    void change_checkpoints(const std::function<void(std::string&)>& how) const {
        for (const int frame : frames_) change(checkpoint_name(frame), how);
    }

    SceneFolder folder_;
    int newest_ = 0;
    std::vector<int> frames_;
};

TEST_F(DamagedCheckpoint, AFlippedByteAnywhereMakesItUnusable) {
    for (const double place : {0.0, 0.0001, 0.3, 0.9, 0.99999}) {
        const auto flip = [&](std::string& bytes) {
            bytes[static_cast<std::size_t>(place * static_cast<double>(bytes.size()))] ^= 4;
        };
        change_checkpoints(flip);
        expect_refused({}, "remove the checkpoint_*.drape files");
        change_checkpoints(flip);
    }
    EXPECT_EQ(resume().code, 0);
}

TEST_F(DamagedCheckpoint, ShortenedForeignAndOfAnotherVersion) {
    const std::string good = read_text(folder_ / "out" / checkpoint_name(newest_));
    const auto with = [&](const std::string& text, const std::string& why) {
        change_checkpoints([&](std::string& bytes) { bytes = text; });
        expect_refused({}, why);
    };
    for (const std::size_t length : {std::size_t{9}, good.size() / 2, good.size() - 1})
        with(good.substr(0, length), "is damaged");
    with("", "is no checkpoint");
    with("something else", "is no checkpoint");
    std::string later = good;
    later[8] = 2;
    with(later, "is a checkpoint of version 2, and this program reads 1");
    change_checkpoints([&](std::string& bytes) { bytes = good; });
    expect_refused({"--set", "/gravity=[0,-1,0]"}, "was left by another run");
}

TEST_F(DamagedCheckpoint, TheOlderOneServesAndThatIsSaid) {
    ASSERT_GE(frames_.size(), 2u);
    change(checkpoint_name(newest_), [](std::string& bytes) { bytes.resize(bytes.size() / 2); });
    const Outcome outcome = resume();
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr(checkpoint_name(newest_)), HasSubstr("is damaged"),
                      HasSubstr(fmt::format("goes on from the checkpoint of frame {}", frames_[frames_.size() - 2]))));
    expect_whole(folder_, {"simulate", folder_.scene(), "-e", std::to_string(newest_ + 2)});
}

TEST_F(DamagedCheckpoint, SoIsOneWhoseJournalIs) {
    change("journal.drape", [](std::string& bytes) { bytes[bytes.size() / 3] ^= 1; });
    expect_refused({}, "journal.drape' is damaged at byte ");
    fs::remove(folder_ / "out/journal.drape");
    expect_refused({}, "journal.drape");
    for (const int frame : frames_) fs::remove(folder_ / "out" / checkpoint_name(frame));
    const Outcome outcome = resume();
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, Not(HasSubstr("checkpoint")));
}

/// Returns the journal with its records changed by `how`, and with sums that fit.
std::string changed_journal(const std::string& text, const std::function<void(JournalRecord&)>& how) {
    ByteReader reader(std::as_bytes(std::span(text)));
    std::uint64_t magic = 0, size = 0, sum = 0;
    std::uint32_t version = 0;
    std::string key;
    reader(magic, version, key);
    ByteWriter writer;
    writer(magic, version, key);
    while (reader.left() > 0) {
        reader(size);
        JournalRecord record = decode_record(reader.get_bytes(size));
        reader(sum);
        how(record);
        const std::vector<std::byte> content = encode_record(record);
        writer(std::uint64_t{content.size()});
        writer.put_bytes(content);
        writer(std::uint64_t{XXH3_64bits(content.data(), content.size())});
    }
    const std::vector<std::byte> bytes = writer.take();
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string changed_checkpoint(const std::string& text, const std::function<void(RunCheckpoint&)>& how) {
    std::string key;
    RunCheckpoint checkpoint = checkpoint_of(decode_sections(checkpoint_format, std::as_bytes(std::span(text))), key);
    how(checkpoint);
    const std::vector<std::byte> bytes = encode_sections(checkpoint_format, sections_of(checkpoint, key));
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST_F(DamagedCheckpoint, AJournalOfOtherClothsIsRefusedThoughItsSumsFit) {
    const std::string good = read_text(folder_ / "out/journal.drape");
    const auto with = [&](const std::function<void(JournalRecord&)>& how) {
        change("journal.drape", [&](std::string& bytes) { bytes = changed_journal(good, how); });
        expect_refused({}, "journal.drape' is damaged at byte ");
    };
    with([](JournalRecord& record) { record.cloth = 2; });
    with([](JournalRecord& record) {
        if (!record.faces.empty()) record.faces.back() = 90;  // the last of 10 x 9 particles is 89
    });
    with([](JournalRecord& record) {
        if (!record.spring_bits.empty()) record.spring_bits.pop_back();
    });
    with([](JournalRecord& record) { record.tensions = record.positions; });
    with([](JournalRecord& record) {
        if (record.positions.empty()) return;
        std::vector<float>&one = record.positions[0], &other = record.positions[1];
        other.insert(other.end(), one.end() - 4, one.end());
        one.resize(one.size() - 4);
    });
    change("journal.drape", [&](std::string& bytes) { bytes = changed_journal(good, [](JournalRecord&) {}); });
    EXPECT_EQ(resume().code, 0);
}

TEST_F(DamagedCheckpoint, NumbersThatNoRunComesToAreRefusedThoughTheSumFits) {
    const std::string good = read_text(folder_ / "out" / checkpoint_name(newest_));
    const auto with = [&](const std::function<void(RunCheckpoint&)>& how, const std::string& why) {
        change_checkpoints([&](std::string& bytes) { bytes = changed_checkpoint(good, how); });
        expect_refused({}, why);
    };
    const auto in_loop = [](std::size_t place, std::uint32_t number) {  // engine/docs/checkpoint.md
        return [=](RunCheckpoint& checkpoint) {
            std::memcpy(checkpoint.state.at("loop").data() + place, &number, sizeof number);
            seal(checkpoint.state);
        };
    };
    with(in_loop(4, 0), "the saved state is not of this scene");
    with(in_loop(0, 0xffffffffu), "the saved state is not of this scene");
    with(in_loop(0, 2'000'000), "the saved state is not of this scene");
    // The checkpoint and a record of the journal agree on more bytes than there can be.
    change("journal.drape", [](std::string& bytes) {
        std::uint64_t key_length = 0;
        std::memcpy(&key_length, bytes.data() + 12, sizeof key_length);
        bytes[20 + key_length + 7] = 0x10;  // the length's highest byte
    });
    with([](RunCheckpoint& checkpoint) { checkpoint.journal_length = std::uint64_t{1} << 62; },
         "journal.drape' is damaged");
}

TEST(Checkpoint, IsNoUseWhereAPictureBeforeItIsGone) {
    const SceneFolder folder(eventful_scene(9000));
    const int newest = kill_after(7, folder, {"render", folder.scene(), "-o", folder.out()});
    fs::remove(folder / "out/frame_0002.png");
    const std::string end = std::to_string(newest + 2);
    const Outcome resumed = drape({"render", folder.scene(), "-o", folder.out(), "--resume", "-e", end});
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_THAT(resumed.err, HasSubstr("everything is simulated again, from frame 0"));
    expect_whole(folder, {"render", folder.scene(), "-e", end});
}

}  // namespace
}  // namespace drape
