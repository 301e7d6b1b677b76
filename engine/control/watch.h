// Holds every frame of a run against the table of bounds (bounds.cpp), which follow from what acts on the cloth and are
// far above what it ever does.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "control/bounds.h"

namespace drape {

/// A frame has something over its bound.
struct Implausible {
    double excess = 0;      ///< value over bound: 1 is the most there can be
    std::string what;       ///< "moves at 8e+03 m/s, where at most 120 m/s are explained", of the particle or the cloth
    std::string criterion;  ///< "speed, m/s"
    std::string remedy = {};  ///< what a user can do
    double value = 0, bound = 0;
    std::optional<std::uint32_t> particle = {};  ///< index; nothing: it is not about a single one
    std::size_t cloth = 0;
};

class Watch {
  public:
    /// `model` must outlive this.
    explicit Watch(const SimulationModel& model);

    /// Looks at what moves the cloths until a frame's end, by the model's paths as they are now. The others do it where
    /// it was not done.
    void extend(std::uint32_t frame) { causes_.extend(frame); }
    /// Returns the worst cloth's largest value over its bound, of the rows for which a closed loop does a frame again.
    double excess(std::uint32_t frame, const std::vector<ClothStatistics>& cloths);

    /// Returns what makes a frame no result: of the first cloth that is beyond a bound the value that is farthest
    /// beyond, else the first of those that are of all cloths. Ask it of each frame once, in order. What a frame is
    /// judged by does not depend on how many follow it.
    std::optional<Implausible> implausible(std::uint32_t frame, const std::vector<ClothStatistics>& cloths);

    /// Returns what to say of the frames that were asked about, beside what is implausible.
    std::vector<std::string> warnings() const;

    /// The worst stretch errors, RMS and of a single spring, of all frames that were asked about. Nothing: none was.
    const std::optional<double>& worst_rms() const { return worst_rms_; }
    const std::optional<double>& worst_max() const { return worst_max_; }

    /// Writes or reads what it remembers of earlier frames, by a ByteWriter or a ByteReader. Returns false where what
    /// was read is nothing that it can come to.
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
    /// A warning tells of its first frame and of the worst one.
    struct Note {
        std::uint32_t first = 0, worst = 0, cloth = 0;
        double value = 0;  ///< 0: there was nothing
        std::optional<std::uint32_t> particle = {};
    };
    Seen seen(std::uint32_t frame, std::size_t cloth, std::span<const ClothStatistics> all) const;
    Implausible worst(std::uint32_t frame, const std::vector<ClothStatistics>& cloths, bool in_order) const;
    void remember(std::uint32_t frame, const std::vector<ClothStatistics>& cloths);

    Causes causes_;
    std::optional<double> worst_rms_, worst_max_;
    std::vector<Note> notes_;                        ///< of the rows that warn, in their order
    std::deque<double> starts_depth_;                ///< m, each cloth's penetration in frame 0
    std::deque<double> recent_;                      ///< largest stretch error of a spring, by frame
    std::uint32_t last_frame_ = 0, last_cloth_ = 0;  ///< the last of these, and its cloth with the worst spring
};

}  // namespace drape
