// Keeps the statistics of a run, frame by frame, as the manifest and the progress line say them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "drape/scene.h"
#include "drape/simulation.h"
#include "output/frame_table.h"
#include "output/manifest.h"

namespace drape {

/// Returns values by name, "<cloth>/stretch_rms" and so on; without a cloth: sums over the cloths, and the deepest
/// penetration. A number that overflowed single precision is left out: JSON has none for it.
FrameValues frame_values(const SceneDescription& scene, const FinishedFrame& frame);

class RunStatistics {
  public:
    /// The numbers of a long run wait in `folder`, which must outlive this, for its manifest; null: a stream has none.
    explicit RunStatistics(OutputFolder* folder);

    /// Adds frames in any order, each once. Throws OutputError.
    void add(std::uint32_t frame, const FrameValues& values);

    /// Returns "stretch 0.52 % RMS, 3.1 % max, stretch error 0.47 % RMS, energy -0.0012 J since frame 0, penetration
    /// 0.03 mm" for the values of a frame: the worst cloth's; what is not known is left out.
    std::string note(const FrameValues& values) const;

    /// Visits frames in order, each with "energy_drift_j": kinetic, potential and elastic energy together, minus that
    /// of the first frame. It is the solver's error where nothing does work on the cloth; wind, damping, contact,
    /// moving pins, cuts and tears, gravity and stiffness that change do. A stream has no frames. Throws OutputError.
    void for_each_frame(const Manifest::FrameVisitor& take) const;

    /// Returns the largest value, of any frame and cloth, of "<cloth>" + `name`.
    std::optional<double> worst_of_run(std::string_view name) const { return worst(largest_, name); }

    /// Returns what to warn of where the last frame's estimated position error is above what is allowed, and what the
    /// scene can do about it: nothing where the motion is sensitive.
    std::optional<std::string> inexact_motion() const;
    /// Returns what to note where exact positions mean nothing from some frame on.
    std::optional<std::string> sensitive_motion() const;

  private:
    struct Motion {
        std::uint32_t frame = 0;
        double value = 0, allowed = 0;  ///< m
    };
    static std::optional<double> worst(const FrameValues& values, std::string_view name);
    std::optional<double> energy_drift(const FrameValues& values) const;

    std::optional<FrameTable> frames_;
    std::size_t count_ = 0;
    std::optional<std::pair<std::uint32_t, std::optional<double>>> first_;  ///< frame, its energy
    FrameValues largest_;                                                   ///< largest value of every name
    std::optional<Motion> sensitive_;  ///< the first frame that is, and how far runs had parted
    std::optional<Motion> exact_;      ///< the last frame that is not, with its position error
};

}  // namespace drape
