// Reference (b) solves statics by Newton's method with a sparse Cholesky factorisation, and checks reference (a), with
// which it shares nothing but the model.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "reference/reference_run.h"
#include "reference/spring_network.h"

namespace drape {

struct StaticOptions {
    /// The solve is done when a full step moves no particle by more than this (m). At a minimum such steps converge
    /// quadratically, so the remaining error is far smaller.
    double position_tolerance = 1e-10;
    std::uint32_t iteration_limit = 2000;
    /// true: solves first with springs so soft that they stretch by about a tenth, then ten times stiffer up to their
    /// true stiffness, which takes ten times fewer steps for stiff cloth far from its equilibrium. false: stays nearer
    /// to the start where there are several minima.
    bool soften_first = true;
    double time = 0;  ///< s, time of the pins; steady wind is not part of the energy and is left out
};

struct StaticResult {
    std::vector<Vec3> position;  ///< m
    bool converged = false;      ///< the last full step was within the tolerance
    /// The exact Hessian at `position` is positive definite. A flat hanging sheet without bending can be in equilibrium
    /// but not at a minimum: the compression beside its pins would rather make wrinkles, which a flat start never does.
    bool minimum = false;
    double last_step = 0;          ///< m, largest movement of a particle by the last step, which estimates the error
    double residual = 0;           ///< N, largest force left on a free particle
    double energy = 0;             ///< J
    std::uint32_t iterations = 0;  ///< sum over all stages
};

/// Finds a minimum of the potential energy (gravity, springs, bending) near `start`, held particles where `time` puts
/// them, by Newton with the exact Hessian where it is positive definite, else shifted by a multiple of the mass (also
/// when the line search cuts steps short), else with compression clamped.
StaticResult find_equilibrium(const SpringNetwork& network, std::span<const Vec3> start,
                              const StaticOptions& options = {});
/// Starts from the network's start.
StaticResult find_equilibrium(const SpringNetwork& network, const StaticOptions& options = {});

struct ImplicitOptions {
    double step = 1e-3;                 ///< s, of the finest run
    double position_tolerance = 1e-12;  ///< m, largest correction of a particle by a step's last iteration
    ReferenceProgress progress{};
};

/// States at `times` by the implicit midpoint rule, second order and without numerical damping; integrated three times
/// for the error estimate. Every step's equation is solved by Newton with a factorisation that is kept while it
/// converges. Throws std::runtime_error when a step does not converge: with lift, wind pushes an edge-on
/// triangle to either side by a jump, and a step that ends on one has no solution.
ReferenceRun run_implicit(const SpringNetwork& network, std::span<const double> times,
                          const ImplicitOptions& options = {});

/// Makes one run at steps of at most `step` seconds, without an estimate.
std::vector<NetworkState> implicit_states(const SpringNetwork& network, std::span<const double> times, double step,
                                          const ImplicitOptions& options = {});

/// Text that names the run completely, for ReferenceCache.
std::string implicit_key(const SpringNetwork& network, std::span<const double> times,
                         const ImplicitOptions& options = {});

}  // namespace drape
