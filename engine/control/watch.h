// No result of a scene exceeds these bounds, which follow from what acts on the cloth, far above what it ever does.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "cloth/simulation_model.h"
#include "control/stiffening.h"
#include "drape/statistics.h"

namespace drape {

/// A frame has something over its bound.
struct Implausible {
    double excess = 0;  ///< value over bound: 1 is the most there can be
    std::string what;   ///< "moves at 8e+03 m/s, where at most 120 m/s are explained", of the particle, or a sentence
    std::string criterion;  ///< "speed, m/s"
    double value = 0, bound = 0;
    std::optional<std::uint32_t> particle;  ///< index; nothing: it is not about a single one
    std::size_t cloth = 0;
};

class Watch {
  public:
    /// `model` must outlive this.
    explicit Watch(const SimulationModel& model);

    /// Looks at what moves the cloths until a frame's end, by the model's paths as they are now. The others do it where
    /// it was not done; frames come in order.
    void extend(std::uint32_t frame);
    /// Returns the worst cloth's largest value over its bound; above 1 a closed loop does the frame again:
    ///   speed     10 (v0 + g t + wind + pins + 2 colliders + recoil) + 0.1 m/s, with the largest speeds so far; g t of
    ///             held cloth ends at 2 sqrt(g d), d its diagonal; recoil: what pins and colliders strained at most
    ///             comes back at the speed of waves, as does what a cloth starts strained by or stretched while soft
    ///   distance  from the origin: the start's, twice the stretched diagonal, the travel of pins and colliders, and
    ///             what free cloth may have flown at twice these speeds
    ///   energy    kinetic and potential, where nothing else does work on it (no wind, steady gravity, nothing moves):
    ///             the start's, a tenth of v0^2 m/2 + m g d, and the work of keys that make it stiffer, on no more
    ///             elastic energy than all that has been lost or given; where there are such keys, a closed loop
    ///             does not ask for it
    ///   penetration  the thickness, a stretched cell, twice the way of such speeds in a substep, and how deep the
    ///   cloth
    ///             starts and pins hold it in a collider
    /// Where cloths meet, one may have twice another's speed beyond its own and be carried as far, and their energies
    /// are judged as one: what one gives is another's.
    double excess(std::uint32_t frame, const std::vector<ClothStatistics>& cloths);

    /// Returns the first cloth's worst value that makes a frame no result: the same and, for methods whose frames are
    /// not judged, a stretch error. Nothing: it is plausible. Ask it of each frame once, in order. Stretch errors have
    /// these bounds, or the scene's own tolerance where that is more:
    ///   0.25 RMS, 1 in a single spring   of any frame; for 5 s what the cloth starts strained by, and for good what
    ///                                    pins hold strained
    ///   1/3 in a single spring           of a cloth at rest (below 1 % of its diagonal in a second): no force that
    ///                                    the scene has keeps it there
    ///   3 (0.02 + 0.12 Lambda)           at most 1, and at least what a cloth starts strained by; of six frames in a
    ///                                    row. Lambda = a D^2 N^2/(h K) of N edges of length h, substep D, K iterations
    ///                                    and the acceleration a of gravity, wind and what moves the cloth
    ///   the same without what moved it   when nothing has moved for 5 s, the cloth's own velocity at the start
    ///   included
    /// The last two are never less than three times what method `auto` keeps, where that chose the substeps or cloths
    /// meet themselves or each other: what lies between layers is pressed together by more than a law of springs knows.
    /// What a frame is judged by does not depend on how many follow it.
    std::optional<Implausible> implausible(std::uint32_t frame, const std::vector<ClothStatistics>& cloths);

    /// Writes or reads what it remembers of earlier frames, by a ByteWriter or a ByteReader. Returns false where what
    /// was read is nothing that it can come to.
    template <class Archive>
    bool transfer(Archive& archive) {
        archive(recent_, last_.frame, last_.cloth, worst_rms_, worst_max_, starts_depth_);
        for (Note* note : {&deep_, &torn_}) archive(note->first, note->worst, note->cloth, note->value, note->particle);
        const std::size_t count = std::max<std::size_t>(starts_.size(), 1);
        return recent_.size() <= frames_in_a_row && last_.cloth < count && deep_.cloth < count && torn_.cloth < count &&
               starts_depth_.size() <= count && stiffening_.transfer(archive);
    }

    /// Returns what to say of the frames that were asked about, beside what is implausible: cloth deeper in what
    /// colliders keep free than a tenth of a cell or its thickness or stretched by half, springs that a longer scene
    /// has to show settled.
    std::vector<std::string> warnings() const;

