// What takes long before there is a frame to count is told on a terminal, and nowhere else.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>

#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string small = R"({"name": "small", "time": {"frames": 1}, "cloths": [{"grid": [3, 3]}]})";

/// A terminal of which this process has the other end.
class Terminal {
  public:
    Terminal() : ours_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK)) {
        if (ours_ < 0 || grantpt(ours_) != 0 || unlockpt(ours_) != 0) return;
        theirs_ = open(ptsname(ours_), O_RDWR | O_NOCTTY | O_CLOEXEC);
    }
    ~Terminal() {
        close(ours_);
        close(theirs_);
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    int theirs() const { return theirs_; }
    /// Returns all that was written so far.
    const std::string& text() {
        char part[256];
        for (ssize_t count; (count = read(ours_, part, sizeof part)) > 0;)
            text_.append(part, static_cast<std::size_t>(count));
        return text_;
    }

  private:
    int ours_, theirs_ = -1;
    std::string text_;
};

/// A scene from a pipe that says nothing until told to.
class LateScene {
  public:
    explicit LateScene(const SceneFolder& folder) : path_((folder / "late.json").string()) {
        if (mkfifo(path_.c_str(), 0600) != 0) throw std::runtime_error("no pipe can be made");
        pipe_ = open(path_.c_str(), O_RDWR | O_CLOEXEC);  // opened to read too: opening waits for nobody
    }
    ~LateScene() { come(""); }
    LateScene(const LateScene&) = delete;
    LateScene& operator=(const LateScene&) = delete;

    const std::string& path() const { return path_; }
    void come(const std::string& text) {
        if (pipe_ < 0) return;
        EXPECT_EQ(write(pipe_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
        close(pipe_);
        pipe_ = -1;
    }

  private:
    std::string path_;
    int pipe_ = -1;
};

TEST(SlowStart, IsToldOnATerminal) {
    for (const std::vector<std::string>& command : {std::vector<std::string>{"check"}, {"simulate", "-o", "out"}}) {
        const SceneFolder folder(small);
        LateScene late(folder);
        Terminal terminal;
        ASSERT_GE(terminal.theirs(), 0);
        std::vector<std::string> arguments = command;
        arguments.push_back(late.path());
        if (arguments[0] == "simulate") arguments[2] = folder.out();
        Running running(DRAPE_PROGRAM, arguments, {.stderr_descriptor = terminal.theirs()});
        EXPECT_TRUE(running.wait_until([&] {
            return terminal.text().find("late.json: still being read and ") != std::string::npos;
        })) << terminal.text();
        late.come(small);
        EXPECT_EQ(running.wait().code, 0) << terminal.text();
    }
}

TEST(SlowStart, IsNotToldElsewhereNorWhereItIsSoonOver) {
    const SceneFolder folder(small);
    Terminal terminal;
    ASSERT_GE(terminal.theirs(), 0);
    EXPECT_EQ(Running(DRAPE_PROGRAM, {"check", folder.scene()}, {.stderr_descriptor = terminal.theirs()}).wait().code,
              0);
    EXPECT_THAT(terminal.text(), Not(HasSubstr("still")));
    LateScene late(folder);
    Running running(DRAPE_PROGRAM, {"check", late.path()});
    const auto begun = std::chrono::steady_clock::now();
    running.wait_until([&] { return std::chrono::steady_clock::now() - begun > std::chrono::milliseconds(3500); });
    late.come(small);
    const Outcome outcome = running.wait();
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
}

}  // namespace
}  // namespace drape
