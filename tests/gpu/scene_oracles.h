// The checks that scene files name as their oracles. Each is a statement of physics about the positions of
// all frames, measured in double precision; its limits stand in the scene file.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene_run.h"

namespace drape::test {

struct Verdict {
    bool met;
    std::string text;  ///< what was measured, against which limit
};

/// The limits of one oracle by name; all of a check's limits must be given, and no other
/// (SceneCheck::limits).
class Limits {
  public:
    explicit Limits(const Oracle& oracle) : oracle_(oracle) {}
    double operator[](const std::string& name) const;
    /// A limit that counts something, frames or cloths.
    std::size_t index(const std::string& name) const { return static_cast<std::size_t>((*this)[name]); }

  private:
    const Oracle& oracle_;
};

struct SceneCheck {
    std::string name;
    std::vector<std::string> limits;
    std::function<Verdict(const SceneRun&, const Limits&)> judge;
};

/// Every check there is: of shape and contact, and of motion.
std::vector<SceneCheck> shape_checks();
std::vector<SceneCheck> motion_checks();

/// Judges a run by an oracle. An unknown check, a missing and an unknown limit are std::invalid_argument. An
/// oracle that speaks of frames which the run does not have is judged by the frames there are.
Verdict judge(const SceneRun& run, const Oracle& oracle);

}  // namespace drape::test
