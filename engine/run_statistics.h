// The statistics of a run, frame by frame, as the manifest and the progress line say them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drape/scene.h"
#include "drape/simulation.h"
#include "output/manifest.h"

namespace drape {

/// By name, "<cloth>/stretch_rms" and so on; without a cloth: sums over the cloths, and the deepest penetration.
/// A number that overflowed single precision is left out: JSON has none for it.
FrameValues frame_values(const SceneDescription& scene, const FinishedFrame& frame);

class RunStatistics {
  public:
    /// In any order.
    void add(std::uint32_t frame, FrameValues values) { frames_[frame] = std::move(values); }

    /// "stretch 0.52 % RMS, 3.1 % max, stretch error 0.47 % RMS, energy -0.0012 J since frame 0, penetration 0.03 mm":
    /// the worst cloth's; what is not known of the frame is left out.
    std::string note(std::uint32_t frame) const;

    /// In order of frames, each with "energy_drift_j": kinetic, potential and elastic energy together, minus that
    /// of the first frame. It is the solver's error where nothing does work on the cloth; wind, damping, contact and
    /// moving pins do.
    std::vector<Manifest::FrameStatistics> frames() const;

    /// The largest value, of any frame and cloth, of "<cloth>" + `name`.
    std::optional<double> worst_of_run(std::string_view name) const;

    /// What to say of the frames in which method `auto` did not keep the motion's error, since more substeps do not
    /// reduce it; nothing when there is none.
    std::optional<std::string> unpredictable() const;

  private:
    std::optional<double> energy_drift(const FrameValues& values) const;
    std::map<std::uint32_t, FrameValues> frames_;
};

}  // namespace drape
