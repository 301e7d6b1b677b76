#include "cloth/method_explicit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cloth/bend_relaxation.h"
#include "cloth/texels.h"

namespace drape {

namespace {

constexpr double elastic_limit = 0.45, bend_limit = 0.3;

RelativeStiffness stiffness_of(const ClothGeometry& cloth, const MethodSettings& settings) {
    return relative_stiffness(cloth.stiffness_constant, cloth.spacing, cloth.inner_mass, settings.substep_length,
                              settings.strain_damping);
}

/// explicit_increment requires a sum without negative zeros.
glsl::vec4 without_negative_zeros(glsl::vec4 v) { return {v.x + 0.0f, v.y + 0.0f, v.z + 0.0f, v.w + 0.0f}; }

glsl::ExplicitPush step_constants(const ClothGeometry& cloth, const MethodSettings& settings,
                                  const RelativeStiffness& used) {
    const glsl::ForcePush force = force_constants(cloth, settings);
    const double mean = damping_mean(cloth.damping, settings.substep_length);
    PerDirection<double> scaled = used.spring;
    for (double& value : scaled) value *= mean;
    return {cloth.grid.size(),
            force.damping_loss,
            force.force_step,
            without_negative_zeros(force.gravity_step),
            texel(cloth.stiffness_constant.rest_length),
            texel(scaled),
            {static_cast<float>(mean * used.bend[0]), static_cast<float>(mean * used.bend[1])},
            static_cast<float>(settings.strain_damping),
            static_cast<float>(mean * used.twist),
            {cloth.compression, 0, 0, 0}};
}

void note_softening(const ClothGeometry& cloth, const MethodSettings& settings, double full_substeps_factor,
                    MethodScheme& scheme) {
    note_compromise(
        cloth, settings, "stiffness",
        fmt::format("explicit steps follow {:.3g} N/m along columns, {:.3g} along rows, {:.3g} on diagonals and "
                    "{:.3g} N m of bending",
                    scheme.used_stiffness[0], scheme.used_stiffness[1], scheme.used_stiffness[2], scheme.used_bend),
        cloth.rigid ? 0 : std::ceil(full_substeps_factor * settings.substeps), scheme);
}

}  // namespace

MethodScheme explicit_scheme(const ClothGeometry& cloth, const MethodSettings& settings) {
    const RelativeStiffness used = stiffness_of(cloth, settings);
    const StiffnessConstants& wanted = cloth.stiffness_constant;
    MethodScheme scheme;
    const glsl::ExplicitPush step = step_constants(cloth, settings, used);
    if (cloth.rests_bent()) {
        const BendStiffness bend{step.bend.x, step.bend.y, step.twist};
        scheme.prediction = {{StepKind::bend_targets, bend_target_constants(cloth, true, bend, bend)}};
    }
    scheme.prediction.push_back({StepKind::explicit_step, step});
    set_verlet_start(cloth, settings, scheme);
    scheme.spare_state = true;
    scheme.gathered_tension = {cloth.grid.size(),
                               {static_cast<float>(wanted.rest_length[0]), static_cast<float>(wanted.rest_length[1])},
                               {static_cast<float>(used.columns_share), static_cast<float>(used.rows_share)},
                               static_cast<float>(settings.strain_damping),
                               cloth.compression};
    scheme.used_stiffness = {used.columns_share * wanted.spring[0], used.rows_share * wanted.spring[1],
                             used.shear_share * wanted.spring[2], used.shear_share * wanted.spring[3]};
    scheme.used_bend = scheme.used_twist = used.bend_share * cloth.bend;
    scheme.following_substeps = whole_substeps(settings.substeps * used.full_substeps_factor);
    if (wanted.spring[2] == 0) scheme.skipped.push_back({cloth.name + "/shear springs", "zero stiffness"});
    if (used.softened()) note_softening(cloth, settings, used.full_substeps_factor, scheme);
    return scheme;
}

double explicit_substeps(const Hang& hang, double frame, double tolerance, const DeviceCosts&) {
    constexpr double clamp = 0.45 / (1.1 * 1.4);
    const double frame_over_spacing = frame / hang.spacing;
    const double law =
        hang.acceleration * hang.length * (frame_over_spacing * frame_over_spacing) / (clamp * std::sqrt(6.0));
    return std::sqrt(motion_factor(hang) * law / tolerance);
}

RelativeStiffness relative_stiffness(const StiffnessConstants& wanted, const std::array<double, 2>& spacing,
                                     double inner_mass, double substep_length, double strain_damping) {
    const double scale = substep_length * substep_length / inner_mass;
    const double diagonal_squared = spacing[0] * spacing[0] + spacing[1] * spacing[1];
    RelativeStiffness used;
    // The largest eigenvalue of a chain of bending elements is 16 b. The twist of a cell, t c c^T with c = (1, -1, -1,
    // 1), against the quarter of a mass that the cell gives each corner, has 4 t/(1/4) = 16 t. The values add, since
    // the checkerboard is the eigenvector of all three.
    const double bend = 4 * (wanted.bend[0] + wanted.bend[1] + wanted.twist) * scale;
    used.bend_share = std::min(1.0, bend_limit / std::max(bend, bend_limit));
    const double limit = elastic_limit - 0.5 * bend * used.bend_share;
    double worst = std::max(1.0, bend / bend_limit);
    double shares[2];
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const double cosine_squared = spacing[axis] * spacing[axis] / diagonal_squared;
        const double diagonals = wanted.spring[2] + wanted.spring[3];
        const double sum = (wanted.spring[axis] + diagonals * cosine_squared) * scale * (1 + 2 * strain_damping);
        shares[axis] = std::min(1.0, limit / std::max(sum, limit));
        worst = std::max(worst, (sum + 0.5 * bend) / elastic_limit);
    }
    used.columns_share = shares[0];
    used.rows_share = shares[1];
    used.shear_share = std::min(shares[0], shares[1]);
    used.spring = {wanted.spring[0] * scale * used.columns_share, wanted.spring[1] * scale * used.rows_share,
                   wanted.spring[2] * scale * used.shear_share, wanted.spring[3] * scale * used.shear_share};
    used.bend = {wanted.bend[0] * scale * used.bend_share, wanted.bend[1] * scale * used.bend_share};
    used.twist = wanted.twist * scale * used.bend_share;
    used.full_substeps_factor = std::sqrt(worst);
    return used;
}

}  // namespace drape
