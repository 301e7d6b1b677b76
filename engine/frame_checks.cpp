#include "frame_checks.h"

#include <fmt/format.h>

namespace drape {

std::optional<std::string> divergence(const SimulationModel& model, std::uint32_t frame,
                                      const std::vector<ClothStatistics>& cloths) {
    for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth) {
        const ClothStatistics& statistics = cloths[cloth];
        if (statistics.non_finite_count == 0) continue;
        const Grid& grid = model.cloths[cloth].grid;
        return fmt::format(
            "the simulation diverged: in frame {}, cloth '{}', the particle in column {}, row {} is not finite "
            "({} of the cloth's {} particles are not); more substeps, weaker forces or stiffness may help",
            frame, model.cloths[cloth].name, statistics.first_non_finite % grid.columns(),
            statistics.first_non_finite / grid.columns(), statistics.non_finite_count, grid.particle_count());
    }
    return std::nullopt;
}

std::optional<std::string> missed_tolerance(const SimulationModel& model, std::uint32_t frame,
                                            const std::vector<ClothStatistics>& cloths) {
    const SolverSettings& solver = model.scene.solver;
    if (!(model.asked_tolerance > 0) || model.closed_loop()) return std::nullopt;  // a closed loop judges by more
    for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth) {
        const double error = cloths[cloth].stretch_error_rms;
        if (error <= model.asked_tolerance) continue;
        return fmt::format(
            "the tolerance is missed: in frame {}, cloth '{}', the stretch error is {:.3g} RMS, the scene "
            "allows {:.3g}, and method {} with {} substeps x {} iterations does not reach it",
            frame, model.cloths[cloth].name, error, model.asked_tolerance, model.method().name, solver.substeps,
            solver.iterations);
    }
    return std::nullopt;
}

std::optional<FrameFailure> frame_failure(const SimulationModel& model, Watch& watch, const FinishedFrame& frame) {
    using enum FrameFailure::Kind;
    if (const auto why = divergence(model, frame.frame, frame.statistics)) return FrameFailure{not_finite, *why};
    if (const std::string why = watch.implausible(frame.frame, frame.statistics); !why.empty())
        return FrameFailure{implausible, why};
    if (const auto why = missed_tolerance(model, frame.frame, frame.statistics)) return FrameFailure{tolerance, *why};
    if (frame.effort.within_limits) return std::nullopt;
    return FrameFailure{
        tolerance, fmt::format("the tolerance is missed: frame {} is not within its limits even with {} substeps of "
                               "method {}, the most that method auto tries",
                               frame.frame, frame.effort.substeps, model.method().name)};
}

void raise(const FrameFailure& failure) {
    if (failure.kind == FrameFailure::Kind::tolerance) throw ToleranceMissed(failure.reason);
    throw Diverged(failure.reason);
}

}  // namespace drape
