// The spring network of one cloth in double precision is the physical model that Drape's solvers approximate, as plain
// data with its energy, gradient and Hessian. It is built from the grid by docs/physics.md 1, independently of the
// arrays that the device gets, and has no colliders. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cloth/directions.h"
#include "cloth/grid.h"
#include "drape/scene.h"

namespace drape {

/// Its energy is stiffness/2 (|r| - rest_length)^2 and its force stiffness (|r| - rest_length) along r, both times
/// `compression` where |r| < rest_length.
struct NetworkSpring {
    std::uint32_t first, second;
    double stiffness;    ///< N/m, the border's half included
    double rest_length;  ///< m
    SpringFamily family;
    double compression = 1;
    double stiffness_at(double size) const { return size < rest_length ? compression * stiffness : stiffness; }
};

/// Its energy is stiffness/2 |sum_k coefficient_k x_(particle_k)|^2, with coefficients that sum to zero. Along an axis
/// of spacing h (perpendicular spacing p) the coefficients are 1 -2 1 (0) and the stiffness is B w p/h^3, w = 1 inside,
/// 1/2 along a border; on the corners 00 10 01 11 of a cell they are 1 -1 -1 1 and 2 B/(dx dy). Then sum E = B/2
/// integral of kxx^2 + kyy^2 + 2 kxy^2, the isotropic plate of Poisson's ratio 0 (the axes alone would be half as stiff
/// along 45 degrees), and a narrow strip is the elastica of rigidity B per width. It is the quadratic bending of
/// isometric surfaces (Bergou et al. 2006) reduced to a regular grid.
struct BendingElement {
    std::array<std::uint32_t, 4> particle;
    std::array<double, 4> coefficient;  ///< 0 where unused
    double stiffness;                   ///< N/m
};

/// A pin's particles move along `path` and are free from `release` on.
struct NetworkPin {
    MotionPath path;
    Vec3 pivot{0, 0, 0};            ///< m
    std::optional<double> release;  ///< s
    bool operator==(const NetworkPin&) const = default;
};

/// A load of the scene, and what share of its force and which factor of its pressure each particle has.
struct NetworkLoad {
    Load load;
    std::vector<double> share, factor;
};

/// A gas of the scene and the faces that close it in: the corners of each, as they go around its outside. The volume is
/// the mean of both ways to halve each face.
struct NetworkGas {
    Gas gas;
    std::vector<std::array<std::uint32_t, 4>> faces;
};

struct NetworkState {
    std::vector<Vec3> position;  ///< m
    std::vector<Vec3> velocity;  ///< m/s
};

struct NetworkOptions {
    bool ignore_colliders = false;  ///< accept a scene with colliders and leave them out
};

/// Strain |r|/rest_length - 1 of the springs of one family.
struct NetworkStrain {
    double rms = 0, max = 0, min = 0;  ///< max: worst stretch, min: worst compression (negative)
    std::size_t count = 0;
};

/// An entry of the Hessian's lower triangle; particle p's axis k is row 3 p + k. Entries at equal places add up.
struct HessianEntry {
    std::uint32_t row, column;
    double value;  ///< N/m
};

/// With `clamped`, springs under compression contribute no negative geometric stiffness, so the sum is positive
/// semidefinite for any positions.
enum class HessianForm { exact, clamped };

struct SpringNetwork {
    /// An empty network, to be filled by hand (chains, pendulums, pretensioned drums: every member is plain data).
    SpringNetwork() = default;
    /// Throws std::invalid_argument for rigid cloth (no finite stiffness, no energy), for stiffness that changes, for
    /// bending that is at rest in a given shape and for colliders unless ignored.
    SpringNetwork(const SceneDescription& scene, std::size_t cloth_index, const NetworkOptions& options = {});

