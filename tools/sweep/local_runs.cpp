#include "sweep/local_runs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>

#include "output/atomic_file.h"
#include "output/file_descriptor.h"
#include "output/output_error.h"
#include "output/progress.h"

namespace drape::sweep {

namespace {

/// Starts a process, whose messages go to the run's log.
pid_t start(const std::vector<std::string>& command, const std::filesystem::path& log) {
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const FileDescriptor messages(open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (!messages) throw system_error_at("write", log.string(), errno);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, messages.get(), STDERR_FILENO);
    pid_t child = -1;
    const int error = posix_spawn(&child, "/proc/self/exe", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw OutputError(fmt::format("cannot start a process: {}", std::strerror(error)));
    return child;
}

std::string last_line(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string line, last;
    while (std::getline(stream, line))
        if (!line.empty()) last = line;
    return last;
}

class Pool {
  public:
    Pool(const LocalRuns& runs, const SweepFolder& folder) : runs_(runs), folder_(folder) {}
    ~Pool() {
        // Processes are left only after a failure of this program: nobody would wait for them.
        for (const auto& [child, index] : running_) kill(child, SIGKILL);
        for (const auto& [child, index] : running_) waitpid(child, nullptr, 0);
    }

    bool run() {
        Progress::Options options = Progress::standard_options(runs_.quiet);
        options.unit = "run";
        Progress progress(runs_.indices.size(), options);
        bool stopped = false;
        for (std::size_t next = 0; next < runs_.indices.size() || !running_.empty();) {
            stopped = stopped || !unwritten_.empty() || runs_.stop();
            while (!stopped && next < runs_.indices.size() && running_.size() < runs_.processes) {
                const std::uint32_t index = runs_.indices[next++];
                running_[start(runs_.command(index), folder_.log_file(index))] = index;
            }
            if (running_.empty()) break;
            int status = 0;
            const pid_t child = waitpid(-1, &status, 0);
            if (child < 0 && errno == EINTR) {
                for (const auto& [each, index] : running_) kill(each, SIGTERM);
                continue;
            }
            if (const auto found = running_.find(child); found != running_.end()) {
                if (ended(found->second, status)) progress.frame_done(found->second, note());
                running_.erase(found);
            }
        }
        if (!unwritten_.empty()) throw OutputError(unwritten_);
        return !stopped;
    }

  private:
    /// Returns why a run that could not read or write a file ended, by its log; fills that in where it is empty.
    std::string file_failure(std::uint32_t index, std::string said) const {
        constexpr std::string_view program = "drape: ";
        if (said.starts_with(program)) said.erase(0, program.size());
        if (said.empty()) write_file(folder_.log_file(index), said = "it could not write its files, nor why");
        return fmt::format("run {}: {}", index, said);
    }

    /// Returns whether the run has a record now.
    bool ended(std::uint32_t index, int status) {
        const int code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
        auto record = folder_.record(index);
        const bool interrupted =
            code == static_cast<int>(ExitCode::interrupted) || code == static_cast<int>(ExitCode::terminated);
        if (!record && interrupted) return false;
        const std::string said = last_line(folder_.log_file(index));
        if (!record && code == static_cast<int>(ExitCode::io)) {
            if (unwritten_.empty()) unwritten_ = file_failure(index, said);
            return false;
        }
        if (!record) {
            record = JobRecord{index, code == 0 ? static_cast<int>(ExitCode::internal) : code, said};
            folder_.write(*record, runs_.dataset);
        }
        if (!record->done()) ++failed_;
        std::error_code ignored;
        if (std::filesystem::file_size(folder_.log_file(index), ignored) == 0)
            std::filesystem::remove(folder_.log_file(index), ignored);
        return true;
    }

    std::string note() const { return failed_ > 0 ? fmt::format("{} failed", failed_) : ""; }

    const LocalRuns& runs_;
    const SweepFolder& folder_;
    std::map<pid_t, std::uint32_t> running_;
    std::uint32_t failed_ = 0;
    std::string unwritten_;  ///< first file that a run could not read or write, which ends the sweep
};

}  // namespace

bool run_locally(const LocalRuns& runs, const SweepFolder& folder) { return Pool(runs, folder).run(); }

}  // namespace drape::sweep
