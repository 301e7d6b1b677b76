#include "bench/line_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "output/file_descriptor.h"
#include "output/output_error.h"

namespace drape::bench {

LineFile::LineFile(std::filesystem::path file, const std::function<void(const std::string& line)>& each)
    : file_(std::move(file)) {
    std::ifstream input(file_, std::ios::binary);
    for (std::string line; std::getline(input, line);) {
        ends_in_line_ = !input.eof();
        each(line);
    }
}

void LineFile::add(const std::string& line) {
    const std::string text = fmt::format("{}{}\n", ends_in_line_ ? "" : "\n", line);
    FileDescriptor descriptor(open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
    if (!descriptor) throw system_error_at("write", file_.string(), errno);
    // A line goes out in one piece or, on a full disk, leaves a stump that the next line steps over.
    if (write(descriptor.get(), text.data(), text.size()) != static_cast<ssize_t>(text.size()) ||
        fsync(descriptor.get()) != 0)
        throw system_error_at("write", file_.string(), errno);
    ends_in_line_ = true;
}

}  // namespace drape::bench
