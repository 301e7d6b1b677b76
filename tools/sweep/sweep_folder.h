// A sweep leaves a folder and a record per run, and files made of all records.
//
//   sweep.json            the specification and the version it belongs to: another sweep is refused
//   runs/0012/            the run's own folder, as `drape simulate` makes it
//   jobs/0012.json        how the run ended; written last, so that a run without one is not done
//   results.csv           a line per run, made of the records
//   dataset/              with --dataset: meta.json and a trajectory per run that is done
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "run/exit_code.h"
#include "sweep/sweep_spec.h"

namespace drape::sweep {

struct JobRecord {
    std::uint32_t index = 0;
    int exit_code = 0;                       ///< the run's exit code; 128 + the signal's number when one ended it
    std::string message;                     ///< reason why it failed
    double seconds = 0;                      ///< wall-clock time, s
    std::map<std::string, double> values{};  ///< from the run's manifest: worst and last statistics, bytes

    bool done() const { return exit_code == 0; }
    /// Returns "done", or the name of the exit code.
    std::string status() const;
};

struct Tally {
    std::uint32_t done = 0;
    std::vector<JobRecord> failed;
    std::vector<std::uint32_t> missing;
    double bytes = 0;  ///< bytes of the files of all runs

    bool complete() const { return failed.empty() && missing.empty(); }
    /// Returns "996 done, 3 failed, 1 missing", and a line per failure, at most 20 of them.
    std::string text() const;
};

class SweepFolder {
  public:
    /// Makes the folder when it is missing. Throws OutputError when it is another sweep's, or when `fresh` and it has
    /// runs already.
    SweepFolder(const std::filesystem::path& path, const SweepSpec& spec, bool fresh);

    std::filesystem::path run_folder(std::uint32_t index) const { return path_ / "runs" / number(index); }
    std::filesystem::path log_file(std::uint32_t index) const { return path_ / "jobs" / (number(index) + ".log"); }
    /// Messages of a process that makes several runs; the runs' own files have what they say.
    std::filesystem::path log_file(std::uint32_t first, std::uint32_t last) const {
        return path_ / "jobs" / (number(first) + "-" + number(last) + ".log");
    }
    const std::filesystem::path& path() const { return path_; }

    /// Removes the files of messages that processes which make several runs left when they were killed.
    void remove_logs_of_processes() const;

    std::optional<JobRecord> record(std::uint32_t index) const;
    bool has_trajectory(std::uint32_t index) const;
    /// Adds the numbers of the run's manifest, and with `dataset` gives the data set its trajectory.
    void write(JobRecord record, bool dataset) const;

    /// Writes dataset/meta.json, unless it is there or there is no trajectory.
    void describe_dataset() const;
    /// Writes results.csv, and with `dataset` dataset/meta.json, from the records that are there.
    Tally collect(bool dataset) const;

  private:
    std::string number(std::uint32_t index) const;
    std::filesystem::path trajectory(std::uint32_t index) const;

    std::filesystem::path path_;
    const SweepSpec& spec_;
};

}  // namespace drape::sweep
