#include "cloth/method_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cloth/bend_relaxation.h"
#include "cloth/cloth_state.h"
#include "cloth/nested_boxes.h"
#include "cloth/solver_choice.h"
#include "cloth/texels.h"

namespace drape {

namespace {

/// The dimensionless constants of a BDF2 step under damping (shaders/include/bdf2.h).
struct Bdf2Step {
    double weight;  ///< f = 1/(1 + (2/3) c h), applies to the history's differences
    double loss;    ///< applies to the displacement
    double forced;  ///< applies to h^2 times the acceleration
};

/// In damped flight the differences of d fall by E = e^(-c h) from substep to substep, and d itself approaches h a/c.
/// With K = f (2/9) (1 - 1/(2 E)) + f (4/9), which the history gives, a step is exact for this flight when loss = (1 -
/// E) (1 - K/E) and forced = loss/(c h); to second order these are (2/3) (1 - f) and (4/9) f. Where damping takes more
/// than most of the velocity in a substep, the exact constants amplify all other motion by 1/E, so the second-order
/// ones are used there.
Bdf2Step bdf2_step(const ClothGeometry& cloth, const MethodSettings& settings) {
    const double ch = cloth.damping * settings.substep_length, f = 1 / (1 + 2.0 / 3 * ch);
    if (ch < 1e-6 || ch > 1) return {f, 2.0 / 3 * (1 - f), 4.0 / 9 * f};
    const double E = std::exp(-ch), K = f * (2.0 / 9 * (1 - 1 / (2 * E)) + 4.0 / 9);
    const double loss = -std::expm1(-ch) * (1 - K / E);
    return {f, loss, loss / ch};
}

/// Returns the compliance m/(k h^2) of a spring in a BDF2 step divided by that in backward Euler: (9/4) (1 + (2/3) c
/// h).
double bdf2_factor(const ClothGeometry& cloth, const MethodSettings& settings) {
    return 1 / bdf2_step(cloth, settings).forced;
}

/// Returns this factor for the stiffest steps of the run that are frequent: with contact these are backward Euler.
double least_factor(const ClothGeometry& cloth, const MethodSettings& settings) {
    return settings.collides ? 1.0 : bdf2_factor(cloth, settings);
}

/// Returns the constant (N/m) of the bending elements along lines of a direction; 0 on diagonals.
double line_bend(std::size_t direction, const ClothGeometry& cloth) {
    return direction < bend_axes.size() ? cloth.stiffness_constant.bend[direction] : 0;
}

double euler_compliance(double constant, const ClothGeometry& cloth, const MethodSettings& settings) {
    return cloth.inner_mass / (constant * settings.substep_length * settings.substep_length);
}

/// The compliance of missing springs in lines that only bend: they pull on nothing.
constexpr double slack_compliance = 1e20;

glsl::LinePush line_constants(std::size_t direction, const ClothGeometry& cloth, const MethodSettings& settings) {
    const glsl::ivec2 grid = cloth.grid.size(), step = spring_directions[direction].offset;
    const bool is_row = step.y == 0;
    const double constant = cloth.stiffness_constant.spring[direction];
    const double euler = constant > 0 ? euler_compliance(constant, cloth, settings) : slack_compliance;
    const double factor = bdf2_factor(cloth, settings), own = factor * euler;
    const auto limited = [](double compliance) { return std::max(compliance, least_line_compliance); };
    const auto followed = [&](double compliance) { return static_cast<float>(compliance / limited(compliance)); };
    const int seam = is_row || step.x == 0 ? -1 : step.x > 0 ? grid.x - 1 : 0;
    const double bend = line_bend(direction, cloth);
    const double relative_bend = bend > 0 ? 1 / euler_compliance(bend, cloth, settings) : 0;
    return {grid,
            step,
            is_row ? grid.y : grid.x,
            is_row ? grid.x : grid.y,
            seam,
            static_cast<int>(direction),
            static_cast<float>(cloth.stiffness_constant.rest_length[direction]),
            static_cast<float>(limited(euler)),
            static_cast<float>(limited(own)),
            followed(euler),
            followed(own),
            static_cast<float>(relative_bend),
            static_cast<float>(relative_bend / factor),
            cloth.compression};
}

/// Returns the stiffness (N/m) that a line's spring can have with the least compliance.
double line_stiffness(double stiffness, const ClothGeometry& cloth, const MethodSettings& settings) {
    if (stiffness == 0) return 0;
    const double wanted = least_factor(cloth, settings) * euler_compliance(stiffness, cloth, settings);
    return wanted < least_line_compliance ? stiffness * wanted / least_line_compliance : stiffness;
}

/// Returns the substeps per frame with which the stiffest springs have at least the least compliance.
double enough_substeps(const ClothGeometry& cloth, const MethodSettings& settings) {
    const double undamped = settings.collides ? 1.0 : 2.25;  // the factor on the compliance as substeps become short
    const double least = std::ranges::max(cloth.stiffness_constant.spring) * least_line_compliance;
    return std::ceil(settings.substeps * settings.substep_length / std::sqrt(undamped * cloth.inner_mass / least));
}

/// Up to this share of a cloth's lines may be wrong (line_violation_limit) before the next substep is backward Euler.
/// Lines around a lone pin of a fine grid are wrong in most substeps; if a single line were enough, sheets held at two
/// corners would lose two thirds of their accuracy (docs/solvers.md, "BDF2 or backward Euler").
constexpr double most_wrong_share = 1.0 / 16;

std::uint32_t most_wrong_lines(const ClothGeometry& cloth) {
    double lines = 0;
    for (std::size_t direction = 0; direction < spring_directions.size(); ++direction)
        if (cloth.stiffness_constant.spring[direction] > 0)
            lines += spring_directions[direction].offset.y == 0 ? cloth.grid.rows() : cloth.grid.columns();
    return static_cast<std::uint32_t>(most_wrong_share * lines);
}

glsl::PredictPush predict_constants(const ClothGeometry& cloth, const MethodSettings& settings) {
    const glsl::ForcePush euler = force_constants(cloth, settings);
    const auto [f, loss, forced] = bdf2_step(cloth, settings);
    const double h = settings.substep_length, step = forced * h * h;
    const auto rounded = [](double value) { return static_cast<float>(value); };
    const Vec3& gravity = settings.gravity;
    return {cloth.grid.size(),
            {euler.damping_loss, rounded(loss)},
            {euler.force_step, rounded(step / cloth.inner_mass)},
            {rounded(f * 2 / 9), rounded(f * 8 / 9)},
            euler.gravity_step,
            {rounded(step * gravity[0]), rounded(step * gravity[1]), rounded(step * gravity[2]), 0},
            most_wrong_lines(cloth),
            -1,
            0,
            0};
}

void add_prediction(const ClothGeometry& cloth, const MethodSettings& settings, MethodScheme& scheme) {
    scheme.second_order = true;
    const double h = settings.substep_length;
    // Under strong damping the exact displacement before the start is many times v h, which BDF2 would read in its
    // history.
    if (cloth.damping * h > 1)
        set_start(
            cloth,
            [h](const Vec3& v) {
                return texel(Vec3{v[0] * h, v[1] * h, v[2] * h}, 0);
            },
            scheme);
    else
        set_verlet_start(cloth, settings, scheme);
    scheme.prediction = {{StepKind::predict, predict_constants(cloth, settings)}};
}

void add_lines(const ClothGeometry& cloth, const MethodSettings& settings, MethodScheme& scheme) {
    // Diagonals come first, because they disturb rows and columns, which carry the load and are solved last.
    for (const SpringFamily family : {SpringFamily::shear, SpringFamily::stretch})
        for (std::size_t direction = 0; direction < spring_directions.size(); ++direction) {
            const bool pulls = cloth.stiffness_constant.spring[direction] > 0, bends = line_bend(direction, cloth) > 0;
            if (spring_directions[direction].family != family || (!pulls && !bends)) continue;
            const glsl::LinePush push = line_constants(direction, cloth, settings);
            scheme.iterated.push_back({StepKind::line, push});
            scheme.carries_tension[direction] = scheme.line_scratch = true;
        }
    carry_tension_to_release(cloth, settings, scheme);
}

}  // namespace

MethodScheme line_scheme(const ClothGeometry& cloth, const MethodSettings& settings) {
    MethodScheme scheme;
    add_prediction(cloth, settings, scheme);
    add_twist_relaxation(cloth, settings, {bdf2_factor(cloth, settings), least_factor(cloth, settings)}, scheme);
    add_lines(cloth, settings, scheme);
    add_nested_boxes(cloth, settings, scheme);
    const glsl::vec2 force_step = predict_constants(cloth, settings).force_step;
    add_rotation(cloth, settings, force_step.x / force_step.y, scheme);
    const PerDirection<double>& wanted = cloth.stiffness_constant.spring;
    if (wanted[2] == 0) scheme.skipped.push_back({cloth.name + "/shear springs", "zero stiffness"});
    for (std::size_t direction = 0; direction < wanted.size(); ++direction)
        scheme.used_stiffness[direction] = line_stiffness(wanted[direction], cloth, settings);
    if (scheme.used_stiffness != wanted)
        note_compromise(
            cloth, settings, "stiffness",
            fmt::format("line solves follow {:.3g} N/m along columns, {:.3g} along rows and {:.3g} on diagonals",
                        scheme.used_stiffness[0], scheme.used_stiffness[1], scheme.used_stiffness[2]),
            cloth.rigid ? 0 : enough_substeps(cloth, settings), scheme);
    return scheme;
}

double line_substeps(const Hang& hang, double frame, double tolerance, const DeviceCosts& costs) {
    const double root = std::sqrt(std::min(1.0, tolerance / default_tolerance));
    // A tenth of the wind counts, since implicit tension carries most of the load that wind adds.
    const double pull = hang.gravity + 0.1 * (hang.acceleration - hang.gravity);
    const double waves = frame * std::sqrt(pull * hang.length);  // m times a frame's substeps
    // A metre of cloth needs four substeps at 60 Hz: it is then 5e-4 m off after it has swung for half a second.
    const double resolving = frame * std::sqrt(pull / hang.length) / 0.013;
    if (hang.by_an_edge) return std::max(resolving, waves / (3.3 * root * hang.edge_spacing));
    const double finer = std::max(1.0, hang.length / (64 * hang.spacing));
    const double waves_per_link = !hang.by_lone_pins   ? 0.35 / std::pow(finer, 0.25)
                                  : costs.nested_boxes ? 0.75 * std::cbrt(finer)
                                                       : std::min(0.35 * std::cbrt(finer), 1.1 / std::sqrt(finer));
    return std::max(resolving, waves / (waves_per_link * root * hang.spacing));
}

}  // namespace drape
