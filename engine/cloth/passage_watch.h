// Notices frames in which a collider may have passed between the particles of a cloth, which contact cannot rule out.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cloth/simulation_model.h"
#include "drape/statistics.h"

namespace drape {

/// Contact keeps particles out of every collider, however fast. What is drawn between them it keeps out
/// - of a box if nothing near it goes farther in a substep than half of what the box measures at its thinnest and the
///   thickness, because edges meet edges only where they end;
/// - of round colliders if no triangle of the cloth is so wide that the collider fits between its corners.
/// It is judged by a frame's statistics: the fastest particle at its begin and end, the longest spring, and a ball
/// about the centre of mass that holds the cloth. So what is far from the cloth is left out, and nothing is read back
/// for it.
class PassageWatch {
  public:
    explicit PassageWatch(const SimulationModel& model);
    /// Frames come in order; `substeps`: those of this frame.
    void look(std::uint32_t frame, std::uint32_t substeps, std::span<const ClothStatistics> cloths);
    /// Returns what to tell the run; nothing if contact kept its bounds in every frame seen.
    std::optional<std::string> text() const;

  private:
    struct Passage {
        std::uint32_t frame;
        std::size_t cloth, collider;
        double way, kept;  ///< m: what went by, or the widest hole, and what contact allows
        bool by_way;       ///< else a triangle is too wide
    };
    std::optional<Passage> passage(std::uint32_t frame, std::uint32_t substeps, std::size_t cloth,
                                   const ClothStatistics& before, const ClothStatistics& now) const;

    const SimulationModel& model_;
    std::vector<ClothStatistics> last_;  ///< of the frame seen last; empty before the first
    std::uint32_t last_frame_ = 0, frames_ = 0;
    std::optional<Passage> first_;
};

}  // namespace drape
