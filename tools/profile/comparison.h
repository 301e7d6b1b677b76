// Two profiles against their noise.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace drape::profile {

/// Says which file is no profile, and why.
class NoProfile : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct ComparedRow {
    std::string name;
    double before = 0, after = 0;  ///< medians, ms
    double noise = 0;              ///< of the ratio: the larger interquartile range over its median, at least 2 %
    enum class Verdict { same, faster, slower } verdict = Verdict::same;
};

/// Rows that both have, of two JSON texts of profile_json; `differences`: of what they were measured on, a line each.
struct Comparison {
    std::vector<ComparedRow> rows;
    std::vector<std::string> differences;
    bool slower() const;
    std::string text() const;
};
/// Throws NoProfile, which names the file.
Comparison compare(const std::string& before, const std::string& before_name, const std::string& after,
                   const std::string& after_name);

}  // namespace drape::profile
