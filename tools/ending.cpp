#include "ending.h"

#include <fmt/format.h>

#include <csignal>
#include <new>

#include "drape.h"
#include "output/output_error.h"
#include "streams.h"
#include "vulkan/instance.h"

namespace drape::cli {

namespace {

volatile std::sig_atomic_t signal_number = 0;

void remember_signal(int number) { signal_number = number; }

std::string vulkan_hint(const vulkan::VulkanError& error) {
    if (error.result() != VK_ERROR_INCOMPATIBLE_DRIVER) return {};
    return "\n  A driver that runs on any CPU is in Debian's package mesa-vulkan-drivers; VK_ICD_FILENAMES, "
           "if set, "
           "must name existing driver files.";
}

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

Failure current_failure() {
    try {
        throw;
    } catch (const SceneFailure& failure) {
        return {failure.result().unreadable ? ExitCode::io : ExitCode::scene, failure.what(), true};
    } catch (const UsageError& error) {
        return {ExitCode::usage, error.what()};
    } catch (const OutputError& error) {
        return {ExitCode::io, error.what()};
    } catch (const Diverged& error) {
        return {ExitCode::diverged, error.what()};
    } catch (const ToleranceMissed& error) {
        return {ExitCode::tolerance, error.what()};
    } catch (const vulkan::VulkanError& error) {
        return {ExitCode::device, error.what() + vulkan_hint(error)};
    } catch (const std::bad_alloc&) {
        return {ExitCode::device, "out of memory"};
    } catch (const std::exception& error) {
        return {ExitCode::internal, fmt::format("internal error: {}", error.what())};
    }
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
