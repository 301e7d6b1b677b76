#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>

namespace drape {

// Shows the progress of a run on stderr: frame, share, milliseconds per frame, time left. On a terminal one line is
// redrawn (at most ten times a second); elsewhere a line comes every 10 % or 30 s. There are no colours, so NO_COLOR
// holds.
class Progress {
  public:
    struct Options {
        bool is_quiet = false;
        bool is_terminal = false;                     // it can redraw a line
        std::function<double()> seconds;              // a steady clock
        std::function<void(std::string_view)> write;  // to stderr, unbuffered
        std::string_view unit = "frame";
        std::size_t columns = 0;  // the terminal's: a longer line, which could not be redrawn, is cut; 0: unknown
    };
    // Returns the options for this process's stderr.
    static Options standard_options(bool is_quiet);

    // The clock starts here.
    explicit Progress(std::uint64_t frame_count, Options options = standard_options(false));
    // Leaves the terminal's cursor on a fresh line.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // Notes that attempt 1, 2, ... at a frame begins, with so many substeps: the line shows it if a frame takes long.
    void frame_begun(std::int64_t frame, std::uint32_t substeps, std::uint32_t attempt);

    // Counts a frame as done; the line shows its number, and after the times a note on it, if any.
    void frame_done(std::int64_t frame, std::string note = {});

    // Writes a line of text, also when quiet, without breaking the progress line.
    void message(std::string_view text);

    // Ends the progress line. Idempotent.
    void finish();

  private:
    void report(double now);
    bool is_due(double now) const;
    std::string line() const;
    double milliseconds_per_frame() const;

    std::uint64_t frame_count_;
    Options options_;
    std::uint64_t done_count_ = 0;
    std::string what_;  // "frame 12", or what is currently done for it
    std::string note_;
    std::deque<double> recent_;  // times when the latest frames were done, oldest first
    double last_report_;
    std::uint64_t last_tenth_ = 0;
    bool line_is_open_ = false;
};

}  // namespace drape
