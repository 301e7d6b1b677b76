// Notices frames in which a collider may have passed between the particles of a cloth, which contact cannot rule out.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cloth/statistics_transfer.h"
#include "control/bounds.h"

namespace drape {

/// Contact keeps the particles of a cloth out of every collider, however fast it moves. For the triangles drawn between
/// particles, the rows of passage_bounds() say up to which motion contact is reliable. They are evaluated from a
/// frame's statistics: the fastest particle at its start and end, the longest spring, and a ball about the centre of
/// mass that holds the cloth. Colliders far from the cloth are left out, and nothing is read back for this.
struct Passage {
    std::uint8_t row = 0;  ///< of passage_bounds() (bounds.h)
    std::uint32_t frame = 0, cloth = 0, collider = 0;
    double found = 0, kept = 0;  ///< the value found, and the largest one at which contact is reliable
};

/// Returns by what factor the motions and turns of a frame's substeps exceed what contact handles reliably, in the
/// worst case; 0 where no collider is near. More substeps reduce it, unlike the size of a triangle. `before`:
/// statistics at the start of the frame.
double passage_judgement(const SimulationModel& model, std::uint32_t frame, std::uint32_t substeps,
                         std::span<const ClothStatistics> before, std::span<const ClothStatistics> now);

class PassageWatch {
  public:
    /// `model` must outlive this.
    explicit PassageWatch(const SimulationModel& model) : model_(model) {}
    /// Frames come in order; `substeps`: those of this frame.
    void look(std::uint32_t frame, std::uint32_t substeps, std::span<const ClothStatistics> cloths);
    /// Returns the warning for the run; nothing if contact kept its bounds in every frame seen.
    std::optional<std::string> text() const;

    /// Writes or reads what it remembers of earlier frames, by a ByteWriter or a ByteReader. Returns false where what
    /// was read is nothing that it can come to.
    template <class Archive>
    bool transfer(Archive& archive) {
        bool seen = !last_.empty();
        archive(last_frame_, frames_, seen, first_.row, first_.frame, first_.cloth, first_.collider, first_.found,
                first_.kept);
        last_.resize(seen ? model_.cloths.size() : 0);
        for (ClothStatistics& cloth : last_) transfer_statistics(archive, cloth);
        const bool told =
            frames_ == 0 || (first_.cloth < model_.cloths.size() && first_.collider < model_.scene.colliders.size());
        return told && first_.row < passage_bounds().size();
    }

  private:
    const SimulationModel& model_;
    std::vector<ClothStatistics> last_;  ///< of the frame seen last; empty before the first
    std::uint32_t last_frame_ = 0;
    std::uint32_t frames_ = 0;  ///< number of frames in which something may have passed
    Passage first_;             ///< valid only where `frames_` is not 0
};

}  // namespace drape
