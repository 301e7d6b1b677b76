#include "cloth/method_relax.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "cloth/bend_sweep.h"

namespace drape {

namespace {

void add_springs(const ClothGeometry& cloth, const MethodSettings& settings, MethodPlan& plan) {
    const double h2 = settings.substep_length * settings.substep_length;
    for (const SpringPass& pass : spring_passes(cloth.grid.size())) {
        const auto index = static_cast<std::size_t>(pass.direction);
        const SpringDirection& direction = spring_directions[index];
        const double constant = cloth.stiffness_constant.spring[index];
        const std::string what =
            fmt::format("{}/spring {} {}", cloth.name, direction.name, pass.parity == 0 ? "even" : "odd");
        if (constant == 0) {
            plan.skipped.push_back({what, "zero stiffness"});
            continue;
        }
        if (pass.empty()) {
            plan.skipped.push_back({what, "the grid has no such spring"});
            continue;
        }
        plan.carries_tension[index] = !cloth.rigid && (settings.iterations > 1 || !settings.skip);
        const float compliance = cloth.rigid ? 0.0f : static_cast<float>(cloth.inner_mass / (constant * h2));
        plan.iterated.push_back(
            {StepKind::spring,
             glsl::SpringPush{cloth.grid.size(), pass.pair_count, direction.offset, direction.parity_axis, pass.parity,
                              static_cast<float>(cloth.stiffness_constant.rest_length[index]), compliance,
                              pass.direction, 1, cloth.compression, 0}});
    }
    plan.spare_displacement |= !plan.iterated.empty();
    if (!cloth.rigid) carry_tension_to_release(cloth, settings, plan);
    plan.spare_tension = settings.iterations > 1 && std::ranges::all_of(plan.carries_tension, std::identity());
    note_tension(cloth, plan);
}

}  // namespace

MethodPlan plan_relax(const ClothGeometry& cloth, const MethodSettings& settings) {
    MethodPlan plan;
    plan.prediction = {{StepKind::force, force_constants(cloth, settings)}};
    plan.start = verlet_start(cloth, settings);
    plan.used_stiffness = cloth.stiffness_constant.spring;
    if (cloth.rigid) plan.used_stiffness.fill(std::numeric_limits<double>::infinity());
    add_bend_sweep(cloth, settings, plan);
    add_springs(cloth, settings, plan);
    return plan;
}

double relax_substeps(const Hang& hang, double frame, double tolerance) {
    const double law =
        0.83 / std::sqrt(2.0) * (hang.length / hang.spacing) * hang.acceleration * (frame * frame) / (2 * hang.spacing);
    return std::sqrt(motion_factor(hang) * law / tolerance);
}

}  // namespace drape
