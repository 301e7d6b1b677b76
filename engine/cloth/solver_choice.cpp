#include "cloth/solver_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cloth/method.h"
#include "cloth/substep_control.h"
#include "scene/contact_shape.h"
#include "shared/cyclic_types.h"

namespace drape {

namespace {

struct SubstepWork {
    double dispatches, particle_ns;
};

/// Returns the method's work, and what wind and contact add to any. Nanoseconds are those of lavapipe on one core.
SubstepWork substep_work(const Method& method, const SceneDescription& scene, const Cloth& cloth) {
    constexpr double wind_ns = 64, collider_ns = 27, box_edges_ns = 48;
    SubstepWork work{method.dispatches, method.particle_ns};
    if (scene.wind.blows()) work = {work.dispatches + 1, work.particle_ns + wind_ns};
    if (const auto count = static_cast<double>(scene.colliders.size()); count > 0)
        work = {work.dispatches + 1, work.particle_ns + count * collider_ns};
    if (meets_box_edges(cloth, scene.colliders)) work = {work.dispatches + 2, work.particle_ns + box_edges_ns};
    return work;
}

/// Returns the milliseconds of one substep of a cloth on a GPU solved along its lines: by cyclic reduction where a
/// workgroup holds them, else walked. These are estimates, no measurement: 0.2 us a round of a reduction, 0.3 us a
/// particle of a walk, two systems in each of four directions, 3 us a direction of a box of nested boxes.
double lines_ms(const Hang& hang) {
    constexpr double systems = 4 * 2, round_ms = 2e-4, walk_ms = 3e-4, nested_ms = 4e-3;
    const bool reduced = hang.longest_line <= glsl::cyclic_most_particles;
    const double solves = systems * (reduced ? std::log2(hang.longest_line) * round_ms : hang.longest_line * walk_ms);
    return solves + (hang.by_lone_pins ? hang.longest_line * nested_ms : 0);
}

/// Returns the milliseconds of one substep of one cloth. On a CPU they go by dispatch and by particle, measured on
/// lavapipe with 2 cores. On a GPU dispatches wait for each other: estimates, no measurement.
double substep_ms(const Hang& hang, DeviceKind device, const SubstepWork& work, bool in_lines) {
    const auto count = static_cast<double>(hang.particle_count);
    if (device == DeviceKind::cpu) return work.dispatches * 0.07 + count * work.particle_ns * 1e-6;
    constexpr double dispatch_ms = 0.004, pass_particle_ms = 1e-8;
    return work.dispatches * (dispatch_ms + count * pass_particle_ms) + (in_lines ? lines_ms(hang) : 0);
}

/// No substep of a closed loop is longer, over the time sqrt(size / gravity) of a sheet that swings down. A sheet of 1
/// m let go level along one edge measured 3.5 mm off after 0.5 s, 13.5 mm with three times that. The motion's error is
/// estimated from what a tenth of a second adds to it, and here most of it is what earlier errors grew to.
constexpr double longest_substep = 0.0088;

/// Returns the longest substep of a cloth that gravity swings, s.
double swing_substep(const SceneDescription& scene, const Cloth& cloth) {
    const double gravity = std::hypot(scene.gravity[0], scene.gravity[1], scene.gravity[2]);
    return longest_substep * std::sqrt(std::max(cloth.size[0], cloth.size[1]) / gravity);  // infinite without gravity
}

/// Returns the substeps that follow what the method must follow of the cloth, at least `substeps`. Compliances fall
/// with the square of the substeps, so one look tells.
std::uint32_t following_substeps(const Method& method, const SceneDescription& scene, const Cloth& cloth,
                                 std::uint32_t substeps) {
    Cloth small = cloth;  // the answer does not depend on the cloth's size
    for (std::size_t axis = 0; axis < 2; ++axis) {
        small.grid[axis] = std::min(cloth.grid[axis], 4u);
        small.size[axis] = cloth.size[axis] * (small.grid[axis] - 1) / (cloth.grid[axis] - 1);
    }
    small.pins.clear();
    small.holes.clear();
    const MethodSettings settings{substeps,
                                  1,
                                  1 / (scene.time.fps * substeps),
                                  scene.gravity,
                                  scene.solver.strain_damping,
                                  !scene.colliders.empty()};
    return std::max(substeps, method.scheme(ClothGeometry(scene, small, false), settings).following_substeps);
}

SolverCandidate candidate(const Method& method, const SceneDescription& scene, double tolerance, DeviceKind device) {
    const double frame = 1.0 / scene.time.fps;
    double substeps = 1;
    for (const Cloth& cloth : scene.cloths)
        substeps = std::max(substeps, method.substeps(hang_of(scene, cloth), frame, tolerance));
    double swings = 1;
    for (const Cloth& cloth : scene.cloths) swings = std::max(swings, std::ceil(frame / swing_substep(scene, cloth)));
    auto least = static_cast<std::uint32_t>(std::min<double>(swings, method.most_substeps));
    for (const Cloth& cloth : scene.cloths) least = following_substeps(method, scene, cloth, least);
    SolverCandidate result{
        method.method, static_cast<std::uint32_t>(std::min<double>(std::ceil(substeps), method.most_substeps)), least,
        0, method.trust != Method::Trust::none && std::max<double>(substeps, least) <= method.most_substeps};
    result.least_substeps = std::min(least, method.most_substeps);
    result.substeps = std::clamp(result.substeps, result.least_substeps, method.most_substeps);
    for (const Cloth& cloth : scene.cloths)
        result.predicted_ms += result.substeps * substep_ms(hang_of(scene, cloth), device,
                                                            substep_work(method, scene, cloth), method.in_lines);
    return result;
}

std::string reason_for(const std::vector<SolverCandidate>& candidates, double tolerance) {
    const auto text = [](const SolverCandidate& candidate) {
        const std::string_view name = named(candidate.method).name;
        return candidate.reaches
                   ? fmt::format("{} {} substeps, {:.3g} ms", name, candidate.substeps, candidate.predicted_ms)
                   : fmt::format("{} does not", name);
    };
    std::vector<std::string> all;
    for (const SolverCandidate& each : candidates) all.push_back(text(each));
    return fmt::format("to keep a stretch error of {:.3g} the laws expect, per frame: {}", tolerance,
                       fmt::join(all, "; "));
}

}  // namespace

SolverChoice choose_solver(const SceneDescription& scene, DeviceKind device) {
    if (scene.solver.method != SolverMethod::automatic) return {scene.solver, {}, "as the scene asks", 1};
    const double tolerance = scene.solver.tolerance > 0 ? scene.solver.tolerance : default_tolerance;
    std::vector<SolverCandidate> candidates;
    for (const Method& method : methods()) candidates.push_back(candidate(method, scene, tolerance, device));
    std::ranges::stable_sort(candidates, [](const SolverCandidate& a, const SolverCandidate& b) {
        return a.reaches != b.reaches ? a.reaches : a.predicted_ms < b.predicted_ms;
    });
    const SolverCandidate& best = candidates.front();
    SolverChoice choice{scene.solver, candidates, reason_for(candidates, tolerance), 1};
    choice.settings.method = best.method;
    choice.settings.iterations = 1;
    choice.settings.tolerance = tolerance;
    choice.settings.substeps = first_rung(row_of(best.method), best.substeps);
    choice.least_substeps = best.least_substeps;
    return choice;
}

}  // namespace drape
