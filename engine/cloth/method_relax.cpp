#include "cloth/method_relax.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "cloth/bend_relaxation.h"

namespace drape {

namespace {

void add_springs(const ClothGeometry& cloth, const MethodSettings& settings, MethodScheme& scheme) {
    const double h2 = settings.substep_length * settings.substep_length;
    for (const SpringPass& pass : spring_passes(cloth.grid.size())) {
        const auto index = static_cast<std::size_t>(pass.direction);
        const SpringDirection& direction = spring_directions[index];
        const double constant = cloth.stiffness_constant.spring[index];
        const std::string what =
            fmt::format("{}/spring {} {}", cloth.name, direction.name, pass.parity == 0 ? "even" : "odd");
        if (constant == 0) {
            scheme.skipped.push_back({what, "zero stiffness"});
            continue;
        }
        if (pass.empty()) {
            scheme.skipped.push_back({what, "the grid has no such spring"});
            continue;
        }
        scheme.carries_tension[index] = !cloth.rigid && (settings.iterations > 1 || !settings.skip);
        const float compliance = cloth.rigid ? 0.0f : static_cast<float>(cloth.inner_mass / (constant * h2));
        scheme.iterated.push_back(
            {StepKind::spring,
             glsl::SpringPush{cloth.grid.size(), pass.pair_count, direction.offset, direction.parity_axis, pass.parity,
                              static_cast<float>(cloth.stiffness_constant.rest_length[index]), compliance,
                              pass.direction, 1, cloth.compression, 0}});
    }
    scheme.spare_displacement |= !scheme.iterated.empty();
    if (!cloth.rigid) carry_tension_to_release(cloth, settings, scheme);
    scheme.spare_tension = settings.iterations > 1 && std::ranges::all_of(scheme.carries_tension, std::identity());
    note_tension(cloth, scheme);
}

}  // namespace

MethodScheme relax_scheme(const ClothGeometry& cloth, const MethodSettings& settings) {
    MethodScheme scheme;
    scheme.prediction = {{StepKind::force, force_constants(cloth, settings)}};
    set_verlet_start(cloth, settings, scheme);
    scheme.used_stiffness = cloth.stiffness_constant.spring;
    if (cloth.rigid) scheme.used_stiffness.fill(std::numeric_limits<double>::infinity());
    add_bend_relaxation(cloth, settings, scheme);
    add_springs(cloth, settings, scheme);
    add_rotation(cloth, settings, 1, scheme);
    return scheme;
}

double relax_substeps(const Hang& hang, double frame, double tolerance, const DeviceCosts&) {
    const double law =
        0.83 / std::sqrt(2.0) * (hang.length / hang.spacing) * hang.acceleration * (frame * frame) / (2 * hang.spacing);
    return std::sqrt(motion_factor(hang) * law / tolerance);
}

}  // namespace drape
