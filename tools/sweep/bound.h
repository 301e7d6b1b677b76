// The end of a sweep tells what bounded its time.
#pragma once

#include <chrono>
#include <string>

namespace drape::sweep {

/// Measures how busy the processors are with this process's children, from its making on.
class Occupancy {
  public:
    /// `cores`: how many the children may use.
    explicit Occupancy(unsigned cores);
    /// Returns what bounded the time until now, in a sentence; empty before ten seconds, which starting takes a part
    /// of.
    std::string text() const;

  private:
    unsigned cores_;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    double used_;  ///< s of processor time, before
};

/// Returns the sentence. `used`: s of processor time within `passed` s on so many cores.
std::string bound_text(double used, double passed, unsigned cores);

}  // namespace drape::sweep
