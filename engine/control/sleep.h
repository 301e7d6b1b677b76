// A closed loop need not simulate while everything lies or hangs still and nothing that acts on it changes.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "cloth/simulation_model.h"
#include "drape/statistics.h"

namespace drape {

/// Returns whether nothing that the host knows of changes in a frame: there is no gust, no moving collider or pin, no
/// release and no cutter.
bool quiet(const SimulationModel& model, std::uint32_t frame);

class Sleep {
  public:
    /// `model` is that of a closed loop, and must outlive this.
    explicit Sleep(const SimulationModel& model) : model_(model) {}

    /// Takes the statistics of the next frame that was simulated, and its number of substeps.
    void saw(const std::vector<ClothStatistics>& cloths, std::uint32_t substeps);

    /// Returns whether the frame repeats the one before it. It does if the frame is quiet and for a second, apart from
    /// rounding, no particle was faster than a hundredth of the speed that the motion's limit allows as an error, nor
    /// faster at the end of this second than at its start (as cloth is that is about to topple). A frame that does not
    /// repeat wakes the cloths, with the state in which they fell asleep.
    bool asleep(std::uint32_t frame);

    /// Returns whether everything was as still in the last frame. Other substeps might move it.
    bool is_still() const { return !speeds_.empty() && speeds_.back() <= 1; }

    /// Drops the speeds of past frames, because a cloth that tore will move.
    void wake() { speeds_.clear(); }

    /// Writes or reads what changes, as SubstepControl::transfer does.
    template <class Archive>
    bool transfer(Archive& archive) {
        archive(speeds_);
        return speeds_.size() <= remembered();
    }
    /// Returns whether it was given a frame since it last woke.
    bool remembers() const { return !speeds_.empty(); }

  private:
    std::size_t remembered() const;  ///< the largest number of frames that it remembers

    const SimulationModel& model_;
    std::deque<double> speeds_;  ///< the worst cloth's speed divided by its limit, for the frames of the last second
};

}  // namespace drape
