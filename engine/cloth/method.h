// The solver methods as values: from a cloth's geometry and the settings of its substeps, each makes the constants, the
// steps and the demands on other code. A method is a row of `methods`; no code tests for its name.
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
#include "cloth/kept_turn.h"
#include "cloth/step.h"

namespace drape {

/// What a method's constants follow from, beside the cloth.
struct MethodSettings {
    std::uint32_t substeps, iterations;  ///< per frame, per substep
    double substep_length;               ///< s
    Vec3 gravity;                        ///< m/s^2, at the start
    double strain_damping;               ///< SolverSettings' value
    bool collides;                       ///< the scene has colliders
    std::optional<KeptTurn> turn{};      ///< what a substep may end by keeping
    bool skip = true;                    ///< false: do work that changes no bit, too
    DeviceKind device = DeviceKind::cpu;
};

/// What a method does with one cloth at one number of substeps.
struct MethodScheme {
    // The steps of a substep that belong to the method. The schedule inserts those that no method changes (release,
    // wind, pin motion, collision, check, tethers).
    std::vector<MethodStep> prediction;  ///< before the motion of pins
    std::vector<MethodStep> once;        ///< after the motion of pins: bending
    std::vector<MethodStep> iterated;    ///< in each iteration
    std::vector<MethodStep> ended;       ///< after the last one, before contact

    glsl::vec4 start{};  ///< displacement of free particles at the start, m: x(0) - x(-h), the half-kick start, or what
                         ///< else the prediction expects
    std::vector<glsl::vec4> starts{};  ///< by particle; empty: all have `start`

    // The fields that the steps need beside position and displacement with their remainders.
    bool spare_state = false;  ///< particles gather the forces of springs: a step reads one state and writes another
    bool spare_displacement = false;  ///< passes over springs or twist may read one displacement and write the other
    bool spare_tension = false;       ///< passes over springs may read the tension and write the other
    bool second_order = false;        ///< displacement before, velocity excess, line control
    bool line_scratch = false;        ///< lines are solved
    /// A block's entry is its radius in columns, in rows, and its iterations; then come pins: column, row, number of
    /// pins in their round.
    std::vector<glsl::ivec4> nested_table{};
    /// Whether a direction keeps its tension from one iteration or substep to the next, or until a pin is released.
    PerDirection<bool> carries_tension{};
    glsl::vec4 release_stiffness{};  ///< k h^2/m_inner by direction, if a release needs the tension; otherwise 0
    /// For steps that do not store the tension: the constants by which it is computed where it is needed.
    std::optional<glsl::TensionPush> gathered_tension;

    PerDirection<double> used_stiffness;  ///< N/m applied by direction, away from borders; infinite when rigid
    double used_bend = 0;   ///< N m: the share of bending applied along rows and columns times the largest rigidity
    double used_twist = 0;  ///< N m: the same where the cloth twists
    /// With fewer substeps per frame, effects would be lost that no judgement of a run notices: bending, and stiffness
    /// that micro-steps soften.
    std::uint32_t following_substeps = 1;
    std::vector<SkippedWork> skipped;
    std::vector<Compromise> compromises;
};

/// The values that the benchmark goes through, as substeps per frame, or per frame and link along the cloth.
struct MethodSweep {
    bool per_link;
    std::span<const double> full, quick;
};

struct Method {
    SolverMethod method;
    MethodScheme (*scheme)(const ClothGeometry& cloth, const MethodSettings& settings);

    /// `auto` needs the law of the stretch error: it gives the substeps per frame (a real number) that keep a
    /// tolerance.
    double (*substeps)(const Hang& hang, double frame, double tolerance, const DeviceCosts& costs);
    /// How a closed loop judges the substeps. probed: by probes. resolves: not at all, since substeps that follow all
    /// stiffness resolve every motion. none: `auto` does not choose this method, since it damps what it does not
    /// resolve.
    enum class Trust : std::uint8_t { none, probed, resolves } trust;
    std::uint32_t most_substeps;  ///< beyond this number a closed loop gives up

    // The number of passes over all particles that cost benchmarks as much time as a substep's prediction, and as an
    // iteration.
    double passes_per_substep, passes_per_iteration;
    MethodSweep sweep;

    std::string_view name() const { return named(method).name; }
};

/// Returns the methods in the order in which `auto` prefers them at equal cost.
std::span<const Method> methods();
/// Returns the row of a method. `automatic` has none: throws std::logic_error.
const Method& row_of(SolverMethod method);

/// Returns a number of substeps rounded up, at most 1e9: no run takes more, and an integer holds it.
std::uint32_t whole_substeps(double substeps);

/// Returns every number of a scheme, in a fixed order: schemes that do the same work have equal bytes.
std::vector<std::byte> bytes_of(const MethodScheme& scheme);

/// Returns phi = (1 - e^(-c h)) / (c h), the mean of the damping factor over a substep. The factor is at least 1/128.
double damping_mean(double damping, double substep_length);
glsl::ForcePush force_constants(const ClothGeometry& cloth, const MethodSettings& settings);
/// Ends substeps by taking back, where the cloth can turn, what the method's pulls make of angular momentum: links go
/// on turning after their pulls were found, so these have a torque, which the cloth's own forces have not.
/// `drag_ratio`: RotationPush's.
void add_rotation(const ClothGeometry& cloth, const MethodSettings& settings, float drag_ratio, MethodScheme& scheme);
/// Returns the displacement before the start of a particle with this velocity (m/s) with which the prediction follows
/// damped ballistic flight exactly.
glsl::vec4 verlet_start(const ClothGeometry& cloth, const MethodSettings& settings, const Vec3& velocity);
/// Sets the displacement before the start to `displacement` of each start velocity, m/s.
void set_start(const ClothGeometry& cloth, const std::function<glsl::vec4(const Vec3&)>& displacement,
               MethodScheme& scheme);
void set_verlet_start(const ClothGeometry& cloth, const MethodSettings& settings, MethodScheme& scheme);
/// Notes that the cloth has less of its `what` ("stiffness") than the scene gave it; `followed` says how much. Without
/// `enough_substeps`, no number of substeps would be enough.
void note_compromise(const ClothGeometry& cloth, const MethodSettings& settings, const std::string& what,
                     const std::string& followed, double enough_substeps, MethodScheme& scheme);
/// Stores every direction's tension where a pin is released and springs act after the prediction: the released particle
/// needs their last pull.
void carry_tension_to_release(const ClothGeometry& cloth, const MethodSettings& settings, MethodScheme& scheme);
/// Notes that no tension is carried from iteration to iteration, if so, and why.
void note_tension(const ClothGeometry& cloth, MethodScheme& scheme);

}  // namespace drape
