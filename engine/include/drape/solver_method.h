// The solver methods have the names that a scene gives them. A method's row in cloth/method.h tells what it does to a
// cloth.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace drape {

enum class SolverMethod { automatic, relax, explicit_steps, line };

struct SolverMethodName {
    SolverMethod method;
    std::string_view name;
    std::string_view help;                ///< text of the schema
    std::string_view ignores_iterations;  ///< the reason; empty: it iterates a substep
    bool damps_strain = false;            ///< obeys `strain_damping`

    constexpr bool iterates() const { return ignores_iterations.empty(); }
};

inline constexpr std::array<SolverMethodName, 4> solver_method_names{{
    {SolverMethod::relax, "relax", "relaxation of springs, direction by direction; stable at any number of substeps.",
     ""},
    {SolverMethod::explicit_steps, "explicit",
     "one explicit micro-step per substep, which sums the springs around each particle; accurate from about 2.6 "
     "substeps per particle along the cloth on, and softens the cloth below (the manifest says by how much).",
     "a micro-step solves nothing", true},
    {SolverMethod::line, "line",
     "whole rows, columns and diagonals of springs solved at a time, of second order in time (of first order in scenes "
     "with colliders); accurate from about 0.1 substeps per particle along the cloth on where it hangs from an edge, "
     "0.15 where it hangs from points.",
     ""},
    {SolverMethod::automatic, "auto",
     "the program chooses method and substeps, judges every frame by tolerance, tolerance_worst and "
     "tolerance_motion, and does those that miss one again with more substeps; the manifest says what each took.",
     "the program chooses"},
}};

constexpr const SolverMethodName& named(SolverMethod method) {
    return *std::ranges::find(solver_method_names, method, &SolverMethodName::method);
}

}  // namespace drape
