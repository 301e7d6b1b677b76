// The causes in a scene of what its cloths do: how cloths start, and what pulls, pushes, blows and carries them.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "cloth/simulation_model.h"
#include "drape/statistics.h"

namespace drape {

/// Returns the statistics of frame 0 as far as they are known without a device: mass shares, centres of mass, strains,
/// speeds.
std::vector<ClothStatistics> starting_statistics(const SimulationModel& model);

class Causes {
  public:
    /// `model` must outlive this.
    explicit Causes(const SimulationModel& model);

    /// A cloth at its start.
    struct Start {
        double distance = 0;      ///< m from the origin to the farthest particle
        Vec3 mean{};              ///< m, centre of mass
        double diagonal = 0;      ///< m
        double strain = 0;        ///< strain of the springs of a cloth that starts stretched or compressed
        double held_strain = 0;   ///< strain of springs whose two ends pins hold
        bool held = false;        ///< pins hold it for good
        double square_speed = 0;  ///< m^2/s^2, the mean by mass
        double wave = 0;          ///< m/s at which strain spreads and is released
        double released = 0;      ///< m/s that a cloth gains when its initial strain and bending are released
        double blown = 0;         ///< m/s that gas may give to it
        double recoil = 0;        ///< m/s that a cloth gains when it stiffens after gravity stretched it at its softest
        std::vector<double> load_masses{};  ///< local_load_masses (cloth/loads.h)
        std::optional<Vec3> upright{};      ///< stands_upright (balance.h)
    };
    /// How pins and colliders move from the start to the end of a frame.
    struct Drive {
        double speed = 0;         ///< m/s, the largest so far: that of a pin, or twice that of a collider's surface
        double travel = 0;        ///< m, the sum of these speeds times their time
        double pace = 0;          ///< m/s, the largest so far, averaged over a frame; of colliders their centres' alone
        std::uint32_t moved = 0;  ///< the last frame in which `pace` was not 0
    };
    /// The motion of a cloth that its causes explain: its speed, m/s, and how far it is carried, m.
    struct Reach {
        double speed, travel;
    };
    /// The energies, J, of a cloth: the kinetic and potential energy gained since the start; what it started with and
    /// may fall through, m v0^2/2 + m g d; and what its release, contact and keys that stiffen it gave it.
    struct Energy {
        double gained = 0, scale = 0, given = 0;
        double mass = 0;  ///< kg
    };

    const SimulationModel& model() const { return model_; }
    const std::vector<Start>& starts() const { return starts_; }
    /// The frame must not be later than the last one that `extend` was given.
    const Drive& drive(std::uint32_t frame, std::size_t cloth) const { return drives_[frame - first_][cloth]; }
    /// Computes what moves the cloths until a frame's end, by the model's paths as they are now.
    void extend(std::uint32_t frame);

    /// Returns the speed and the distance that everything that acts on a cloth can give it. A cloth that a much heavier
    /// one strikes leaves, if no energy is lost, at twice the heavier one's speed beyond its own, and may be carried as
    /// far.
    Reach reach(std::uint32_t frame, std::size_t cloth) const;
    /// Returns whether something moves the cloths, or did so within these seconds before the frame.
    bool driven(std::uint32_t frame, double seconds) const;
    /// Returns whether keys that stiffen cloths are the only thing that does work on them.
    bool passive() const { return passive_; }
    Energy energy(std::size_t cloth, const ClothStatistics& now) const;

    /// Returns whether keys make a cloth stiffer. From the frame in which the factor rises, the strain in its springs
    /// and bending holds more energy.
    bool stiffens() const { return !work_.empty(); }
    /// Extends the drives, and computes the work that the frame's stiffness factors do on the energy kept from the
    /// frame before. Frames come in order.
    void begin(std::uint32_t frame);
    /// `held`: the energy, J, that a cloth holds at the end of the frame that was begun.
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
    bool led_apart_;  ///< contact lifts cloths apart that started through each other
    bool passive_;
    std::uint32_t first_ = 0;                ///< the frame that `drives_` begins with
    std::deque<std::vector<Drive>> drives_;  ///< by frame and cloth, of the last frames that were asked for
    std::vector<double> work_,
        kept_;  ///< J by cloth: the work of keys, and the energy in springs; empty: no key stiffens a cloth
};

}  // namespace drape
