#include "cloth/bend_relaxation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace drape {

namespace {

/// One pass over the three colours adds this to the compliance of a smoothly bent cloth: an element is relaxed before
/// its neighbours, whose corrections take 6, 3 and 0 lambda of its own away again; 3 on average. The cantilever
/// measured 2.2 at 16 elements, 2.7 at 32.
constexpr double bend_pass_compliance = 3;
/// One pass over the four colours adds this for a smoothly twisted cloth: later neighbours take 4, 0, 4 and 0 lambda
/// away; 2 on average, half of a cell's own inverse mass as the 3 is half of an element's. A saddle measured 2.2 at
/// m/(t h^2) = 30, 2.4 at 10.
constexpr double twist_pass_compliance = 2;

double wanted_compliance(double constant, const ClothGeometry& cloth, const MethodSettings& settings) {
    return cloth.inner_mass / (constant * settings.substep_length * settings.substep_length);
}

/// Returns the compliance of an element that is softened to `share` of its constant, minus what one pass adds.
float pass_compliance(double wanted, double share, double pass) {
    return static_cast<float>(std::max(wanted / share - pass, 1e-20));
}

void add_twists(const ClothGeometry& cloth, float compliance, float compliance_bdf2, MethodScheme& scheme) {
    for (const TwistPass& pass : twist_passes(cloth.grid.size())) {
        if (pass.empty()) continue;
        scheme.once.push_back({StepKind::twist, glsl::TwistPush{cloth.grid.size(), pass.element_count, pass.first,
                                                                compliance, compliance_bdf2}});
        scheme.spare_displacement = true;
    }
}

/// Adds the steps that bending needs in cloth that rests bent and uses a share of its stiffness.
void add_rest_bend(const ClothGeometry& cloth, const MethodSettings& settings, double share, double bdf2_factor,
                   MethodScheme& scheme) {
    if (!cloth.rests_bent()) return;
    const auto stiffness = [&](double constant) {
        return constant > 0 ? share / wanted_compliance(constant, cloth, settings) : 0;
    };
    const StiffnessConstants& constant = cloth.stiffness_constant;
    const BendStiffness euler{stiffness(constant.bend[0]), stiffness(constant.bend[1]), stiffness(constant.twist)};
    scheme.once.push_back(
        {StepKind::bend_targets, bend_target_constants(cloth, false, euler, euler.times(1 / bdf2_factor))});
    scheme.once.push_back({StepKind::bend_pulls, {}});
}

double substeps_for(double share, const MethodSettings& settings) {
    return std::ceil(settings.substeps / std::sqrt(share));
}

}  // namespace

glsl::BendTargetPush bend_target_constants(const ClothGeometry& cloth, bool gathers, const BendStiffness& euler,
                                           const BendStiffness& bdf2) {
    const auto texel = [](const BendStiffness& of) {
        return glsl::vec4{static_cast<float>(of.row), static_cast<float>(of.column), static_cast<float>(of.twist), 0};
    };
    return {cloth.grid.size(), gathers ? 1 : 0, 0, texel(euler), texel(bdf2)};
}

void add_bend_relaxation(const ClothGeometry& cloth, const MethodSettings& settings, MethodScheme& scheme) {
    scheme.used_bend = scheme.used_twist = cloth.bend;
    if (cloth.bend == 0) return;
    const double twist = wanted_compliance(cloth.stiffness_constant.twist, cloth, settings);
    double share = std::min(1.0, twist / twist_pass_compliance);
    for (const double constant : cloth.stiffness_constant.bend)
        if (constant > 0) share = std::min(share, wanted_compliance(constant, cloth, settings) / bend_pass_compliance);
    add_rest_bend(cloth, settings, share, 1, scheme);
    // All elements are softened by the same share, so that the cloth stays equally stiff in every direction.
    for (const BendPass& pass : bend_passes(cloth.grid.size())) {
        const auto axis = static_cast<std::size_t>(pass.axis);
        const double constant = cloth.stiffness_constant.bend[axis];
        if (constant == 0 || pass.empty()) continue;
        const double wanted = wanted_compliance(constant, cloth, settings);
        scheme.once.push_back(
            {StepKind::bend, glsl::BendPush{cloth.grid.size(), pass.element_count, bend_axes[axis].offset, pass.colour,
                                            pass.axis, pass_compliance(wanted, share, bend_pass_compliance), 0}});
    }
    const float compliance = pass_compliance(twist, share, twist_pass_compliance);
    add_twists(cloth, compliance, compliance, scheme);
    if (share == 1) return;
    scheme.used_bend = scheme.used_twist = share * cloth.bend;
    scheme.following_substeps = whole_substeps(substeps_for(share, settings));
    note_compromise(cloth, settings, "bending",
                    fmt::format("one pass per substep follows {:.3g} of {:.3g} N m", scheme.used_bend, cloth.bend),
                    substeps_for(share, settings), scheme);
}

void add_twist_relaxation(const ClothGeometry& cloth, const MethodSettings& settings, const StepFactors& factors,
                          MethodScheme& scheme) {
    scheme.used_bend = scheme.used_twist = cloth.bend;
    if (cloth.bend == 0) return;
    add_rest_bend(cloth, settings, 1, factors.bdf2, scheme);
    const double twist = wanted_compliance(cloth.stiffness_constant.twist, cloth, settings);
    const auto followed = [&](double factor) { return std::min(1.0, factor * twist / twist_pass_compliance); };
    const auto compliance = [&](double factor) {
        return pass_compliance(factor * twist, followed(factor), twist_pass_compliance);
    };
    add_twists(cloth, compliance(1), compliance(factors.bdf2), scheme);
    const double share = followed(factors.least);
    if (share == 1) return;
    scheme.used_twist = share * cloth.bend;
    scheme.following_substeps = whole_substeps(substeps_for(share, settings));
    note_compromise(cloth, settings, "twist",
                    fmt::format("one pass per substep follows {:.3g} of {:.3g} N m where the cloth twists; "
                                "rows and columns bend in full",
                                share * cloth.bend, cloth.bend),
                    substeps_for(share, settings), scheme);
}

}  // namespace drape
