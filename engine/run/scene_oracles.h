// Scene files name these checks as their oracles. Each is a statement of physics about the positions of all frames,
// measured in double precision; its limits stand in the scene file.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "run/scene_run.h"

namespace drape::verify {

struct Verdict {
    bool met;
    std::string text;  ///< says what was measured, against which limit
};

/// An oracle has, by name, all limits of its check (scene/oracle_kinds.h).
class Limits {
  public:
    explicit Limits(const Oracle& oracle) : oracle_(oracle) {}
    /// Throws std::invalid_argument where no limit has that name.
    double operator[](const std::string& name) const;
    /// Returns a limit that counts something, frames or cloths.
    std::size_t index(const std::string& name) const { return static_cast<std::size_t>((*this)[name]); }

  private:
    const Oracle& oracle_;
};

struct SceneCheck {
    std::string_view name;  ///< name of an OracleKind
    Verdict (*judge)(const SceneRun&, const Limits&);
};

/// These tables judge the checks: those of shape and contact, and those of motion.
std::span<const SceneCheck> shape_checks();
std::span<const SceneCheck> motion_checks();

/// Judges a run by an oracle of a scene that was read. One that speaks of frames which the run does not have is judged
/// by the frames there are. Throws std::invalid_argument for a check or a limit that no scene file can have.
Verdict judge(const SceneRun& run, const Oracle& oracle);

}  // namespace drape::verify
