#include "ending.h"

#include <fmt/format.h>

#include <csignal>

#include "run/failure.h"
#include "streams.h"

namespace drape::cli {

namespace {

volatile std::sig_atomic_t signal_number = 0;

void remember_signal(int number) { signal_number = number; }

}  // namespace

void catch_signals() {
    struct sigaction action {};
    action.sa_handler = remember_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESETHAND;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool stop_requested() { return signal_number != 0; }

ExitCode report_stop(const std::string& consequence) {
    const bool terminated = signal_number == SIGTERM;
    print_error(fmt::format("stopped by {}: {}", terminated ? "SIGTERM" : "SIGINT", consequence));
    return terminated ? ExitCode::terminated : ExitCode::interrupted;
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
