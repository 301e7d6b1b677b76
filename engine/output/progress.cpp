#include "output/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace drape {

namespace {

constexpr double redraw_interval = 0.1;  // seconds
constexpr double line_interval = 30.0;
constexpr double long_frame = 1.0;  // seconds, from which on the line shows what is done for a frame
// The rate is that of the latest frames: the first ones pay for pipelines, and scenes grow harder on contact.
constexpr size_t recent_limit = 33;

std::string duration_text(double seconds) {
    const auto total = static_cast<std::uint64_t>(std::ceil(seconds));
    const std::uint64_t hours = total / 3600, minutes = total / 60 % 60, rest = total % 60;
    return hours ? fmt::format("{}:{:02}:{:02}", hours, minutes, rest) : fmt::format("{}:{:02}", minutes, rest);
}

}  // namespace

Progress::Options Progress::standard_options(bool is_quiet) {
    Options options;
    options.is_quiet = is_quiet;
    const char* terminal = std::getenv("TERM");
    options.is_terminal = isatty(STDERR_FILENO) == 1 && terminal && std::string_view(terminal) != "dumb";
    options.seconds = [] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    };
    if (winsize size{}; options.is_terminal && ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0)
        options.columns = size.ws_col;
    options.write = [](std::string_view text) {
        std::fwrite(text.data(), 1, text.size(), stderr);
        std::fflush(stderr);
    };
    return options;
}

Progress::Progress(std::uint64_t frame_count, Options options)
    : frame_count_(frame_count), options_(std::move(options)), last_report_(options_.seconds()) {
    recent_.push_back(last_report_);
}

Progress::~Progress() { finish(); }

void Progress::frame_done(std::int64_t frame, std::string note) {
    ++done_count_;
    what_ = fmt::format("{} {}", options_.unit, frame);
    note_ = std::move(note);
    const double now = options_.seconds();
    recent_.push_back(now);
    if (recent_.size() > recent_limit) recent_.pop_front();
    report(now);
}

void Progress::frame_begun(std::int64_t frame, std::uint32_t substeps, std::uint32_t attempt) {
    const double now = options_.seconds();
    if (done_count_ == frame_count_ || now - recent_.back() < long_frame) return;
    what_ = fmt::format("{} {}, {} substeps, attempt {}", options_.unit, frame, substeps, attempt);
    note_.clear();
    report(now);
}

void Progress::report(double now) {
    if (options_.is_quiet || !is_due(now)) return;
    options_.write(options_.is_terminal ? fmt::format("\r{}\x1b[K", line()) : fmt::format("{}\n", line()));
    line_is_open_ = options_.is_terminal;
    last_report_ = now;
    last_tenth_ = frame_count_ ? 10 * done_count_ / frame_count_ : 0;
}

bool Progress::is_due(double now) const {
    if (done_count_ == frame_count_) return true;
    const double waited = now - last_report_;
    if (options_.is_terminal) return done_count_ == 1 || waited >= redraw_interval;
    const bool is_next_tenth = frame_count_ != 0 && 10 * done_count_ / frame_count_ > last_tenth_;
    return is_next_tenth || waited >= line_interval;
}

double Progress::milliseconds_per_frame() const {
    const auto frames = static_cast<double>(recent_.size() - 1);
    return frames > 0 ? 1000 * (recent_.back() - recent_.front()) / frames : 0;
}

std::string Progress::line() const {
    const double rate = milliseconds_per_frame();
    const std::uint64_t left = frame_count_ > done_count_ ? frame_count_ - done_count_ : 0;
    const std::uint64_t percent = frame_count_ ? 100 * done_count_ / frame_count_ : 100;
    std::string text = fmt::format("{} ({}/{}, {} %)", what_, done_count_, frame_count_, percent);
    if (done_count_ > 0)
        text += fmt::format("  {:.1f} ms/{}  ETA {}", rate, options_.unit,
                            duration_text(static_cast<double>(left) * rate / 1000));
    if (!note_.empty()) text += "  " + note_;
    if (options_.is_terminal && options_.columns > 1 && text.size() >= options_.columns)
        text.resize(options_.columns - 1);
    return text;
}

void Progress::message(std::string_view text) {
    std::string whole = line_is_open_ ? "\r\x1b[K" : "";
    whole += text;
    whole += '\n';
    if (line_is_open_) whole += line();
    options_.write(whole);
}

void Progress::finish() {
    if (line_is_open_) options_.write("\n");
    line_is_open_ = false;
}

}  // namespace drape
