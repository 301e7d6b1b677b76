// A scene's causes of what its cloths do: how they start, and what pulls, pushes, blows and carries them.
#pragma once

#include <deque>
#include <vector>

#include "cloth/simulation_model.h"
#include "drape/statistics.h"

namespace drape {

/// Returns what is known of the statistics of frame 0 without a device: mass shares, centres of mass, strains, speeds.
std::vector<ClothStatistics> starting_statistics(const SimulationModel& model);

class Causes {
  public:
    /// `model` must outlive this.
    explicit Causes(const SimulationModel& model);

    /// A cloth where it starts.
    struct Start {
        double distance = 0;      ///< m, the farthest particle's from the origin
        Vec3 mean{};              ///< m, centre of mass
        double diagonal = 0;      ///< m
        double strain = 0;        ///< its springs', where it starts stretched or compressed
        double held_strain = 0;   ///< that of springs that pins hold at both ends
        bool held = false;        ///< pins hold it for good
        double square_speed = 0;  ///< m^2/s^2, the mean by mass
        double wave = 0;          ///< m/s at which strain comes back
        double released = 0;      ///< m/s at which the strain and the bending come back that it starts with
        double recoil = 0;        ///< m/s at which it comes back that gravity stretched while keys had it softest
    };
    /// Pins and colliders that move, from the start to the end of a frame.
    struct Drive {
        double speed = 0;         ///< m/s, the largest so far of pins and twice that of the colliders' surfaces
        double travel = 0;        ///< m, such speeds times their time
        double pace = 0;          ///< m/s, largest so far, for a frame as a whole and of colliders the centres' alone
        std::uint32_t moved = 0;  ///< the last frame in which there was a pace
    };
    /// A cloth's motion as far as there are causes: m/s, and m that it is carried.
    struct Reach {
        double speed, travel;
    };
    /// The energies, J, of a cloth: what it has gained since the start, kinetic and potential; what it started with and
    /// may fall through, m v0^2/2 + m g d; and what its release, contact and keys that make it stiffer gave it.
    struct Energy {
        double gained = 0, scale = 0, given = 0;
        double mass = 0;  ///< kg
    };

    const SimulationModel& model() const { return model_; }
    const std::vector<Start>& starts() const { return starts_; }
    /// The frame must not be beyond the last one that `extend` was told.
    const Drive& drive(std::uint32_t frame, std::size_t cloth) const { return drives_[frame - first_][cloth]; }
    /// Looks at what moves the cloths until a frame's end, by the model's paths as they are now.
    void extend(std::uint32_t frame);

    /// Returns the speed and the way that a cloth may have by all that acts on it. One that is struck by a much heavier
    /// one leaves, if nothing is lost, at twice that one's speed beyond its own; and it may be carried as far.
    Reach reach(std::uint32_t frame, std::size_t cloth) const;
    /// Returns whether something moves the cloths, or did in the last seconds.
    bool driven(std::uint32_t frame, double seconds) const;
    /// Returns whether nothing does work on the cloths but keys that make them stiffer.
    bool passive() const { return passive_; }
    Energy energy(std::size_t cloth, const ClothStatistics& now) const;

    /// Returns whether keys make a cloth stiffer. What its springs and its bending hold is then worth more from the
    /// frame on in which the factor rises.
    bool stiffens() const { return !work_.empty(); }
    /// Extends it, and does the work of a frame's factors on what was kept of the frame before. Frames come in order.
    void begin(std::uint32_t frame);
    /// `held`: J that a cloth holds at the end of the frame that was begun.
    void keep(std::size_t cloth, double held) { kept_[cloth] = held; }

    /// Writes or reads what changes. Returns false where what was read is not of this model.
    template <class Archive>
    bool transfer(Archive& archive) {
        if (!stiffens()) return true;
        archive(work_, kept_);
        return work_.size() == starts_.size() && kept_.size() == starts_.size();
    }

  private:
    void advance(std::size_t cloth, std::uint32_t frame, Drive& drive) const;
    double pushed() const;
    double own_speed(std::uint32_t frame, std::size_t cloth) const;

    const SimulationModel& model_;
    std::vector<Start> starts_;
    bool led_apart_;  ///< some cloths are, from others that they started through
    bool passive_;
    std::uint32_t first_ = 0;                ///< the frame of the first drives
    std::deque<std::vector<Drive>> drives_;  ///< by frame and cloth, of the last frames that were asked about
    std::vector<double> work_, kept_;        ///< J by cloth: of keys, and what springs hold; empty: none is stiffened
};

}  // namespace drape
