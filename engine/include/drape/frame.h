// These are the values that a simulation hands out: frames, what each took, and the cuts found at its end.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drape/error.h"
#include "drape/statistics.h"
#include "drape/vec3.h"

namespace drape {

/// Milliseconds that the device spent on a stage of a frame.
struct StageTime {
    std::string name;
    double milliseconds = 0;
};

/// An attempt of method `auto` at a frame, or at a few frames together, may fail by one of these (docs/solvers.md).
enum class Criterion { stretch, motion, passage, lag, watch };
inline constexpr std::array<std::string_view, 5> criterion_names{"stretch", "motion", "passage", "lag", "watch"};
struct FailedAttempt {
    std::uint32_t substeps = 0;
    Criterion criterion = {};
    double times = 0;  ///< what was measured, divided by its limit
};

/// The work that a frame took.
struct FrameEffort {
    std::uint32_t substeps = 0;
    std::uint32_t attempts = 1;              ///< method `auto`: 1 where the first was kept
    std::vector<FailedAttempt> failed = {};  ///< the attempts before the one that was kept, in their order
    /// Method `auto` estimates the error of the motion in this frame, that of the worst cloth, in m per second of
    /// simulated time; NaN where it did not.
    double motion_error = std::numeric_limits<double>::quiet_NaN();
    /// tolerance_motion allows this cloth so much, m/s.
    double motion_allowed = std::numeric_limits<double>::quiet_NaN();
    /// Method `auto` estimates how far the frame's positions are from those of the exact motion by now: the RMS over
    /// the worst cloth's mass, m, true within a factor of 3 in four of five scenes; NaN where nothing was simulated,
    /// and where equally exact runs have long parted as far.
    double position_error = std::numeric_limits<double>::quiet_NaN();
    /// The position error of the last frame, if it goes on growing in proportion to time, m.
    double position_error_at_end = std::numeric_limits<double>::quiet_NaN();
    /// The position error that tolerance_motion allows until then, m.
    double position_allowed = std::numeric_limits<double>::quiet_NaN();
    /// Method `auto` found, in this frame or before, that equally exact runs part by half of position_error or more
    /// (cloth that crumples): so much of it, `parted`, is no fault of the run. Stretch, contact and means hold all the
    /// same.
    bool sensitive = false;
    /// How far apart such runs were when they were last compared, m; NaN: they were not.
    double parted = std::numeric_limits<double>::quiet_NaN();
    /// Method `auto` sets false where motion_error is above its limit and more substeps do not reduce it. Cloth that
    /// crumples parts from its neighbouring motions whatever is done; its stretch error is kept all the same.
    bool predictable = true;
    /// Method `auto` found that everything lies still: the frame is the one before it, nothing was simulated, and
    /// velocities and kinetic energies are 0.
    bool asleep = false;
    /// Method `auto` sets false where its largest number of substeps misses a limit (only without keep_promises).
    bool within_limits = true;
};

/// A body that cloth moves (Collider::mass), at a frame's end.
struct BodyState {
    std::size_t collider = 0;                         ///< its number among the scene's, as Simulation::scene() has them
    Vec3 position{};                                  ///< m: the centre of its shape
    std::array<double, 4> turn{0, 0, 0, 1};           ///< unit quaternion x y z w: world from the shape's own axes
    Vec3 velocity{};                                  ///< m/s, of its centre of mass
    Vec3 angular_velocity{};                          ///< rad/s
    Vec3 momentum{};                                  ///< kg m/s
    Vec3 angular_momentum{};                          ///< kg m^2/s, about the origin
    double kinetic_energy = 0, potential_energy = 0;  ///< J; the latter is 0 at the origin
};

/// It is what the centre of a pixel sees, in the bytes of a texel that the device writes.
struct LayerPixel {
    float depth = std::numeric_limits<float>::infinity();  ///< m along the camera's axis; infinity: nothing is there
    std::array<std::int16_t, 3> normal{};  ///< 32767 times the unit normal of the side in view, in the world; else 0
    std::uint16_t id = 0;                  ///< 0: nothing; then the cloths from 1 on, the colliders; 65535: a fixture
    float strain = 0;                      ///< of cloth: that of the most stretched spring at the place; else 0
};
/// Ids of colliders follow those of the cloths; poles, rails, knobs and the rims of blades have one.
inline constexpr std::uint16_t fixture_id = 65535;

/// Particles are numbered row * columns + column.
struct FinishedFrame {
    std::uint32_t frame = 0;                         ///< shows the time frame / fps; 0 is the initial state
    std::span<const std::uint8_t> rgba;              ///< empty unless drawn: rows from the top, sRGB
    std::span<const LayerPixel> layers;              ///< empty unless wanted: of the picture's size, rows from the top
    std::vector<std::span<const float>> positions;   ///< per cloth, when wanted: x y z (m) and w per particle, w being
                                                     ///< its inverse mass over an inner particle's; 0: held
    std::vector<std::span<const float>> velocities;  ///< per cloth, when wanted: x y z (m/s) and 0
    std::vector<std::span<const float>> normals;     ///< per cloth, when wanted: unit x y z of the front, and 0
    /// Per cloth, where the scene has `force_fields` and positions are wanted: what the four springs bear that a
    /// particle is the first of, N, pulled above 0: to the right (column + 1), down (row + 1), down right and down
    /// left; 0 where there is none, NaN where the method keeps none (rigid springs of `relax`).
    std::vector<std::span<const float>> tensions;
    /// Likewise: the mean force of contact, with colliders and cloth, on the particle in the frame, N, x y z and 0.
    std::vector<std::span<const float>> contact_forces;
    std::vector<ClothStatistics> statistics;  ///< per cloth, when wanted
    std::vector<BodyState> bodies;            ///< of every body that has a mass
    FrameEffort effort;
    std::optional<FrameFailure> failure;  ///< set only where statistics are wanted
    std::vector<StageTime> timings;       ///< empty where the device has no timestamps
};

/// A cut found at the end of a frame; it acts from the next frame on.
struct Cut {
    std::uint32_t frame = 0;
    std::size_t cloth = 0;
    std::uint32_t springs = 0, triangles = 0;  ///< cut and split in this frame
    std::uint32_t torn = 0;                    ///< of the springs, those that bore too much, and the diagonals between
    std::uint32_t pieces = 0;                  ///< that there are now, crumbs among them
    std::uint32_t crumbs = 0;                  ///< pieces that now have less than four triangles of the grid
    std::vector<std::uint32_t> faces;          ///< three particles for each triangle that is drawn whole
    std::vector<std::uint8_t> spring_bits;     ///< Simulation::spring_bits now
};

}  // namespace drape