    std::vector<double> mass;          ///< kg; 0 for a particle without a cell, held for ever
    std::vector<Vec3> rest_position;   ///< m, at the start
    std::vector<std::int32_t> pin_of;  ///< index into pins, -1 = free
    std::vector<NetworkPin> pins;
    std::vector<NetworkSpring> springs;
    std::vector<BendingElement> bending;
    /// Quarters of cells, which feel wind: their particle, and its neighbours there along the row and the column.
    std::vector<std::array<std::uint32_t, 3>> quarters;
    Vec3 start_velocity{0, 0, 0};         ///< m/s, of free particles
    std::vector<Vec3> start_velocities;   ///< the same by particle; empty: all have start_velocity
    Vec3 gravity{0, -9.81, 0};            ///< m/s^2, of the potential energy: that at the start
    std::vector<VectorKey> gravity_keys;  ///< m/s^2; empty: it stays
    double damping = 0;                   ///< 1/s: acceleration -damping * velocity
    Wind wind;
    std::vector<NetworkLoad> loads;
    std::vector<NetworkGas> gas;  ///< of sewn networks (reference/sewn_network.h)

    std::size_t particle_count() const { return mass.size(); }
    /// Returns whether a particle is held at `time`; from its release on it is free.
    bool held(std::uint32_t particle, double time) const;
    bool has_moving_pins() const;
    /// Position and velocity at which the pin holds a particle; the rest position for a particle without a pin.
    Vec3 pinned_position(std::uint32_t particle, double time) const;
    Vec3 pinned_velocity(std::uint32_t particle, double time) const;
    /// Release times > 0, sorted, each once.
    std::vector<double> release_times() const;
    NetworkState start() const;

    double kinetic_energy(std::span<const Vec3> velocity) const;  ///< J, pinned particles included
    double gravity_energy(std::span<const Vec3> position) const;  ///< J, 0 at the origin, pinned ones included
    double spring_energy(std::span<const Vec3> position) const;   ///< J
    double bending_energy(std::span<const Vec3> position) const;  ///< J
    /// J: ambient (V - Vn ln V) of each gas at a time, s. Where Vn stays it is kept with the other energies.
    double gas_energy(std::span<const Vec3> position, double time) const;
    /// Sums gravity, springs and bending, J.
    double potential_energy(std::span<const Vec3> position) const;

    /// dE/dx of the potential energy, which is minus the forces (N), held particles included.
    std::vector<Vec3> gradient(std::span<const Vec3> position) const;
    /// Returns what gravity is more at a time (s) than at the start, m/s^2.
    Vec3 more_gravity(double time) const;
    /// Returns whether anything but gravity acts from outside.
    bool has_outer_forces() const { return wind.blows() || !loads.empty() || !gas.empty(); }
    /// Adds what acts on the particles from outside, N, beside gravity: wind, loads and gas.
    void add_outer_forces(std::span<const Vec3> position, std::span<const Vec3> velocity, double time,
                          std::span<Vec3> force) const;
    /// Adds the loads' forces (N). A pressure acts on each quarter of a cell by its area, towards u x v.
    void add_load_forces(std::span<const Vec3> position, double time, std::span<Vec3> force) const;
    /// Adds the pressures of gas (N): minus the derivative of gas_energy.
    void add_gas_forces(std::span<const Vec3> position, double time, std::span<Vec3> force) const;
    /// Adds the wind's force (N) by the scene's formula per quarter of a cell, to its particle.
    void add_wind_force(std::span<const Vec3> position, std::span<const Vec3> velocity, double time,
                        std::span<Vec3> force) const;
    std::vector<HessianEntry> hessian(std::span<const Vec3> position, HessianForm form) const;

    NetworkStrain strain(std::span<const Vec3> position, SpringFamily family) const;

    /// Upper bound (Gershgorin) of the angular frequencies, rad/s; an explicit step must stay below 2 over it.
    double highest_frequency_bound() const;
    /// 64-bit hash of every number above, equal for equal networks on every machine.
    std::uint64_t fingerprint() const;

  private:
    void place(const Cloth& cloth, const Grid& grid);
    void hold_pins(const Cloth& cloth, const Grid& grid);
    void add_load(const Load& load, const Grid& grid);
    void add_springs(const Cloth& cloth, const Grid& grid);
    void add_bending(const Cloth& cloth, const Grid& grid);
};

}  // namespace drape
