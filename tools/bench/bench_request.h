// What all benchmarks are asked for, and what those that choose among cases are. Their options:
// commands/bench_options.h.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <regex>
#include <string>

namespace drape::bench {

struct BenchRequest {
    std::string device;     ///< a selector of Device; may be empty
    bool validate = false;  ///< core and synchronization validation
    bool quiet = false;
    std::function<void(const std::string&)> message;  ///< progress, one line each
    std::function<bool()> stop;                       ///< true: end soon

    bool stopped() const { return stop && stop(); }
    void say(const std::string& text) const {
        if (!quiet && message) message(text);
    }
};

struct SelectedCases : BenchRequest {
    std::string filter;                    ///< regular expression that a case's name must contain; empty: all
    bool is_short = false;                 ///< few small cases
    std::optional<double> budget_minutes;  ///< start no case that would end later
    std::string json, csv;                 ///< files; empty: none
    std::string svg;                       ///< folder of plots; empty: none
};

/// --filter
class CaseFilter {
  public:
    /// Throws UsageError when the text is no regular expression.
    explicit CaseFilter(const std::string& text);
    bool accepts(const std::string& name) const { return std::regex_search(name, expression_); }
    /// Throws UsageError: nothing is left; `example`: a name.
    [[noreturn]] void refuse(const std::string& example) const;

  private:
    std::string text_;
    std::regex expression_;
};

/// --budget: what is begun must be done by then. The seconds of a case follow from its work, in any unit, and the rate
/// of those done so far.
class Budget {
  public:
    /// `first_rate`: seconds per unit of work, before anything is measured.
    Budget(std::optional<double> minutes, double first_rate) : minutes_(minutes), first_rate_(first_rate) {}

    void left(double work) { left_ += work; }      ///< is to be done
    void left_out(double work) { left_ -= work; }  ///< no longer
    void done(double work, double seconds);
    double seconds(double work) const { return work * (work_ > 0 ? seconds_ / work_ : first_rate_); }
    double seconds_left() const { return seconds(left_); }
    bool allows(double work) const { return !minutes_ || spent() + seconds(work) <= 60 * *minutes_; }
    double spent() const;  ///< s since this was made

  private:
    std::optional<double> minutes_;
    double first_rate_, left_ = 0, work_ = 0, seconds_ = 0;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// "1:02:03", "2:03", rounded up.
std::string duration_text(double seconds);

/// Makes a folder for files to come. Throws OutputError.
void make_folder(const std::string& folder);

}  // namespace drape::bench
