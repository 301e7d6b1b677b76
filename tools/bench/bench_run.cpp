#include "bench/bench_run.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "base/output_error.h"
#include "output/atomic_file.h"
#include "output/file_descriptor.h"
#include "output/manifest.h"
#include "run/run.h"

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

CaseFilter::CaseFilter(const std::string& text) try : text_(text), expression_(text) {
} catch (const std::regex_error& error) {
    throw UsageError(fmt::format("--filter '{}': {}", text, error.what()));
}

void CaseFilter::refuse(const std::string& example) const {
    throw UsageError(fmt::format("--filter '{}' matches no case; their names are like {}", text_, example));
}

void Budget::done(double work, double seconds) {
    work_ += work;
    seconds_ += seconds;
}

void CaseLoop::plan(double work) {
    budget_.left(work);
    ++count_;
}

void CaseLoop::skip(double work) {
    budget_.left_out(work);
    ++number_;
}

bool CaseLoop::begin(double work) {
    skip(work);
    if (request_.stopped()) throw Stopped{};
    begun_ = budget_.spent();
    aside_ = 0;
    if (budget_.allows(work)) return true;
    leave_out();
    return false;
}

void CaseLoop::done(double work, const std::string& text) {
    const double seconds = budget_.spent() - begun_;
    budget_.done(work, seconds - aside_);
    ++summary_.run_count;
    request_.say(fmt::format("{}/{} {}, {:.1f} s, ETA {}", number_, count_, text, seconds,
                             duration_text(budget_.seconds_left())));
}

std::string ReportHead::text() const { return fmt::format("drape {} on {} ({})", program_version, device, driver); }

Json::Value ReportHead::json(const char* format) const {
    return json_object({{"format", format},
                        {"program_version", program_version},
                        {"created", created},
                        {"device", device},
                        {"driver", driver},
                        {"short", is_short},
                        {"complete", complete}});
}

ReportHead report_head(const DeviceInfo& device, bool is_short, bool complete) {
    return {program_version(), utc_timestamp(), device.name, device.driver + " " + device.driver_version,
            is_short,          complete};
}

void write_results(const SelectedCases& request, const std::string& json, const std::string& csv,
                   const std::map<std::string, std::string>& pictures) {
    for (const auto& [path, text] : {std::pair{&request.json, &json}, {&request.csv, &csv}}) {
        if (path->empty()) continue;
        make_folder(std::filesystem::absolute(*path).parent_path());
        write_file(*path, *text);
    }
    if (request.svg.empty()) return;
    make_folder(request.svg);
    for (const auto& [name, svg] : pictures) write_file(std::filesystem::path(request.svg) / name, svg);
}

std::string duration_text(double seconds) {
    const auto total = static_cast<std::uint64_t>(std::max(0.0, std::ceil(seconds)));
    return total >= 3600 ? fmt::format("{}:{:02}:{:02}", total / 3600, total / 60 % 60, total % 60)
                         : fmt::format("{}:{:02}", total / 60, total % 60);
}

void make_folder(const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw OutputError(fmt::format("cannot make folder '{}': {}", folder, error.message()));
}

}  // namespace drape::bench