    /// The worst stretch errors, RMS and of a single spring, of all frames that were asked about. Nothing: none was.
    const std::optional<double>& worst_rms() const { return worst_rms_; }
    const std::optional<double>& worst_max() const { return worst_max_; }

  private:
    static constexpr std::size_t frames_in_a_row = 6;     ///< a single one may be a snap
    static constexpr std::size_t frames_remembered = 64;  ///< more than a closed loop goes back
    /// The things that move a cloth, from the start to the end of a frame.
    struct Drive {
        double speed = 0;         ///< m/s, largest so far
        double travel = 0;        ///< m
        double pace = 0;          ///< m/s, largest so far, for a frame as a whole and centres alone
        std::uint32_t moved = 0;  ///< the last frame in which there was a pace
    };
    /// A cloth where it starts.
    struct Start {
        double distance;             ///< m, the farthest particle's from the origin
        std::array<double, 3> mean;  ///< m, centre of mass
        double diagonal;             ///< m
        double strain;               ///< its springs', where it starts stretched or compressed
        double held_strain;          ///< that of springs that pins hold at both ends
        bool held;                   ///< pins hold it for good
        double bending;              ///< J, stored at the start
        double square_speed = 0;     ///< m^2/s^2, the mean by mass
    };
    void remember(const ClothStatistics& statistics);
    Drive next_drive(std::size_t cloth, std::uint32_t frame, const Drive& before) const;
    const Drive& drive_at(std::size_t cloth, std::uint32_t frame) const { return drives_[cloth][frame - first_]; }
    double drive_speed(std::size_t cloth, double from, double to) const;
    double pace(std::size_t cloth, double from, double to) const;
    /// A cloth's motion as far as it is explained: m/s, and m that it is carried.
    struct Reach {
        double speed, travel;
    };
    struct Gain {
        double energy, explained;  ///< J
    };
    double pushed() const;
    double released(std::size_t cloth) const;
    double own_speed(std::uint32_t frame, std::size_t cloth) const;
    Reach reach(std::uint32_t frame, std::size_t cloth) const;
    Implausible worst(std::uint32_t frame, std::size_t cloth, const ClothStatistics& statistics) const;
    Gain gain(std::size_t cloth, const ClothStatistics& statistics) const;
    Gain gain(const std::vector<ClothStatistics>& cloths, std::size_t first, std::size_t count) const;
    void keep_elastic_energy(const std::vector<ClothStatistics>& cloths);
    Implausible worst_energy(const std::vector<ClothStatistics>& cloths, std::size_t first, std::size_t count) const;
    Implausible worst_of(std::uint32_t frame, const std::vector<ClothStatistics>& cloths, bool stretch) const;
    Implausible worst_stretch(std::uint32_t frame, std::size_t cloth, const ClothStatistics& statistics) const;
    double stretch_law(std::size_t cloth, double speed) const;
    Implausible worst_penetration(std::uint32_t frame, std::size_t cloth, const ClothStatistics& statistics) const;
    double usual_penetration(std::size_t cloth) const;
    void note_penetration(std::uint32_t frame, std::size_t cloth, const ClothStatistics& statistics);
    void note_stretch(std::uint32_t frame, std::size_t cloth, const ClothStatistics& statistics);
    bool driven(std::uint32_t frame) const;
    double allowed_stretch(std::uint32_t frame, bool driven) const;
    std::optional<Implausible> lasting_stretch(std::uint32_t frame, const std::vector<ClothStatistics>& cloths);

    const SimulationModel& model_;
    std::vector<Start> starts_;
    std::uint32_t first_ = 0;                ///< frame of the first of a cloth's drives
    std::vector<std::deque<Drive>> drives_;  ///< by cloth, for the last frames that were asked about
    Stiffening stiffening_;
    bool passive_;
    bool led_apart_;  ///< some cloths are, from others that they started through
    std::optional<double> worst_rms_, worst_max_;
    /// Something to be warned of: its first frame, and the worst one's.
    struct Note {
        void keep(std::uint32_t frame, std::size_t index, double now, std::optional<std::uint32_t> at);
        std::uint32_t first = 0, worst = 0, cloth = 0;
        double value = 0;  ///< 0: there was nothing
        std::optional<std::uint32_t> particle = {};
    };
    Note deep_, torn_;
    std::deque<double> starts_depth_;  ///< m, each cloth's penetration in frame 0
    /// The last frame that was asked about, and its cloth with the worst spring.
    struct Last {
        std::uint32_t frame = 0, cloth = 0;
    };
    Last last_;
    std::deque<double> recent_;  ///< largest stretch error of a spring, by frame
};

}  // namespace drape
