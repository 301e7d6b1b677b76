// Rules of cloth that tears.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scene/scene_rules.h"

namespace drape {

namespace {

float factor_of(const std::vector<float>& factors, std::size_t cell) { return factors.empty() ? 1 : factors[cell]; }

/// Returns the least strain, m/m, at which a spring of the cloth ends where the diagonals bear nothing.
double least_tear_strain(const Cloth& cloth) {
    const std::size_t cells = std::size_t{cloth.grid[0] - 1} * (cloth.grid[1] - 1);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const double factor = factor_of(cloth.cell_tear, cell);
        const double stretch =
            cloth.stiffness.stretch.largest() * static_cast<double>(factor_of(cloth.cell_stiffness, cell));
        least = std::min(least, factor * (cloth.tear->strain ? *cloth.tear->strain : *cloth.tear->tension / stretch));
        if (cloth.cell_tear.empty() && cloth.cell_stiffness.empty()) break;  // all cells are alike
    }
    return least;
}

}  // namespace

bool check_tear(const Members& members, Tear&) {
    const bool strain = bool(members["strain"]), tension = bool(members["tension"]);
    if (strain != tension) return true;
    return members.object().fail(
        fmt::format("expected exactly one of strain and tension, got {}", strain ? "both" : "none"));
}

bool check_stiffness_keys(const Members& members, const Cloth& cloth) {
    if (cloth.stiffness_keys.empty()) return true;
    if (cloth.stiffness.rigid)
        return members["stiffness_keys"].fail("expected springs whose stiffness can change, got stiffness \"rigid\"");
    if (!cloth.tear || !cloth.tear->tension) return true;
    return members["tear"].fail(
        "expected a strain beside stiffness_keys, got a tension: it is known only where the stiffness stays");
}

bool check_torn_cloth(const Members& members, const Cloth& cloth) {
    if (!cloth.tear || (!cloth.stiffness.rigid && cloth.stiffness.stretch.least() > 0)) return true;
    return members["tear"].fail(
        cloth.stiffness.rigid
            ? "expected springs that stretch, got stiffness \"rigid\": what rigid ones stretch is the solver's error"
            : "expected springs along rows and columns, got stiffness.stretch 0: there is nothing to tear");
}

void check_tear_limits(const SceneNode& cloths, const SceneDescription& scene) {
    const SolverSettings& solver = scene.solver;
    const bool is_automatic = solver.method == SolverMethod::automatic;
    const auto or_default = [&](double given, double usual) { return given > 0 ? given : is_automatic ? usual : 0; };
    const double mean = or_default(solver.tolerance, default_tolerance);
    const double worst = is_automatic ? or_default(solver.tolerance_worst, default_tolerance_worst) : 0;
    for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
        if (!scene.cloths[i].tear) continue;
        const double strain = least_tear_strain(scene.cloths[i]);
        const SceneNode node = cloths.element(i).member("tear");
        if (strain <= mean)
            node.fail(
                fmt::format("expected a limit above the stretch error that the solver may make, {:.3g} "
                            "(solver.tolerance): the cloth tears at a strain of {:.3g}",
                            mean, strain));
        else if (strain < worst)
            node.warn(
                fmt::format("the cloth tears at a strain of {:.3g}, and method auto lets single springs err by "
                            "{:.3g}: with solver.tolerance_worst below the limit none tears by error",
                            strain, worst));
    }
}

}  // namespace drape
