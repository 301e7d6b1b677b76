// Keeps the statistics of a run, frame by frame, for the manifest and the progress line.
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

/// Returns values by name, "<cloth>/stretch_rms" and so on. Names without a cloth are sums over the cloths, and the
/// deepest penetration. A number that overflowed single precision is left out, since JSON cannot express it.
FrameValues frame_values(const SceneDescription& scene, const FinishedFrame& frame);
/// Returns a frame's bodies from its values.
std::vector<BodyState> bodies_of(const SceneDescription& scene, const FrameValues& values);

class RunStatistics {
  public:
    /// The numbers of a long run are stored in `folder`, which must outlive this object, until the manifest is written;
    /// null: a stream, which has no manifest.
    explicit RunStatistics(OutputFolder* folder);

    /// Adds frames in any order, each one once. Throws OutputError.
    void add(std::uint32_t frame, const FrameValues& values);

    /// Returns "stretch 0.52 % RMS, 3.1 % max, stretch error 0.47 % RMS, energy -0.0012 J since frame 0, penetration
    /// 0.03 mm" for the values of a frame: those of the worst cloth. Unknown values are left out.
    std::string note(const FrameValues& values) const;

    /// Visits frames in order, each with "energy_drift_j": the sum of kinetic, potential and elastic energy, minus that
    /// of the first frame. Where nothing does work on the cloth this is the solver's error; wind, damping, contact,
    /// moving pins, cuts, tears, and gravity and stiffness that change do work. A stream has no frames. Throws
    /// OutputError.
    void for_each_frame(const Manifest::FrameVisitor& take) const;

    /// Returns the largest value of "<cloth>" + `name` over all frames and cloths.
    std::optional<double> worst_of_run(std::string_view name) const { return worst(largest_, name); }

  private:
    static std::optional<double> worst(const FrameValues& values, std::string_view name);
    std::optional<double> energy_drift(const FrameValues& values) const;

    std::optional<FrameTable> frames_;
    std::size_t count_ = 0;
    std::optional<std::pair<std::uint32_t, std::optional<double>>> first_;  ///< the first frame, and its energy
    FrameValues largest_;                                                   ///< by name, the largest value
};

}  // namespace drape
