// The solver methods are values: from a cloth's geometry and the settings of its substeps, each makes the constants,
// the steps and what others ask. A method is a row of `methods`; nobody asks for its name.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cloth/cloth_geometry.h"
#include "cloth/device_costs.h"
#include "cloth/hang.h"
#include "cloth/step.h"

namespace drape {

/// A method's constants follow from these, beside the cloth.
struct MethodSettings {
    std::uint32_t substeps, iterations;  ///< per frame, per substep
    double substep_length;               ///< s
    Vec3 gravity;                        ///< m/s^2, at the start
    double strain_damping;               ///< SolverSettings' value
    bool collides;                       ///< the scene has colliders
    bool skip = true;                    ///< false: keep needless work that changes no bit
    DeviceKind device = DeviceKind::cpu;
};

/// A method does this with one cloth at one number of substeps.
struct MethodScheme {
    // These are the steps of a substep. Those that no method changes (release, wind, pin motion, collision, check,
    // tethers) are put between them by the schedule.
    std::vector<MethodStep> prediction;  ///< before pin motion
    std::vector<MethodStep> once;        ///< after it: bending
    std::vector<MethodStep> iterated;    ///< in each iteration

    glsl::vec4 start{};  ///< displacement of free particles at the start, m: x(0) - x(-h), the half-kick start, or what
                         ///< else the prediction expects
    std::vector<glsl::vec4> starts{};  ///< the same by particle; empty: all have `start`

    // The steps need these fields beside position and displacement with their remainders.
    bool spare_state = false;         ///< particles gather what springs do: a step reads one state, writes another
    bool spare_displacement = false;  ///< passes over springs or twist may read one and write the other
    bool spare_tension = false;       ///< passes over springs may read the tension and write the other
    bool second_order = false;        ///< displacement before, velocity excess, line control
    bool line_scratch = false;        ///< lines are solved
    /// Blocks give radius in columns, in rows, iterations; then come pins: column, row, pins of their round.
    std::vector<glsl::ivec4> nested_table{};
    /// A direction carries it from iteration to iteration, from substep to substep, or to the release of a pin.
    PerDirection<bool> carries_tension{};
    glsl::vec4 release_stiffness{};  ///< k h^2/m_inner by direction, where a release asks for tension; else 0
    /// Steps that do not keep the tension have it computed with these where it is wanted.
    std::optional<glsl::TensionPush> gathered_tension;

    PerDirection<double> used_stiffness;  ///< N/m applied per direction, away from borders; infinite when rigid
    double used_bend = 0;                 ///< N m applied along rows and columns
    double used_twist = 0;                ///< N m applied where the cloth twists
    /// Fewer per frame would drop what no judgement of a run sees: bending, and stiffness that micro-steps soften.
    std::uint32_t following_substeps = 1;
    std::vector<SkippedWork> skipped;
    std::vector<Compromise> compromises;
};

/// The benchmark sweeps over substeps per frame, or per frame and link along the cloth.
struct MethodSweep {
    bool per_link;
    std::span<const double> full, quick;
};

struct Method {
    SolverMethod method;
    MethodScheme (*scheme)(const ClothGeometry& cloth, const MethodSettings& settings);

    /// `auto` needs the law of the stretch error: substeps per frame (a real number) that keep a tolerance.
    double (*substeps)(const Hang& hang, double frame, double tolerance, const DeviceCosts& costs);
    /// A closed loop judges its substeps by probes (probed), or needs none, as substeps that follow everything resolve
    /// whatever moves (resolves); with neither it is not chosen, since it damps what it does not resolve.
    enum class Trust : std::uint8_t { none, probed, resolves } trust;
    std::uint32_t most_substeps;  ///< a closed loop gives up there

    // Benchmarks count passes over all particles that take as long as a substep's prediction, its iteration.
    double passes_per_substep, passes_per_iteration;
    MethodSweep sweep;

    std::string_view name() const { return named(method).name; }
};

/// Returns the methods in the order in which `auto` prefers those that cost the same.
std::span<const Method> methods();
/// Returns the row of a method; `automatic` has none: std::logic_error.
const Method& row_of(SolverMethod method);

/// Returns a number of substeps rounded up, 1e9 at most: more than any run takes, and what an integer holds.
std::uint32_t whole_substeps(double substeps);

/// Returns every number of a scheme, in a fixed order: two plans that do the same have these in common.
std::vector<std::byte> bytes_of(const MethodScheme& scheme);

/// Returns phi = (1 - e^(-c h)) / (c h): the mean of the damping factor over a substep. The factor is 1/128 at least.
double damping_mean(double damping, double substep_length);
glsl::ForcePush force_constants(const ClothGeometry& cloth, const MethodSettings& settings);
/// Returns the displacement before the start, of a particle with this velocity (m/s), that makes damped ballistic
/// flight of that prediction exact.
glsl::vec4 verlet_start(const ClothGeometry& cloth, const MethodSettings& settings, const Vec3& velocity);
/// Sets the displacement before the start to what `displacement` gives for a velocity, m/s.
void set_start(const ClothGeometry& cloth, const std::function<glsl::vec4(const Vec3&)>& displacement,
               MethodScheme& scheme);
void set_verlet_start(const ClothGeometry& cloth, const MethodSettings& settings, MethodScheme& scheme);
/// Notes that the cloth follows less of its `what` ("stiffness") than it was given; `followed` says how much. Without
/// `enough_substeps` no number of substeps would be enough.
void note_compromise(const ClothGeometry& cloth, const MethodSettings& settings, const std::string& what,
                     const std::string& followed, double enough_substeps, MethodScheme& scheme);
/// Stores every direction's tension where a pin is released and springs act after the prediction: there their last pull
/// is asked for.
void carry_tension_to_release(const ClothGeometry& cloth, const MethodSettings& settings, MethodScheme& scheme);
/// Notes why no tension goes from iteration to iteration, if so.
void note_tension(const ClothGeometry& cloth, MethodScheme& scheme);

}  // namespace drape
