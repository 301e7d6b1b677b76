#include "simulation/frame_checks.h"

#include <fmt/format.h>

namespace drape {

namespace {

using Statistics = std::vector<ClothStatistics>;

std::array<std::uint32_t, 2> place_of(const Grid& grid, std::uint32_t particle) {
    return {particle % grid.columns(), particle / grid.columns()};
}

std::optional<FrameFailure> divergence(const SimulationModel& model, std::uint32_t frame, const Statistics& cloths) {
    for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth) {
        const ClothStatistics& statistics = cloths[cloth];
        if (statistics.non_finite_count == 0) continue;
        const Grid& grid = model.cloths[cloth].grid;
        const auto place = place_of(grid, statistics.first_non_finite);
        std::string reason = fmt::format(
            "the simulation diverged: in frame {}, cloth '{}', the particle in column {}, row {} is not finite "
            "({} of the cloth's {} particles are not); more substeps, weaker forces or stiffness may help",
            frame, model.cloths[cloth].name, place[0], place[1], statistics.non_finite_count, grid.particle_count());
        return FrameFailure{FrameFailure::Kind::not_finite,
                            std::move(reason),
                            frame,
                            "particles that are not finite",
                            static_cast<double>(statistics.non_finite_count),
                            0,
                            model.cloths[cloth].name,
                            place};
    }
    return std::nullopt;
}

std::optional<FrameFailure> nonsense(const SimulationModel& model, Watch& watch, std::uint32_t frame,
                                     const Statistics& cloths) {
    const auto found = watch.implausible(frame, cloths);
    if (!found) return std::nullopt;
    const ClothModel& cloth = model.cloths[found->cloth];
    FrameFailure failure{
        FrameFailure::Kind::implausible, {}, frame, found->criterion, found->value, found->bound, cloth.name};
    if (found->particle) failure.particle = place_of(cloth.grid, *found->particle);
    const std::string who = failure.particle ? fmt::format("the particle in column {}, row {} ", (*failure.particle)[0],
                                                           (*failure.particle)[1])
                                             : std::string();
    failure.reason = fmt::format("the simulation is not plausible: in frame {}, cloth '{}', {}{}; {}", frame,
                                 cloth.name, who, found->what, found->remedy);
    return failure;
}

std::optional<FrameFailure> missed_tolerance(const SimulationModel& model, std::uint32_t frame,
                                             const Statistics& cloths) {
    const SolverSettings& solver = model.scene.solver;
    if (!(model.asked_tolerance > 0) || model.closed_loop())
        return std::nullopt;  // a closed loop judges its frames itself
    for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth) {
        const double error = cloths[cloth].stretch_error_rms;
        if (error <= model.asked_tolerance) continue;
        std::string reason = fmt::format(
            "the tolerance is missed: in frame {}, cloth '{}', the stretch error is {:.3g} RMS, the scene "
            "allows {:.3g}, and method {} with {} substeps x {} iterations does not reach it",
            frame, model.cloths[cloth].name, error, model.asked_tolerance, model.method().name, solver.substeps,
            solver.iterations);
        return FrameFailure{FrameFailure::Kind::tolerance, std::move(reason),       frame, "stretch error, RMS", error,
                            model.asked_tolerance,         model.cloths[cloth].name};
    }
    return std::nullopt;
}

}  // namespace

std::optional<FrameFailure> frame_failure(const SimulationModel& model, Watch& watch, const FinishedFrame& frame) {
    if (auto found = divergence(model, frame.frame, frame.statistics)) return found;
    if (auto found = nonsense(model, watch, frame.frame, frame.statistics)) return found;
    if (auto found = missed_tolerance(model, frame.frame, frame.statistics)) return found;
    if (frame.effort.within_limits) return std::nullopt;
    return FrameFailure{FrameFailure::Kind::tolerance,
                        fmt::format("the tolerance is missed: frame {} is not within its limits even with {} substeps "
                                    "of method {}, the most that method auto tries",
                                    frame.frame, frame.effort.substeps, model.method().name),
                        frame.frame,
                        {}};
}

void raise(const FrameFailure& failure) {
    if (failure.kind == FrameFailure::Kind::tolerance) throw ToleranceMissed(failure.reason, failure);
    throw Diverged(failure.reason, failure);
}

}  // namespace drape
