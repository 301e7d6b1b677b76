// Keys that make a cloth stiffer do work on it: from the frame on in which their factor rises, what its springs and its
// bending hold is worth more.
#pragma once

#include <cstdint>
#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

class Stiffening {
  public:
    /// `model` must outlive this.
    explicit Stiffening(const SimulationModel& model);

    /// Returns whether the stiffness of any cloth rises.
    bool happens() const { return !done_.empty(); }

    /// Returns m/s at which a cloth comes back that gravity stretched at its softest: the strain rho g L/(k f) of a
    /// strip that hangs by its end, at the speed of waves sqrt(k/rho) of the whole stiffness. 0: it does not rise.
    double recoil(std::size_t cloth) const;

    /// Does the work of a frame's factors on what was kept of the frame before. Frames come in order.
    void begin(std::uint32_t frame);
    /// `elastic_energy`: J that a cloth holds at the end of the frame that was begun.
    void keep(std::size_t cloth, double elastic_energy) { kept_[cloth] = elastic_energy; }
    /// Returns the work that was done on a cloth so far, J.
    double done(std::size_t cloth) const { return happens() ? done_[cloth] : 0; }

    /// Writes or reads what changes. Returns false where what was read is not of this model.
    template <class Archive>
    bool transfer(Archive& archive) {
        if (!happens()) return true;
        const std::size_t count = done_.size();
        archive(done_, kept_);
        return done_.size() == count && kept_.size() == count;
    }

  private:
    const SimulationModel& model_;
    std::vector<double> done_, kept_;  ///< by cloth; empty where no stiffness rises
};

}  // namespace drape
