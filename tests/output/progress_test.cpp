#include "output/progress.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "temporary_folder.h"

namespace drape {
namespace {

struct Screen {
    double now = 100;
    std::string text;

    Progress::Options options(bool is_terminal, bool is_quiet = false) {
        return {is_quiet, is_terminal, [this] { return now; }, [this](std::string_view part) { text += part; }};
    }
};

TEST(Progress, TerminalRedrawsOneLine) {
    Screen screen;
    {
        Progress progress(3, screen.options(true));
        for (int frame = 0; frame < 3; ++frame) {
            screen.now += 1.5;
            progress.frame_done(10 + 2 * frame);
        }
    }
    EXPECT_EQ(screen.text,
              "\rframe 10 (1/3, 33 %)  1500.0 ms/frame  ETA 0:03\x1b[K"
              "\rframe 12 (2/3, 66 %)  1500.0 ms/frame  ETA 0:02\x1b[K"
              "\rframe 14 (3/3, 100 %)  1500.0 ms/frame  ETA 0:00\x1b[K\n");
}

TEST(Progress, ALongFrameSaysWhatIsDoneToIt) {
    Screen screen;
    Progress progress(3, screen.options(true));
    progress.frame_begun(0, 4, 1);
    EXPECT_EQ(screen.text, "") << "it need not be long";
    screen.now += 2;
    progress.frame_begun(0, 64, 2);
    EXPECT_EQ(screen.text, "\rframe 0, 64 substeps, attempt 2 (0/3, 0 %)\x1b[K");
    screen.text.clear();
    screen.now += 1;
    progress.frame_done(0, "a note");
    EXPECT_EQ(screen.text, "\rframe 0 (1/3, 33 %)  3000.0 ms/frame  ETA 0:06  a note\x1b[K");
    screen.text.clear();
    screen.now += 2;
    progress.frame_begun(1, 128, 3);
    EXPECT_EQ(screen.text, "\rframe 1, 128 substeps, attempt 3 (1/3, 33 %)  3000.0 ms/frame  ETA 0:06\x1b[K");
}

TEST(Progress, TerminalIsRedrawnTenTimesASecondAtMost) {
    Screen screen;
    Progress progress(10001, screen.options(true));
    for (int frame = 0; frame < 10000; ++frame) {  // 1 ms each: 10 s
        screen.now += 0.001;
        progress.frame_done(frame);
    }
    const auto redraw_count = std::ranges::count(screen.text, '\r');
    EXPECT_GE(redraw_count, 90);
    EXPECT_LE(redraw_count, 102);
}

TEST(Progress, FileGetsALineEveryTenPerCent) {
    Screen screen;
    Progress progress(40, screen.options(false));
    for (int frame = 0; frame < 40; ++frame) {
        screen.now += 0.25;
        progress.frame_done(frame);
    }
    progress.finish();
    EXPECT_EQ(std::ranges::count(screen.text, '\n'), 10);
    EXPECT_EQ(screen.text.substr(0, screen.text.find('\n')), "frame 3 (4/40, 10 %)  250.0 ms/frame  ETA 0:09");
    EXPECT_EQ(screen.text.find('\x1b'), std::string::npos);
    EXPECT_EQ(screen.text.find('\r'), std::string::npos);
    EXPECT_TRUE(screen.text.ends_with("frame 39 (40/40, 100 %)  250.0 ms/frame  ETA 0:00\n"));
}

TEST(Progress, SlowRunsGetALineEveryThirtySeconds) {
    Screen screen;
    Progress progress(100000, screen.options(false));
    for (int frame = 0; frame < 60; ++frame) {
        screen.now += 2;
        progress.frame_done(frame);
    }
    EXPECT_EQ(std::ranges::count(screen.text, '\n'), 4);
    EXPECT_EQ(screen.text.substr(0, screen.text.find('\n')),
              "frame 14 (15/100000, 0 %)  2000.0 ms/frame  ETA 55:32:50");
}

TEST(Progress, RateFollowsTheLatestFrames) {
    Screen screen;
    Progress progress(200, screen.options(false));
    screen.now += 50;  // the first frame built the pipelines
    progress.frame_done(0);
    for (int frame = 1; frame < 100; ++frame) {
        screen.now += 0.01;
        progress.frame_done(frame);
    }
    EXPECT_NE(screen.text.find("frame 99 (100/200, 50 %)  10.0 ms/frame  ETA 0:01\n"), std::string::npos)
        << screen.text;
}

TEST(Progress, ANoteOnTheFrameEndsTheLine) {
    Screen screen;
    Progress progress(2, screen.options(false));
    screen.now += 1;
    progress.frame_done(0, "stretch 0.52 % RMS, 3.1 % max");
    screen.now += 1;
    progress.frame_done(1);
    EXPECT_EQ(screen.text,
              "frame 0 (1/2, 50 %)  1000.0 ms/frame  ETA 0:01  stretch 0.52 % RMS, 3.1 % max\n"
              "frame 1 (2/2, 100 %)  1000.0 ms/frame  ETA 0:00\n");
}

TEST(Progress, ALineIsNoLongerThanTheTerminalIsWide) {
    for (const bool is_terminal : {true, false}) {
        Screen screen;
        Progress::Options options = screen.options(is_terminal);
        options.columns = 60;
        Progress progress(1, options);
        screen.now += 1;
        progress.frame_done(0, "stretch 0.52 % RMS, 3.1 % max");
        EXPECT_EQ(screen.text,
                  is_terminal ? "\rframe 0 (1/1, 100 %)  1000.0 ms/frame  ETA 0:00  stretch 0.\x1b[K"
                              : "frame 0 (1/1, 100 %)  1000.0 ms/frame  ETA 0:00  stretch 0.52 % RMS, 3.1 % max\n");
    }
}

TEST(Progress, MessagesDoNotTearTheLine) {
    Screen screen;
    Progress progress(2, screen.options(true));
    screen.now += 1;
    progress.frame_done(0);
    screen.text.clear();
    progress.message("warning: stretched");
    EXPECT_EQ(screen.text, "\r\x1b[Kwarning: stretched\nframe 0 (1/2, 50 %)  1000.0 ms/frame  ETA 0:01");
}

TEST(Progress, QuietSaysNothingButMessages) {
    for (const bool is_terminal : {true, false}) {
        Screen screen;
        {
            Progress progress(2, screen.options(is_terminal, true));
            screen.now += 100;
            progress.frame_done(0);
            progress.frame_done(1);
            progress.message("warning");
        }
        EXPECT_EQ(screen.text, "warning\n");
    }
}

// Returns whether the process may redraw a line when its stderr is this device and TERM has this value.
bool redraws(const char* device, const char* terminal) {
    const int status = wait_for(start_child([&] {
        const int target = open(device, O_RDWR | O_NOCTTY);
        if (target < 0 || dup2(target, STDERR_FILENO) < 0) return 2;
        setenv("TERM", terminal, 1);
        return Progress::standard_options(false).is_terminal ? 1 : 0;
    }));
    EXPECT_LE(status, 1);
    return status == 1;
}

TEST(Progress, StandardOptionsRedrawOnlyOnACapableTerminal) {
    const int pseudo_terminal = posix_openpt(O_RDWR | O_NOCTTY);
    ASSERT_GE(pseudo_terminal, 0);
    ASSERT_EQ(grantpt(pseudo_terminal), 0);
    ASSERT_EQ(unlockpt(pseudo_terminal), 0);
    EXPECT_TRUE(redraws(ptsname(pseudo_terminal), "xterm"));
    EXPECT_FALSE(redraws(ptsname(pseudo_terminal), "dumb"));
    EXPECT_FALSE(redraws("/dev/null", "xterm"));
    close(pseudo_terminal);
}

TEST(Progress, StandardClockRuns) {
    const auto options = Progress::standard_options(true);
    const double before = options.seconds();
    usleep(2000);
    const double waited = options.seconds() - before;
    EXPECT_GE(waited, 0.002);
    EXPECT_LT(waited, 60);
}

}  // namespace
}  // namespace drape
