#include "cloth/line_constants.h"

#include <algorithm>

namespace drape {

namespace {

/// f = 1/(1 + (2/3) c h): what damping leaves of a BDF2 step's velocity.
double bdf2_damping(const LineSettings& settings) {
    return 1 / (1 + 2.0 / 3 * settings.damping * settings.substep_length);
}

double euler_compliance(double constant, const LineSettings& settings) {
    return settings.inner_mass / (constant * settings.substep_length * settings.substep_length);
}

LineWork line_work(int direction, const StiffnessConstants& stiffness, const LineSettings& settings) {
    const auto index = static_cast<std::size_t>(direction);
    const glsl::ivec2 grid = settings.grid, step = spring_directions[index].offset;
    const double constant = stiffness.spring[index];
    const bool is_row = step.y == 0;
    const double euler = euler_compliance(constant, settings), bdf2 = method_compliance(constant, settings);
    const auto limited = [](double compliance) { return std::max(compliance, least_line_compliance); };
    const auto followed = [&](double compliance) { return static_cast<float>(compliance / limited(compliance)); };
    const int seam = is_row || step.x == 0 ? -1 : step.x > 0 ? grid.x - 1 : 0;
    return {direction,
            !settings.rigid,
            {grid, step, is_row ? grid.y : grid.x, is_row ? grid.x : grid.y, seam, direction,
             static_cast<float>(stiffness.rest_length[index]), static_cast<float>(limited(euler)),
             static_cast<float>(limited(bdf2)), followed(euler), followed(bdf2), 1, 0}};
}

}  // namespace

double method_compliance(double constant, const LineSettings& settings) {
    const double factor = settings.second_order ? 2.25 / bdf2_damping(settings) : 1.0;
    return factor * euler_compliance(constant, settings);
}

double line_stiffness(double stiffness, const LineSettings& settings) {
    if (stiffness == 0) return 0;
    const double wanted = method_compliance(stiffness, settings);
    return stiffness * wanted / std::max(wanted, least_line_compliance);
}

std::vector<LineWork> line_passes(const StiffnessConstants& stiffness, const LineSettings& settings) {
    // Diagonals first: they disturb rows and columns, which carry the load and have the last word.
    constexpr int order[] = {2, 3, 0, 1};
    std::vector<LineWork> lines;
    for (const int direction : order)
        if (stiffness.spring[static_cast<std::size_t>(direction)] != 0)
            lines.push_back(line_work(direction, stiffness, settings));
    return lines;
}

glsl::PredictPush predict_constants(const glsl::ForcePush& euler, const LineSettings& settings, const Vec3& gravity) {
    const double f = bdf2_damping(settings), h = settings.substep_length, step = f * 4 / 9 * h * h;
    const auto rounded = [](double value) { return static_cast<float>(value); };
    return {settings.grid,
            {euler.damping_loss, rounded(2.0 / 3 * (1 - f))},
            {euler.force_step, rounded(step / settings.inner_mass)},
            {rounded(f * 2 / 9), rounded(f * 8 / 9)},
            euler.gravity_step,
            {rounded(step * gravity[0]), rounded(step * gravity[1]), rounded(step * gravity[2]), 0}};
}

}  // namespace drape
