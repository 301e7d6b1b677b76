// Compares every frame of a run with the table of bounds (bounds.cpp). The bounds follow from what acts on the cloth,
// and lie far above what it ever does.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "control/bounds.h"

namespace drape {

/// A value of a frame that exceeds its bound.
struct Implausible {
    double excess = 0;      ///< value divided by bound; above 1 it is implausible
    std::string what;       ///< "moves at 8e+03 m/s, where at most 120 m/s are explained", of the particle or the cloth
    std::string criterion;  ///< "speed, m/s"
    std::string remedy = {};  ///< what a user can do
    double value = 0, bound = 0;
    std::optional<std::uint32_t> particle = {};  ///< index; nothing: the finding is not about a single particle
    std::size_t cloth = 0;
};

class Watch {
  public:
    /// `model` must outlive this.
    explicit Watch(const SimulationModel& model);

    /// Computes what moves the cloths until a frame's end, by the model's paths as they are now. `excess` and
    /// `implausible` do it themselves where it was not done.
    void extend(std::uint32_t frame) { causes_.extend(frame); }
    /// Returns the largest ratio of a value to its bound over all cloths, of the rows for which a closed loop does a
    /// frame again.
    double excess(std::uint32_t frame, const std::vector<ClothStatistics>& cloths);

    /// Returns why a frame is no result. It is the value farthest beyond its bound, of the first cloth that has one;
    /// else the first one that is about all cloths together. Call it once for each frame, in order. The number of later
    /// frames does not change how a frame is judged.
    std::optional<Implausible> implausible(std::uint32_t frame, const std::vector<ClothStatistics>& cloths);

    /// Returns the warnings about the frames that `implausible` was given.
    std::vector<std::string> warnings() const;

    /// The worst stretch errors, as RMS and of a single spring, over all frames that `implausible` was given. Nothing:
    /// there was none.
    const std::optional<double>& worst_rms() const { return worst_rms_; }
    const std::optional<double>& worst_max() const { return worst_max_; }

    /// Writes or reads what it remembers of earlier frames, by a ByteWriter or a ByteReader. Returns false if what was
    /// read is impossible.
    template <class Archive>
    bool transfer(Archive& archive) {
        archive(recent_, last_frame_, last_cloth_, worst_rms_, worst_max_, starts_depth_);
        const std::size_t count = std::max<std::size_t>(causes_.starts().size(), 1);
        bool good = recent_.size() <= frames_in_a_row && last_cloth_ < count && starts_depth_.size() <= count;
        for (Note& note : notes_) {
            archive(note.first, note.worst, note.cloth, note.value, note.particle);
            good = good && note.cloth < count;
        }
        return causes_.transfer(archive) && good;
    }

  private:
    /// A warning names its first frame and the worst one.
    struct Note {
        std::uint32_t first = 0, worst = 0, cloth = 0;
        double value = 0;  ///< 0: nothing to warn about
        std::optional<std::uint32_t> particle = {};
    };
    Seen seen(std::uint32_t frame, std::size_t cloth, std::span<const ClothStatistics> all) const;
    Implausible worst(std::uint32_t frame, const std::vector<ClothStatistics>& cloths, bool in_order) const;
    void remember(std::uint32_t frame, const std::vector<ClothStatistics>& cloths);

    Causes causes_;
    std::optional<double> worst_rms_, worst_max_;
    std::vector<Note> notes_;          ///< one for each row that warns, in their order
    std::deque<double> starts_depth_;  ///< m, by cloth, the penetration in frame 0
    std::deque<double> recent_;        ///< by frame, the largest stretch error of a spring
    std::uint32_t last_frame_ = 0,
                  last_cloth_ = 0;  ///< the last frame in `recent_`, and its cloth with the worst spring
};

}  // namespace drape
