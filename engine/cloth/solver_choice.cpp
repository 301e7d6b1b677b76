#include "cloth/solver_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "cloth/stiffness_constants.h"

namespace drape {

namespace {

constexpr std::uint32_t most_substeps = 4096;

/// How a cloth hangs: what its stretch error depends on.
struct Hang {
    double length;        ///< m below the pins
    double spacing;       ///< m, of the finer links
    double gravity;       ///< m/s^2
    double acceleration;  ///< m/s^2, the wind's share included
    bool by_an_edge;      ///< a held edge carries it, and nothing stands in its way
    double edge_spacing;  ///< m, of the links that lead away from that edge
    bool calm;            ///< besides, no wind blows
    std::size_t particle_count;
    double longest_line;  ///< particles
};

/// Share of the wind's pressure on a plate that stretches a cloth: it turns with the wind. Measured on the flag scene.
constexpr double wind_share = 0.3;

double square(double x) { return x * x; }

/// Largest straight distance of a particle from the nearest pin, m, on the flat cloth, sampled; half the size without
/// pins.
double hanging_length(const Cloth& cloth) {
    const double dx = cloth.size[0] / (cloth.grid[0] - 1), dy = cloth.size[1] / (cloth.grid[1] - 1);
    if (cloth.pins.empty()) return 0.5 * std::max(cloth.size[0], cloth.size[1]);
    constexpr std::uint32_t samples = 33;
    double longest = 0;
    for (std::uint32_t j = 0; j < samples; ++j)
        for (std::uint32_t i = 0; i < samples; ++i) {
            const double x = i * (cloth.grid[0] - 1.0) / (samples - 1), y = j * (cloth.grid[1] - 1.0) / (samples - 1);
            double nearest = INFINITY;
            for (const Pin& pin : cloth.pins) {
                const auto outside = [](double at, double first, double last) {
                    return std::max({first - at, at - last, 0.0});
                };
                const IndexBox& box = pin.particles;
                nearest = std::min(nearest, std::hypot(dx * outside(x, box.first[0], box.last[0]),
                                                       dy * outside(y, box.first[1], box.last[1])));
            }
            longest = std::max(longest, nearest);
        }
    return longest;
}

/// The axis (0: rows, 1: columns) along which links lead away from a whole edge that is held for good; -1: none is.
int axis_from_held_edge(const Cloth& cloth) {
    for (const Pin& pin : cloth.pins) {
        const IndexBox& box = pin.particles;
        if (!pin.path.keys.empty() || pin.release) continue;
        if (box.first[0] == 0 && box.last[0] + 1 == cloth.grid[0]) return 1;
        if (box.first[1] == 0 && box.last[1] + 1 == cloth.grid[1]) return 0;
    }
    return -1;
}

Hang hang_of(const SceneDescription& scene, const Cloth& cloth) {
    const auto length = [](const Vec3& v) { return std::hypot(v[0], v[1], v[2]); };
    Hang hang{};
    hang.length = hanging_length(cloth);
    hang.spacing = std::min(cloth.size[0] / (cloth.grid[0] - 1), cloth.size[1] / (cloth.grid[1] - 1));
    const double wind_speed = length(scene.wind.velocity) + scene.wind.gust.amplitude;
    const double pressure =
        0.5 * scene.wind.air_density * std::max(scene.wind.drag, scene.wind.lift) * square(wind_speed);
    hang.gravity = length(scene.gravity);
    hang.acceleration = hang.gravity + (scene.wind.blows() ? wind_share * pressure / cloth.areal_density : 0);
    const int axis = axis_from_held_edge(cloth);
    hang.by_an_edge = axis >= 0 && scene.colliders.empty() && scene.cutters.empty();
    hang.edge_spacing = cloth.size[axis == 0 ? 0 : 1] / (cloth.grid[axis == 0 ? 0 : 1] - 1);
    hang.calm = hang.by_an_edge && !scene.wind.blows();
    hang.particle_count = std::size_t{cloth.grid[0]} * cloth.grid[1];
    hang.longest_line = std::max(cloth.grid[0], cloth.grid[1]);
    return hang;
}

/// The worst frame of a moving cloth errs by so much more than a hanging one.
double motion_factor(const Hang& hang) { return hang.calm ? 1.7 : 5; }

/// What a method's law says of one cloth: the substeps per frame, as a real number, that keep the tolerance.
using Law = double (*)(const Hang& hang, double frame, double tolerance);

/// RMS over rows and columns of the relaxation's law: 0.83/sqrt 2 of N^2 g h^2/(2 L) = n g h^2/(2 l) (docs/physics.md
/// 2).
double relax_substeps(const Hang& hang, double frame, double tolerance) {
    const double law =
        0.83 / std::sqrt(2.0) * (hang.length / hang.spacing) * hang.acceleration * square(frame) / (2 * hang.spacing);
    return std::sqrt(motion_factor(hang) * law / tolerance);
}

/// Clamped springs: strain g L/c_s^2 at the top, 1/sqrt 6 of it RMS over rows and columns, c_s^2 = K l^2/h^2 with
/// K = 0.45/((1 + r_s)(1 + 2 kappa)), r_s = 0.1, kappa = 0.2 (docs/solvers.md, "Explicit micro-step").
double explicit_substeps(const Hang& hang, double frame, double tolerance) {
    constexpr double clamp = 0.45 / (1.1 * 1.4);
    const double law = hang.acceleration * hang.length * square(frame / hang.spacing) / (clamp * std::sqrt(6.0));
    return std::sqrt(motion_factor(hang) * law / tolerance);
}

/// h sqrt(g L)/l at which a substep is cheapest, sweeps and the further iterations that the tolerance asks for taken
/// together: 1.3 for a cloth held by an edge, whose lines carry it alone; 0.45 where crossing directions fight (two
/// corners, a ball), less from 64 links on, since iterations carry news by one line only. Measured on ten scenes of
/// `bench accuracy
/// --filter random` (seed 1000); docs/solvers.md has 0.67 for a single sweep to 0.04 %.
double line_substeps(const Hang& hang, double frame, double tolerance) {
    const double share = std::min(1.0, tolerance / default_tolerance);
    if (hang.by_an_edge)
        return frame * std::sqrt(hang.gravity * hang.length) / (1.3 * hang.edge_spacing * std::sqrt(share));
    const double few_links = std::min(1.0, std::sqrt(64 * hang.spacing / hang.length));
    const double limit = 0.45 * few_links * std::sqrt(std::sqrt(share));
    return frame * std::sqrt(hang.gravity * hang.length) / (hang.spacing * limit);
}

/// Milliseconds of one substep of one cloth. CPU: per dispatch and per particle, measured on lavapipe with 2 cores.
/// GPU: dispatches wait for each other, and a line solve walks along its line; estimates, no measurement.
double substep_ms(const Hang& hang, DeviceKind device, double dispatches, double particle_ns, bool walks) {
    const auto count = static_cast<double>(hang.particle_count);
    if (device == DeviceKind::cpu) return dispatches * 0.07 + count * particle_ns * 1e-6;
    constexpr double dispatch_ms = 0.004, pass_particle_ms = 1e-8, walk_ms = 4 * 2 * 3e-4;
    return dispatches * (dispatch_ms + count * pass_particle_ms) + (walks ? hang.longest_line * walk_ms : 0);
}

struct Method {
    SolverMethod method;
    std::string_view name;
    Law law;
    double dispatches, particle_ns;  ///< of a substep
    bool walks;
    std::uint32_t iterations;  ///< at most
};
constexpr Method methods[] = {
    {SolverMethod::line, "line", line_substeps, 10, 200, true, 32},
    {SolverMethod::explicit_steps, "explicit", explicit_substeps, 1, 60, false, 1},
    {SolverMethod::relax, "relax", relax_substeps, 11, 140, false, 8},
};

/// Explicit steps soften bending that they could not follow; the other methods' error law knows no bending.
bool bends_fully(const Cloth& cloth, double substep_length) {
    const double spacing[2] = {cloth.size[0] / (cloth.grid[0] - 1), cloth.size[1] / (cloth.grid[1] - 1)};
    const double mass = cloth.areal_density * spacing[0] * spacing[1];
    return explicit_stiffness(stiffness_constants(cloth.stiffness, spacing), spacing, mass, substep_length, 0)
               .bend_share == 1;
}

SolverCandidate candidate(const Method& method, const SceneDescription& scene, double tolerance, DeviceKind device) {
    const double frame = 1.0 / scene.time.fps;
    double substeps = 1;
    for (const Cloth& cloth : scene.cloths)
        substeps = std::max(substeps, method.law(hang_of(scene, cloth), frame, tolerance));
    SolverCandidate result{method.method,
                           static_cast<std::uint32_t>(std::min<double>(std::ceil(substeps), most_substeps)), 0,
                           substeps <= most_substeps};
    for (const Cloth& cloth : scene.cloths) {
        const Hang hang = hang_of(scene, cloth);
        result.predicted_ms +=
            result.substeps * substep_ms(hang, device, method.dispatches, method.particle_ns, method.walks);
        if (method.method == SolverMethod::explicit_steps && !bends_fully(cloth, frame / result.substeps))
            result.reaches = false;
    }
    return result;
}

std::string reason_for(const std::vector<SolverCandidate>& candidates, double tolerance) {
    const auto text = [](const SolverCandidate& candidate) {
        const auto method = std::ranges::find(methods, candidate.method, &Method::method);
        return candidate.reaches
                   ? fmt::format("{} {} substeps, {:.3g} ms", method->name, candidate.substeps, candidate.predicted_ms)
                   : fmt::format("{} does not", method->name);
    };
    std::vector<std::string> all;
    for (const SolverCandidate& each : candidates) all.push_back(text(each));
    return fmt::format("to keep a stretch error of {:.3g} the laws expect, per frame: {}", tolerance,
                       fmt::join(all, "; "));
}

}  // namespace

SolverChoice choose_solver(const SceneDescription& scene, DeviceKind device) {
    if (scene.solver.method != SolverMethod::automatic) return {scene.solver, {}, "as the scene asks"};
    const double tolerance = scene.solver.tolerance > 0 ? scene.solver.tolerance : default_tolerance;
    std::vector<SolverCandidate> candidates;
    for (const Method& method : methods) candidates.push_back(candidate(method, scene, tolerance, device));
    std::ranges::stable_sort(candidates, [](const SolverCandidate& a, const SolverCandidate& b) {
        return a.reaches != b.reaches ? a.reaches : a.predicted_ms < b.predicted_ms;
    });
    const SolverCandidate& best = candidates.front();
    SolverChoice choice{scene.solver, candidates, reason_for(candidates, tolerance)};
    choice.settings.method = best.method;
    choice.settings.substeps = best.substeps;
    choice.settings.iterations = std::ranges::find(methods, best.method, &Method::method)->iterations;
    choice.settings.tolerance = tolerance;
    return choice;
}

}  // namespace drape
