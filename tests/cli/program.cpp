#include "program.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace drape {

namespace {

std::string content(std::FILE* file) {
    std::string text;
    std::rewind(file);
    for (int c; (c = std::fgetc(file)) != EOF;) text += static_cast<char>(c);
    return text;
}

/// Runs in the child, with only calls that are safe after fork.
[[noreturn]] void become(const std::string& program, char* const* arguments, const StartOptions& options, int out,
                         int err) {
    // The program must not ignore the signals that a test ignores.
    for (const int signal : {SIGPIPE, SIGINT, SIGTERM, SIGXFSZ}) std::signal(signal, SIG_DFL);
    if (!options.folder.empty() && chdir(options.folder.c_str()) != 0) _exit(126);
    for (const std::string& variable : options.environment) putenv(const_cast<char*>(variable.c_str()));
    if (dup2(out, STDOUT_FILENO) < 0 || dup2(err, STDERR_FILENO) < 0) _exit(126);
    if (options.close_stdout) close(STDOUT_FILENO);
    if (options.close_stderr) close(STDERR_FILENO);
    const rlimit size{options.file_size_limit, options.file_size_limit};
    if (options.file_size_limit > 0 && setrlimit(RLIMIT_FSIZE, &size) != 0) _exit(126);
    execv(program.c_str(), arguments);
    _exit(127);
}

}  // namespace

Running::Running(const std::string& program, std::vector<std::string> arguments, const StartOptions& options)
    : out_(std::tmpfile(), std::fclose), err_(std::tmpfile(), std::fclose) {
    if (!out_ || !err_) throw std::runtime_error("no temporary file");
    for (std::FILE* file : {out_.get(), err_.get()}) fcntl(fileno(file), F_SETFD, FD_CLOEXEC);
    std::vector<char*> pointers{const_cast<char*>(program.c_str())};
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    const int out = options.stdout_descriptor >= 0 ? options.stdout_descriptor : fileno(out_.get());
    const int err = options.stderr_descriptor >= 0 ? options.stderr_descriptor : fileno(err_.get());
    child_ = fork();
    if (child_ == 0) become(program, pointers.data(), options, out, err);
    if (child_ < 0) throw std::runtime_error("fork failed");
}

Running::~Running() {
    if (child_ <= 0) return;
    kill(child_, SIGKILL);
    reap(0);
}

void Running::send(int signal) const {
    if (kill(child_, signal) != 0) throw std::runtime_error("the program has ended already");
}

bool Running::reap(int flags) {
    rusage usage{};
    if (wait4(child_, &status_, flags, &usage) != child_) return false;
    peak_memory_kib_ = usage.ru_maxrss;
    child_ = -1;
    return true;
}

bool Running::wait_until(const std::function<bool()>& condition) {
    while (!condition()) {
        if (child_ <= 0 || reap(WNOHANG)) return condition();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

Outcome Running::wait() {
    while (child_ > 0) reap(0);
    Outcome outcome;
    outcome.by_signal = WIFSIGNALED(status_);
    outcome.code = outcome.by_signal ? 128 + WTERMSIG(status_) : WEXITSTATUS(status_);
    outcome.out = content(out_.get());
    outcome.err = content(err_.get());
    outcome.peak_memory_kib = peak_memory_kib_;
    return outcome;
}

Outcome drape(std::vector<std::string> arguments, const StartOptions& options) {
    return Running(DRAPE_PROGRAM, std::move(arguments), options).wait();
}

bool driver_keeps_memory_in_files() {
    static const bool keeps = [] {
        const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
        const Outcome outcome =
            drape({"profile", DRAPE_SOURCE_DIR "/scenes/hanging_sheet.json", "--simulate", "--frames", "1"},
                  {.stdout_descriptor = nowhere, .file_size_limit = 4096});
        close(nowhere);
        return outcome.by_signal;
    }();
    return keeps;
}

}  // namespace drape
