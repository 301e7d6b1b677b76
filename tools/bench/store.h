// Finished cases on disk, one JSON object a line, appended as they finish: what a rerun need not do again.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "bench/bench_case.h"
#include "bench/line_file.h"

namespace drape::bench {

class ResultStore {
  public:
    /// Reads FILE; a missing one is empty. Lines that are not whole results (the last one of a run that was
    /// killed) are left out, and results of other versions, devices and settings stay there under their own
    /// keys.
    explicit ResultStore(const std::filesystem::path& file);

    std::optional<CaseResult> find(const std::string& key) const;
    /// Appends and syncs. Throws OutputError.
    void add(const CaseResult& result);
    std::size_t size() const { return results_.size(); }

  private:
    std::map<std::string, CaseResult> results_;  // before the file, which fills it
    LineFile file_;
};

/// One line of JSON, without the newline, and back; nothing when it is not one.
std::string result_line(const CaseResult& result);
std::optional<CaseResult> parsed_result(const std::string& line);

}  // namespace drape::bench
