// What all benchmarks share: the request (its options are in commands/bench_options.h), the loop over cases, and the
// results.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <regex>
#include <string>

#include "bench/store.h"
#include "drape/device.h"

namespace drape::bench {

struct BenchRequest {
    std::string device;     ///< selector; empty: the best there is
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

struct BenchSummary {
    std::string text;    ///< the tables
    std::string missed;  ///< which limits the results miss, for an error message; empty: none
    std::size_t run_count = 0, kept_count = 0, left_out_count = 0;
    std::uint64_t validation_count = 0;  ///< validation messages
};

/// Measures the time since it was made.
class Stopwatch {
  public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Thrown when a request's `stop` returned true.
struct Stopped {};

/// --filter
class CaseFilter {
  public:
    /// Throws UsageError when the text is no regular expression.
    explicit CaseFilter(const std::string& text);
    bool accepts(const std::string& name) const { return std::regex_search(name, expression_); }
    /// Throws UsageError, since no case is left; `example`: a name that exists.
    [[noreturn]] void refuse(const std::string& example) const;
    /// Returns the cases whose `name` is accepted. Throws UsageError when there is none.
    template <class Case>
    std::vector<Case> chosen(std::vector<Case> cases, const std::string& example) const {
        std::erase_if(cases, [this](const Case& each) { return !accepts(each.name); });
        if (cases.empty()) refuse(example);
        return cases;
    }

  private:
    std::string text_;
    std::regex expression_;
};

/// --budget: a case that is begun must end within it. The seconds of a case follow from its work, in any unit, and the
/// rate of the cases done so far.
class Budget {
  public:
    /// `first_rate`: seconds per unit of work, before anything is measured.
    Budget(std::optional<double> minutes, double first_rate) : minutes_(minutes), first_rate_(first_rate) {}

    void left(double work) { left_ += work; }      ///< this work is still to be done
    void left_out(double work) { left_ -= work; }  ///< it is not to be done any more
    void done(double work, double seconds);
    double seconds(double work) const { return work * (work_ > 0 ? seconds_ / work_ : first_rate_); }
    double seconds_left() const { return seconds(left_); }
    bool allows(double work) const { return !minutes_ || spent() + seconds(work) <= 60 * *minutes_; }
    double spent() const { return watch_.seconds(); }  ///< s since this was made

  private:
    std::optional<double> minutes_;
    double first_rate_, left_ = 0, work_ = 0, seconds_ = 0;
    Stopwatch watch_;
};

/// Goes through the cases of a benchmark: known results are kept, cases without time left are left out, the others are
/// run, and each is reported.
class CaseLoop {
  public:
    CaseLoop(const BenchRequest& request, std::optional<double> budget_minutes, double first_rate)
        : request_(request), budget_(budget_minutes, first_rate) {}

    /// Announces a case, with its work.
    void plan(double work);
    /// Removes the next case, which is not wanted after all.
    void skip(double work);

    /// Returns whether there is time for the next case. Throws Stopped.
    bool begin(double work);
    /// Notes that the case that was begun cannot be run.
    void leave_out() { ++summary_.left_out_count; }
    void done(double work, const std::string& text);
    /// Notes that so many seconds of the case that was begun were spent on results that other cases need as well.
    void put_aside(double seconds) { aside_ += seconds; }

    /// Returns the result of the next case, from the store or by `run`; the latter is stored and reported by `text`.
    /// Nothing: no time is left for the case.
    template <class Result, class Run, class Text>
    std::optional<Result> next(ResultStore<Result>& store, const std::string& key, double work, const Run& run,
                               const Text& text) {
        if (const Result* known = store.find(key)) {
            skip(work);
            ++summary_.kept_count;
            return *known;
        }
        if (!begin(work)) return std::nullopt;
        Result result = run();
        result.key = key;
        store.add(result);
        done(work, text(result));
        return result;
    }

    /// Returns how many cases were run, kept and left out.
    const BenchSummary& summary() const { return summary_; }

  private:
    const BenchRequest& request_;
    Budget budget_;
    BenchSummary summary_;
    std::size_t number_ = 0, count_ = 0;
    double begun_ = 0, aside_ = 0;
};

/// The program and the device that measured the results, and whether all cases were measured.
struct ReportHead {
    std::string program_version, created;  ///< UTC
    std::string device, driver;            ///< driver with its version
    bool is_short = false;
    bool complete = true;  ///< false: cases were left out

    std::string text() const;  ///< "drape 1.0 on DEVICE (DRIVER)"
    Json::Value json(const char* format) const;
};
ReportHead report_head(const DeviceInfo& device, bool is_short = false, bool complete = true);

/// Writes what --json, --csv and --svg ask for, each file whole. `pictures`: SVG by file name.
void write_results(const SelectedCases& request, const std::string& json, const std::string& csv,
                   const std::map<std::string, std::string>& pictures);

/// Returns "1:02:03" or "2:03", rounded up.
std::string duration_text(double seconds);

/// Makes a folder for files. Throws OutputError.
void make_folder(const std::string& folder);

}  // namespace drape::bench
