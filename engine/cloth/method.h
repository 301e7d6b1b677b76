// The solver methods as values: from a cloth's geometry and the settings of its substeps, each makes the constants, the
// steps and what others ask. A method is a row of `methods`; nobody asks for its name. Pure.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cloth/cloth_geometry.h"
#include "cloth/hang.h"
#include "cloth/step.h"

namespace drape {

/// What a method's constants follow from, beside the cloth.
struct MethodSettings {
    std::uint32_t substeps, iterations;  ///< per frame, per substep
    double substep_length;               ///< s
    Vec3 gravity;                        ///< m/s^2
    double strain_damping;               ///< as SolverSettings
    bool collides;                       ///< the scene has colliders
    bool skip = true;                    ///< false: keep needless work that changes no bit
};

/// What a method does with one cloth at one number of substeps.
struct MethodPlan {
    // Steps of a substep. Those that no method changes (release, wind, pin motion, collision, check, tethers) are put
    // between them by the schedule.
    std::vector<MethodStep> prediction;  ///< before pin motion
    std::vector<MethodStep> once;        ///< after it: bending
    std::vector<MethodStep> iterated;    ///< in each iteration

    glsl::vec4 start{};  ///< displacement of free particles at the start, m: x(0) - x(-h), the half-kick start, or what
                         ///< else the prediction expects

    // Fields that the steps need beside position and displacement with their remainders.
    bool spare_state = false;         ///< particles gather what springs do: a step reads one state, writes another
    bool spare_displacement = false;  ///< sweeps, of springs or of twist, may read one and write the other
    bool spare_tension = false;       ///< sweeps of springs may read the tension and write the other
    bool second_order = false;        ///< displacement before, velocity excess, line control
    bool line_scratch = false;        ///< lines are solved
    /// Blocks: radius in columns, in rows, sweeps; then pins: column, row, pins of their round.
    std::vector<glsl::ivec4> nested_table{};
    /// By direction: from iteration to iteration, from substep to substep, or to the release of a pin.
    PerDirection<bool> carries_tension{};
    glsl::vec4 release_stiffness{};  ///< k h^2/m_inner by direction, where a release asks for tension; else 0
    /// Tension is not kept by the steps: it is computed with these where it is wanted.
    std::optional<glsl::TensionPush> gathered_tension;

    PerDirection<double> used_stiffness;  ///< N/m applied per direction, away from borders; infinite when rigid
    double used_bend = 0;                 ///< N m applied
    /// Per frame, fewer drop what no judgement of a run would see: bending, and stiffness that micro-steps soften.
    std::uint32_t following_substeps = 1;
    std::vector<SkippedWork> skipped;
    std::vector<Compromise> compromises;
};

/// A sweep of the benchmark: substeps per frame, or per frame and link along the cloth.
struct MethodSweep {
    bool per_link;
    std::span<const double> full, quick;
};

struct Method {
    SolverMethod method;
    MethodPlan (*plan)(const ClothGeometry& cloth, const MethodSettings& settings);

    // For `auto`: the law of the stretch error, substeps per frame (a real number) that keep a tolerance; what a
    // substep costs (cloth/solver_choice.cpp).
    double (*substeps)(const Hang& hang, double frame, double tolerance);
    double dispatches, particle_ns;
    bool in_lines;  ///< springs are solved along whole lines
    /// In a closed loop: only its substeps need judging (probed); at the substeps that follow everything it resolves
    /// whatever moves (resolves); neither: it is not chosen, since it damps what it does not resolve.
    enum class Trust : std::uint8_t { none, probed, resolves } trust;
    std::uint32_t most_substeps;  ///< where a closed loop gives up

    // For benchmarks: passes over all particles that take as long as a substep's prediction, its iteration.
    double passes_per_substep, passes_per_iteration;
    MethodSweep sweep;

    std::string_view name() const { return named(method).name; }
};

/// In the order in which `auto` prefers those that cost the same.
std::span<const Method> methods();
/// The row of a method; `automatic` has none: std::logic_error.
const Method& row_of(SolverMethod method);

/// A number of substeps rounded up, 1e9 at most: more than any run takes, and what an integer holds.
std::uint32_t whole_substeps(double substeps);

/// Every number of a plan, in a fixed order: what two plans that do the same have in common.
std::vector<std::byte> bytes_of(const MethodPlan& plan);

/// phi = (1 - e^(-c h)) / (c h): the mean of the damping factor over a substep.
double damping_mean(double damping, double substep_length);
/// Verlet's prediction of the displacement.
glsl::ForcePush force_constants(const ClothGeometry& cloth, const MethodSettings& settings);
/// Displacement of the substep before the start that makes damped ballistic flight of that prediction exact.
glsl::vec4 verlet_start(const ClothGeometry& cloth, const MethodSettings& settings);
/// Notes that the cloth follows less of its `what` ("stiffness") than it was given; `followed`: how much. Without
/// `enough_substeps` no substeps would be.
void note_compromise(const ClothGeometry& cloth, const MethodSettings& settings, const std::string& what,
                     const std::string& followed, double enough_substeps, MethodPlan& plan);
/// Where a pin is released and springs act after the prediction, their last pull is asked for: every direction's
/// tension is stored.
void carry_tension_to_release(const ClothGeometry& cloth, const MethodSettings& settings, MethodPlan& plan);
/// Notes why no tension goes from iteration to iteration, if so.
void note_tension(const ClothGeometry& cloth, MethodPlan& plan);

}  // namespace drape
