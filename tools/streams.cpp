#include "streams.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>

#include "base/output_error.h"
#include "base/printable_text.h"

namespace drape::cli {

void prepare_streams() {
    std::signal(SIGPIPE, SIG_IGN);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
        // It is opened for the other direction, so that reading or writing fails as it did before. open() takes the
        // lowest free number, which is this one.
        const int wrong_way = stream == STDIN_FILENO ? O_WRONLY : O_RDONLY;
        if (open("/dev/null", wrong_way) != stream) _exit(1);
    }
}

void print_data(std::string_view text) {
    const std::size_t written = std::fwrite(text.data(), 1, text.size(), stdout);
    if (written == text.size() && std::fflush(stdout) == 0) return;
    const int error = errno;
    if (error == EPIPE) throw ReaderGone();
    throw system_error_at("write to", "stdout", error);
}

void create_file(const std::string& path, std::string_view text) {
    std::FILE* file = std::fopen(path.c_str(), "wx");
    if (!file && errno == EEXIST) throw OutputError(fmt::format("'{}' exists already: nothing was written", path));
    if (!file) throw OutputError(fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
    const bool whole = std::fwrite(text.data(), 1, text.size(), file) == text.size();
    const int error = errno;
    if (std::fclose(file) == 0 && whole) return;
    std::filesystem::remove(path);
    throw OutputError(fmt::format("cannot write '{}': {}", path, std::strerror(whole ? errno : error)));
}

void print_message(std::string_view text) {
    // Names and texts from files may hold what a terminal obeys. One write: whole lines where processes share a log.
    const std::string line = printable(text, Escaped::controls) + '\n';
    std::fwrite(line.data(), 1, line.size(), stderr);
}

void print_error(std::string_view text) { print_message("drape: " + std::string(text)); }

}  // namespace drape::cli
