#include "ending.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstring>

#include "run/failure.h"
#include "streams.h"

namespace drape::cli {

namespace {

volatile std::sig_atomic_t signal_number = 0;

volatile std::sig_atomic_t has_deadline = 0, on_terminal = 0;
constexpr unsigned most_seconds = 2;

const char* signal_name() { return signal_number == SIGTERM ? "SIGTERM" : "SIGINT"; }
ExitCode signal_code() { return signal_number == SIGTERM ? ExitCode::terminated : ExitCode::interrupted; }

void remember_signal(int number) {
    signal_number = number;
    if (has_deadline != 0) alarm(most_seconds);
}

/// Ends a program whose work has not come to where it asks for a stop. It calls only what a handler may; files are
/// whole at any moment.
void end_at_once(int) {
    for (const char* part : {on_terminal != 0 ? "\n" : "", "drape: stopped by ", signal_name(),
                             ", without waiting for what takes longer than two seconds; --resume goes on from the last "
                             "checkpoint, where there is one\n"})
        (void)!write(STDERR_FILENO, part, std::strlen(part));
    _exit(static_cast<int>(signal_code()));
}

}  // namespace

void catch_signals(bool waits_for_processes) {
    struct sigaction action {};
    action.sa_handler = remember_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESETHAND;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    has_deadline = !waits_for_processes;
    on_terminal = isatty(STDERR_FILENO);
    action.sa_handler = end_at_once;
    sigaction(SIGALRM, &action, nullptr);
}

bool stop_requested() { return signal_number != 0; }
void take_time() { alarm(0); }

ExitCode report_stop(const std::string& consequence) {
    take_time();
    print_error(fmt::format("stopped by {}: {}", signal_name(), consequence));
    return signal_code();
}

ExitCode report_validation(std::uint64_t message_count) {
    print_error(fmt::format("{} validation messages", message_count));
    return ExitCode::validation;
}

ExitCode report_current_exception() {
    try {
        throw;
    } catch (const ReaderGone&) {
        return ExitCode::io;
    } catch (...) {
        const Failure failure = current_failure();
        if (failure.is_located)
            print_message(failure.text);
        else
            print_error(failure.text);
        return failure.code;
    }
}

}  // namespace drape::cli
