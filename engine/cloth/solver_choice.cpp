#include "cloth/solver_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "cloth/companions.h"
#include "cloth/method.h"
#include "cloth/rungs.h"
#include "world/cloth_keys.h"
#include "world/contact_shape.h"
#include "world/weather.h"

namespace drape {

namespace {

/// Returns the milliseconds of one substep of one cloth.
double substep_ms(const Method& method, const SceneDescription& scene, const Cloth& cloth, DeviceKind device) {
    const DeviceCosts& costs = costs_of(device);
    SubstepCost cost = costs.of(method.method);
    if (has_weather(scene)) cost += costs.wind;
    if (const auto count = static_cast<double>(scene.colliders.size()); count > 0)
        cost += {costs.colliders.ms, count * costs.colliders.particle_ns};
    if (meets_edges(cloth, scene.colliders)) cost += costs.collider_edges;
    return cost.ms + static_cast<double>(cloth.grid[0]) * cloth.grid[1] * cost.particle_ns * 1e-6;
}

/// The longest substep of a closed loop, divided by sqrt(size / gravity), the time scale of a sheet that swings down. A
/// sheet of 1 m that was let go level along one edge was 3.5 mm off after 0.5 s, and 13.5 mm with three times this
/// substep. The motion's error is estimated from the error that a tenth of a second adds, but here most of it grew from
/// earlier errors.
constexpr double longest_substep = 0.0088;

/// Returns the longest substep for a cloth that swings under gravity, s.
double swing_substep(const SceneDescription& scene, const Cloth& cloth) {
    const Vec3 strongest = strongest_gravity(scene);
    const double gravity = std::hypot(strongest[0], strongest[1], strongest[2]);
    return longest_substep * std::sqrt(std::max(cloth.size[0], cloth.size[1]) / gravity);  // infinite without gravity
}

/// Removes from a cloth what a key says about single particles or cells of its grid.
void leave_out_particles(ClothKey key, Cloth& cloth) {
    switch (key) {
        case ClothKey::pins:
            return cloth.pins.clear();
        case ClothKey::loads:
            return cloth.loads.clear();
        case ClothKey::holes:
            return cloth.holes.clear();
        case ClothKey::start:
            return cloth.start.clear();
        case ClothKey::rest:  // rest at the start shape, whose places were removed
            cloth.rest = Rest::flat;
            return;
        case ClothKey::panel:
            return cloth.panel.clear();
        case ClothKey::velocities:
            return cloth.velocities.clear();
        case ClothKey::cell_stiffness:
            return cloth.cell_stiffness.clear();
        case ClothKey::cell_density:
            return cloth.cell_density.clear();
        case ClothKey::cell_tear:
            return cloth.cell_tear.clear();
        case ClothKey::particle_friction:
            return cloth.particle_friction.clear();
        case ClothKey::particle_thickness:
            return cloth.particle_thickness.clear();
        case ClothKey::name:
        case ClothKey::grid:
        case ClothKey::size:
        case ClothKey::placement:
        case ClothKey::areal_density:
        case ClothKey::stiffness:
        case ClothKey::stiffness_keys:
        case ClothKey::damping:
        case ClothKey::friction:
        case ClothKey::thickness:
        case ClothKey::contact:
        case ClothKey::self_collision:
        case ClothKey::velocity:
        case ClothKey::tear:
        case ClothKey::appearance:
            return;
    }
}

/// Returns the substeps, at least `substeps`, with which the method follows what it must of the cloth. Compliances fall
/// with the square of the substeps, so a single evaluation is enough.
std::uint32_t following_substeps(const Method& method, const SceneDescription& scene, const Cloth& cloth,
                                 std::uint32_t substeps) {
    Cloth small = cloth;  // the answer does not depend on the cloth's size
    for (std::size_t axis = 0; axis < 2; ++axis) {
        small.grid[axis] = std::min(cloth.grid[axis], 4u);
        small.size[axis] = cloth.size[axis] * (small.grid[axis] - 1) / (cloth.grid[axis] - 1);
    }
    for (const ClothKey key : cloth_keys) leave_out_particles(key, small);
    const MethodSettings settings{substeps,
                                  1,
                                  1 / (scene.time.fps * substeps),
                                  gravity_at(scene, 0),
                                  scene.solver.strain_damping,
                                  !scene.colliders.empty()};
    return std::max(substeps, method.scheme(ClothGeometry(scene, small, false), settings).following_substeps);
}

SolverCandidate candidate(const Method& method, const SceneDescription& scene, double tolerance, DeviceKind device) {
    const double frame = 1.0 / scene.time.fps;
    double substeps = 1;
    for (const Cloth& cloth : scene.cloths)
        substeps = std::max(substeps, method.substeps(hang_of(scene, cloth), frame, tolerance, costs_of(device)));
    double swings = 1;
    for (const Cloth& cloth : scene.cloths) swings = std::max(swings, std::ceil(frame / swing_substep(scene, cloth)));
    const auto following = [&](double substeps_before) {
        auto least = static_cast<std::uint32_t>(std::min<double>(substeps_before, method.most_substeps));
        for (const Cloth& cloth : scene.cloths) least = following_substeps(method, scene, cloth, least);
        return least;
    };
    const std::uint32_t calm = following(swings);
    SolverCandidate result{
        method.method,
        static_cast<std::uint32_t>(std::min<double>(std::ceil(substeps), method.most_substeps)),
        std::min(following(1), method.most_substeps),
        std::min(calm, method.most_substeps),
        0,
        method.trust != Method::Trust::none && std::max<double>(substeps, calm) <= method.most_substeps};
    result.substeps = std::clamp(result.substeps, result.calm_substeps, method.most_substeps);
    const bool has_companions = scene.solver.estimate_error.value_or(true);
    const std::uint32_t beside = has_companions ? companion_substeps(method, result.substeps) : 0;
    for (const Cloth& cloth : scene.cloths)
        result.predicted_ms += (result.substeps + beside) * substep_ms(method, scene, cloth, device);
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
    if (scene.solver.method != SolverMethod::automatic) return {scene.solver, {}, "as the scene asks", 1, 1};
    const double tolerance = scene.solver.tolerance > 0 ? scene.solver.tolerance : default_tolerance;
    std::vector<SolverCandidate> candidates;
    for (const Method& method : methods()) candidates.push_back(candidate(method, scene, tolerance, device));
    std::ranges::stable_sort(candidates, [](const SolverCandidate& a, const SolverCandidate& b) {
        return a.reaches != b.reaches ? a.reaches : a.predicted_ms < b.predicted_ms;
    });
    const SolverCandidate& best = candidates.front();
    SolverChoice choice{scene.solver, candidates, reason_for(candidates, tolerance), 1, 1};
    choice.settings.method = best.method;
    choice.settings.iterations = 1;
    choice.settings.tolerance = tolerance;
    choice.settings.substeps = first_rung(row_of(best.method), best.substeps);
    choice.least_substeps = best.least_substeps;
    choice.calm_substeps = best.calm_substeps;
    return choice;
}

}  // namespace drape
