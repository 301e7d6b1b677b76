// Reference (a) is symplectic Verlet far below the stability limit, with exact per-second damping.
#pragma once

#include <span>
#include <string>

#include "reference/reference_run.h"
#include "reference/spring_network.h"

namespace drape {

struct SymplecticOptions {
    /// Step of the finest run as a fraction of the stability limit 2/omega_max (omega_max by Gershgorin's bound). The
    /// error estimate takes runs at 2 and 4 times that step, so it must stay at or below 0.24.
    double cfl = 0.1;
    ReferenceProgress progress{};
};

/// Longest step (s) of the finest run.
double symplectic_step(const SpringNetwork& network, const SymplecticOptions& options = {});

/// Returns states at `times` (increasing, >= 0; 0 is the start), integrated three times for the error estimate.
/// Kick-drift-kick solves the flight of constant force and damping exactly, so free fall is exact: with z = c h,
///   x' = x + phi h v + psi h^2 a,   v' = e^(-z)/phi (x' - x)/h + (phi - psi)/phi h a',
/// which is d' = e^(-z) d + phi h^2 a with the start of docs/physics.md 3. It is of second order, also with wind, which
/// takes its velocity from e^(-z) v + phi h a. Steps divide every interval between times and pin releases evenly.
/// Throws std::runtime_error when the positions stop being finite, std::invalid_argument for wrong options or times.
ReferenceRun run_symplectic(const SpringNetwork& network, std::span<const double> times,
                            const SymplecticOptions& options = {});

/// Makes one run at steps of at most `step` seconds, without an estimate.
std::vector<NetworkState> symplectic_states(const SpringNetwork& network, std::span<const double> times, double step,
                                            const ReferenceProgress& progress = {});

/// Text that names the run completely, for ReferenceCache.
std::string symplectic_key(const SpringNetwork& network, std::span<const double> times,
                           const SymplecticOptions& options = {});

}  // namespace drape
