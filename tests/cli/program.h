// Starts the real program and captures its output.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace drape {

struct Outcome {
    int code = 0;              ///< the exit status; 128 + the signal's number when one ended it
    bool by_signal = false;    ///< ended by a signal, not by exit
    std::string out, err;      ///< stdout and stderr
    long peak_memory_kib = 0;  ///< resident
};

struct StartOptions {
    std::filesystem::path folder{};                      ///< working directory; empty: this process's
    std::vector<std::string> environment{};              ///< "NAME=value", added to or replacing this process's
    int stdout_descriptor = -1, stderr_descriptor = -1;  ///< instead of capturing; -1: capture
    bool close_stdout = false, close_stderr = false;
    std::uint64_t file_size_limit = 0;  ///< bytes; 0: none
};

/// A running program is killed at the end of the test if it still runs.
class Running {
  public:
    Running(const std::string& program, std::vector<std::string> arguments, const StartOptions& options = {});
    ~Running();
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    pid_t id() const { return child_; }
    void send(int signal) const;
    /// Waits until the condition holds; false when the program ended before.
    bool wait_until(const std::function<bool()>& condition);
    Outcome wait();

  private:
    using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
    File out_, err_;
    pid_t child_ = -1;
    int status_ = 0;
    long peak_memory_kib_ = 0;
    bool reap(int flags);
};

/// Runs `drape` with these arguments to its end.
Outcome drape(std::vector<std::string> arguments, const StartOptions& options = {});

/// Whether the driver keeps its memory in files, as lavapipe of Mesa 25 does: a limit on the size of files then ends
/// every run by SIGXFSZ or, where that is ignored, by SIGBUS.
bool driver_keeps_memory_in_files();

}  // namespace drape
