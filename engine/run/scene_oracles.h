// The checks that scene files name as their oracles. Each is a statement of physics about the positions in all frames,
// measured in double precision; its limits are in the scene file.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "run/scene_run.h"

namespace drape::verify {

struct Verdict {
    bool met;
    std::string text;  ///< what was measured, and against which limit
};

/// The limits of an oracle, by name; all limits of its check are there (scene/oracle_kinds.h).
class Limits {
  public:
    explicit Limits(const Oracle& oracle) : oracle_(oracle) {}
    /// Throws std::invalid_argument where no limit has this name.
    double operator[](const std::string& name) const;
    /// Returns a limit that is a number of frames or of cloths.
    std::size_t index(const std::string& name) const { return static_cast<std::size_t>((*this)[name]); }

  private:
    const Oracle& oracle_;
};

struct SceneCheck {
    std::string_view name;  ///< name of an OracleKind
    Verdict (*judge)(const SceneRun&, const Limits&);
};

/// The tables of all checks: those about shape and contact, and those about motion.
std::span<const SceneCheck> shape_checks();
std::span<const SceneCheck> motion_checks();

/// Judges a run by an oracle of a scene that was read. An oracle about frames that the run lacks is judged by the
/// frames that exist. Throws std::invalid_argument for a check or a limit that no scene file can have.
Verdict judge(const SceneRun& run, const Oracle& oracle);

}  // namespace drape::verify
