#include "sweep/local_runs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>

#include "base/output_error.h"
#include "output/atomic_file.h"
#include "output/file_descriptor.h"
#include "output/progress.h"

namespace drape::sweep {

namespace {

/// Tells the processes that are started which one started them.
constexpr const char* sweep_variable = "DRAPE_SWEEP_PROCESS";

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

using Group = std::vector<std::uint32_t>;

class Pool {
  public:
    Pool(const LocalRuns& runs, const SweepFolder& folder) : runs_(runs), folder_(folder) {}
    ~Pool() {
        // Processes are left only after a failure of this program: nobody would wait for them.
        for (const auto& [child, group] : running_) kill(child, SIGKILL);
        for (const auto& [child, group] : running_) waitpid(child, nullptr, 0);
    }

    bool run() {
        Progress::Options options = Progress::standard_options(runs_.quiet);
        options.unit = "run";
        std::deque<Group> waiting(runs_.groups.begin(), runs_.groups.end());
        std::size_t count = 0;
        for (const Group& group : waiting) count += group.size();
        Progress progress(count, options);
        setenv(sweep_variable, std::to_string(getpid()).c_str(), 1);
        bool stopped = false;
        while (!waiting.empty() || !running_.empty()) {
            stopped = stopped || !unwritten_.empty() || runs_.stop();
            while (!stopped && !waiting.empty() && running_.size() < runs_.processes) {
                const Group group = std::move(waiting.front());
                waiting.pop_front();
                running_[start(runs_.command(group), log_of(group))] = group;
            }
            if (running_.empty()) break;
            int status = 0;
            const pid_t child = waitpid(-1, &status, 0);
            if (child < 0 && errno == EINTR) {
                for (const auto& [each, group] : running_) kill(each, SIGTERM);
                continue;
            }
            if (const auto found = running_.find(child); found != running_.end()) {
                for (const std::uint32_t index : ended(found->second, status, waiting))
                    progress.frame_done(index, note());
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
        return said.starts_with("run ") ? said : fmt::format("run {}: {}", index, said);
    }

    std::filesystem::path log_of(const Group& group) const {
        return group.size() == 1 ? folder_.log_file(group.front()) : folder_.log_file(group.front(), group.back());
    }

    /// Returns the runs of a process that have a record now. Those of several that a crash took, of which it is not
    /// known whose it was, wait to be made alone.
    Group ended(const Group& group, int status, std::deque<Group>& waiting) {
        const int code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
        const bool interrupted =
            code == static_cast<int>(ExitCode::interrupted) || code == static_cast<int>(ExitCode::terminated);
        const std::string said = last_line(log_of(group));
        Group recorded;
        for (const std::uint32_t index : group) {
            auto record = folder_.record(index);
            if (!record && interrupted) continue;
            if (!record && code == static_cast<int>(ExitCode::io)) {
                if (unwritten_.empty()) unwritten_ = file_failure(index, said);
                continue;
            }
            if (!record && group.size() > 1) {
                waiting.push_back({index});
                continue;
            }
            if (!record) {
                record = JobRecord{index, code == 0 ? static_cast<int>(ExitCode::internal) : code, said};
                folder_.write(*record, runs_.dataset);
            }
            if (!record->done()) ++failed_;
            recorded.push_back(index);
        }
        std::error_code ignored;
        const bool is_read =
            group.size() > 1 || (!recorded.empty() && std::filesystem::file_size(log_of(group), ignored) == 0);
        if (is_read) std::filesystem::remove(log_of(group), ignored);
        return recorded;
    }

    std::string note() const { return failed_ > 0 ? fmt::format("{} failed", failed_) : ""; }

    const LocalRuns& runs_;
    const SweepFolder& folder_;
    std::map<pid_t, Group> running_;
    std::uint32_t failed_ = 0;
    std::string unwritten_;  ///< first file that a run could not read or write, which ends the sweep
};

}  // namespace

void end_with_sweep() {
    const char* const sweep = std::getenv(sweep_variable);
    if (!sweep) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (std::to_string(getppid()) != sweep) raise(SIGKILL);  // it was killed before
}

bool run_locally(const LocalRuns& runs, const SweepFolder& folder) { return Pool(runs, folder).run(); }

}  // namespace drape::sweep
