// The statistics tell of a cloth at the end of a frame how far its springs are from their rest lengths, its energies,
// how deep it is in the colliders, and whether it is finite.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace drape {

/// Strain is (length - rest length) / rest length, over every existing spring of a family, each counted once.
struct StrainStatistics {
    std::uint32_t spring_count = 0;  ///< 0: the other members mean nothing
    double rms = 0;
    double largest = 0;   ///< most stretched
    double smallest = 0;  ///< most compressed (negative)
};

/// What pulled or pushed a cloth in a frame, averaged over it.
struct ForceOnCloth {
    std::string by;  ///< as in the names of the manifest's numbers: "gravity", "pins_0", "collider_2_sphere"
    std::array<double, 3> force{};                  ///< N
    std::optional<std::array<double, 3>> moment{};  ///< N m, of a collider, about its centre
    /// N and N m: the largest in one of the frame's substeps, where the scene wants `worst_forces` and it is known.
    std::optional<std::array<double, 3>> worst{}, worst_moment{};
};

/// Tells what seams that rip bear at a cloth.
struct SeamStatistics {
    double load = 0;           ///< N/m: the largest at a place that holds, averaged over the frame
    std::uint32_t ripped = 0;  ///< particles of the cloth at places that have come apart
};

/// Tells of the gas that a cloth closes in, the same by all cloths that do.
struct GasStatistics {
    double pressure = 0;  ///< Pa, above the ambient one: in the frame's last substep, at the start in frame 0
    double volume = 0;    ///< m^3: what is closed in at the frame's end
};

/// Values are in SI units, of all particles that are finite, held ones included. Far from anything sensible (1e19 m) a
/// number may overflow to infinity before the positions do.
struct ClothStatistics {
    StrainStatistics stretch, shear;  ///< strain of the positions; soft cloth may stretch truly
    /// RMS and largest magnitude of strain - tension/(k l) over the stretch springs, with the tension that the solver
    /// applied in the last substep. A perfect solve makes it zero; `tolerance` bounds the RMS.
    double stretch_error_rms = 0, stretch_error_max = 0;
    /// J, from the velocities at the frame's end: those of the last substep and half its acceleration.
    double kinetic_energy = 0;
    double potential_energy = 0;       ///< J, gravity's; 0 at the origin
    double elastic_energy = 0;         ///< J, of bending and of springs; rigid ones store none
    std::array<double, 3> momentum{};  ///< kg m/s, at the frame's end
    /// kg m^2/s, over the last substep; about the centre of mass, or of cloth that is held on an axis on which it turns
    /// freely, about a point of that.
    std::array<double, 3> angular_momentum{};
    /// kg m^2/s: what the method made of it in this frame out of nothing, and took back by turning the cloth.
    std::array<double, 3> angular_error{};
    /// Where the scene wants `forces`, from frame 1 on: all that changed the momentum in the frame, so the sum times
    /// the frame's time is that change.
    std::vector<ForceOnCloth> forces;
    std::optional<SeamStatistics> seams{};   ///< from frame 1 on, of a cloth with a seam that rips
    std::optional<GasStatistics> gas{};      ///< of a cloth that closes gas in
    double mass = 0;                         ///< kg
    std::array<double, 3> center_of_mass{};  ///< m
    /// m: largest depth of a particle in the zone that contacts keep free (with the thickness); nothing: no colliders.
    std::optional<double> penetration;
    double largest_distance = 0;  ///< m from the origin
    double largest_speed = 0;     ///< m/s
    /// Number of iterations that the frame ran over all its substeps; nothing when none can be skipped.
    std::optional<std::uint32_t> iteration_count;
    std::uint32_t non_finite_count = 0;  ///< particles whose position or displacement is not finite
    std::uint32_t first_non_finite = 0;  ///< index (row * columns + column) when there is one
    /// Indices of the farthest, fastest and deepest particle, and of the first particle of the spring with the largest
    /// stretch error; the lowest of several, nothing where there is none.
    std::optional<std::uint32_t> farthest, fastest, deepest, most_stretched;
};

}  // namespace drape
