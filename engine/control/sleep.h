// A closed loop need not simulate while everything lies or hangs still and nothing that acts on it changes.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "cloth/simulation_model.h"
#include "drape/statistics.h"

namespace drape {

/// Returns whether nothing that the host knows of changes in a frame: no gust, no collider or pin that is moved, no
/// release, no cutter.
bool quiet(const SimulationModel& model, std::uint32_t frame);

class Sleep {
  public:
    /// `model` is that of a closed loop, and must outlive this.
    explicit Sleep(const SimulationModel& model) : model_(model) {}

    /// Sees the next frame that was simulated, with so many substeps.
    void saw(const std::vector<ClothStatistics>& cloths, std::uint32_t substeps);

    /// Returns whether the frame is the one before it: for a second no particle was faster than a hundredth of what the
    /// motion may err per second, nor faster at its end than at its beginning (what is about to topple), rounding
    /// apart, and the frame is quiet. A frame that is not wakes the cloths, with the state they fell asleep in.
    bool asleep(std::uint32_t frame);

    /// Forgets what it saw: a cloth that tore will move.
    void wake() { speeds_.clear(); }

    /// Writes or reads what changes, like SubstepControl's.
    template <class Archive>
    bool transfer(Archive& archive) {
        archive(speeds_);
        return speeds_.size() <= remembered();
    }
    /// Returns whether it has seen a frame since it last woke.
    bool remembers() const { return !speeds_.empty(); }

  private:
    std::size_t remembered() const;  ///< most frames that it remembers

    const SimulationModel& model_;
    std::deque<double> speeds_;  ///< the worst cloth's over its limit, for the last second's frames
};

}  // namespace drape
