// Finished cases on disk, one JSON object a line, appended as they finish: what a rerun need not do again.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "bench/record.h"

namespace drape::bench {

/// A file of lines that grows by one whole line at a time, so that a killed run loses at most the last.
class LineFile {
  public:
    /// Tells `each` of every line of FILE, the last perhaps cut short; a missing file has none.
    LineFile(std::filesystem::path file, const std::function<void(const std::string& line)>& each);

    /// Appends a line and syncs. Throws OutputError.
    void add(const std::string& line);

  private:
    std::filesystem::path file_;
    bool ends_in_line_ = true;
};

/// Results by their `key`, a hash of all that decides them: those of other versions, devices and settings stay in the
/// file under their own keys. Lines that are no whole results, as the last of a run that was killed, are passed over.
template <class Result>
class ResultStore {
  public:
    explicit ResultStore(const std::filesystem::path& file)
        : file_(file, [this](const std::string& line) {
              if (auto result = parsed_result<Result>(line)) results_[result->key] = std::move(*result);
          }) {}

    /// Null when there is none.
    const Result* find(const std::string& key) const {
        const auto found = results_.find(key);
        return found == results_.end() ? nullptr : &found->second;
    }
    /// Throws OutputError.
    void add(const Result& result) {
        file_.add(json_line(json_of(result)));
        results_[result.key] = result;
    }
    std::size_t size() const { return results_.size(); }

  private:
    std::map<std::string, Result> results_;  // before the file, which fills it
    LineFile file_;
};

}  // namespace drape::bench
