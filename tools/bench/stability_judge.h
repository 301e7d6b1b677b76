// The judge of the stability benchmark: independent of the program's own watch and of what its methods promise, it sees
// a scene, the positions of every frame and the numbers that the device reduced before anything was clamped.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/bench_case.h"
#include "cloth/simulation_model.h"
#include "drape/simulation.h"

namespace drape::bench {

/// Over how many frames in a row something must be wrong to be more than an impact or a snap.
inline constexpr std::size_t sustained_frames = 6;

/// Sees a run frame by frame.
class StabilityJudge {
  public:
    /// `model` must outlive this.
    explicit StabilityJudge(const SimulationModel& model);

    void see(const FinishedFrame& frame);

    /// Whether the last frames keep `stretch_law`, and everything else.
    bool recovered() const;

    /// Over the frames so far:
    ///   frames, substeps_max
    ///   non_finite        particles, most in a frame
    ///   distance          largest distance from the origin over the ballistic bound
    ///   energy            kinetic and potential energy gained, over 1e-4 of the scene's scale per substep so far; only
    ///                     where nothing does work on the cloth
    ///   stretch, stretch_sustained, stretch_end   largest stretch error of a spring: worst, held for
    ///                     `sustained_frames`, and of the last so many
    ///   stretch_law       0.02 + 0.12 Lambda + 2 U, Lambda = a D^2 N^2/(h K), a of gravity and wind; at most 1/3; of
    ///                     method auto: what it promises; at least what pins hold strained at the start
    ///   stretch_allowed   three times that with v^2/L in a, v of the start, pins and colliders; at least what the
    ///   cloth
    ///                     starts strained by
    ///   penetration, penetration_end   deepest, over an edge's length; where pins hold nothing inside a collider
    ///   pins              largest distance of a held particle from where its pin has it, over what single precision
    ///                     can tell there; 0: bit-identical
    ///   mass              largest relative change
    ///   flight            of cloth that nothing holds or touches: distance of the centre of mass from the closed form,
    ///                     over 1e-5 (above 64 substeps per frame 1e-4) of the farthest coordinate and the way fallen
    Metrics numbers() const;

  private:
    void see_cloth(std::size_t index, const FinishedFrame& frame, double time);
    void see_pins(const ClothModel& cloth, std::span<const float> positions, double time);
    double bound_of_distance(std::size_t index, double time, const ClothStatistics& statistics) const;
    /// `driven`: with what moves.
    double law(std::uint32_t substeps, bool driven) const;
    double flight_error(std::size_t index, const ClothStatistics& statistics, double time) const;

    struct Start {
        double distance = 0, mass = 0, energy = 0, scale = 0, edge = 0, strain_speed = 0, held_strain = 0;
        double wave = 0, shorter = 0;  ///< m/s, of strain; m, of the cloth's sides
        double strained = 0;           ///< largest of a spring so far, without what its tension does not explain
        Vec3 mean{};
        bool held = false, flies = false;
    };
    const SimulationModel& model_;
    std::vector<Start> starts_;
    bool passive_;
    double steps_ = 0, travel_ = 0;
    double drive_ = 0;                           ///< m/s, largest, of pins and colliders
    std::vector<double> stretch_, penetration_;  ///< by frame after the first: the worst cloth's
    Metrics worst_;
};

/// The first of the numbers that is over its limit. Empty: none.
std::string breach(const Metrics& numbers, double stretch_limit, double penetration_limit);

/// Silent garbage: pins not where they are held, outside the box, not finite, or stretched beyond three times the law
/// (for `sustained_frames` somewhere, or at the end). Empty: none.
std::string garbage(const Metrics& numbers);

}  // namespace drape::bench
