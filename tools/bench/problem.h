// A row of the accuracy benchmark: what is simulated, by which settings, and how wrong the result is.
#pragma once

#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "bench/bench_case.h"
#include "bench/references.h"
#include "cloth/cloth_statistics.h"
#include "cloth/method.h"
#include "drape/simulation.h"

namespace drape::bench {

/// A frame of a run on the device.
struct Sample {
    std::uint32_t frame;
    std::vector<Vec3> position;  ///< m, per particle, the cloths one after the other
    ClothStatistics statistics;  ///< of all cloths (`joined`)
    FrameEffort effort{};
};

/// Returns the statistics of all cloths together: the stretch errors are the worst cloth's, since a tolerance bounds
/// each cloth's; strains, energies and the centre of mass are those of all cloths together.
ClothStatistics joined(std::span<const ClothStatistics> cloths);

/// Adds the mean and the largest number of substeps after the first frame: "substeps_used", "substeps_most".
void put_substeps(std::span<const Sample> samples, Metrics& metrics);

struct Recording {
    const SceneDescription& scene;
    std::vector<Sample> samples;  ///< frame 0 first, the last frame last
};

/// One size of a problem, with the settings of one family, the coarsest first.
struct Sweep {
    std::uint32_t size = 0;
    std::vector<Setting> settings;
    int priority = 0;  ///< of importance: lower runs first
};

struct Problem {
    std::string name;    ///< "swing"
    std::string title;   ///< for plots and tables
    std::string metric;  ///< the error that sweeps, plots and the table go by
    std::string unit;    ///< of it: "m", "1"
    /// Smaller values of the metric mean nothing: they are rounding, or the reference's own error.
    double floor = 0;
    bool timed = false;              ///< repetitions for the time; a plot of error against time
    double strain_damping = 0;       ///< explicit; it is for tangled cloth, and the references have none
    std::uint32_t record_every = 1;  ///< frames between samples; frame 0 and the last are always samples
    std::string identity{};          ///< what else decides a result, beside what the device is given
    std::vector<Target> targets{};   ///< the fewest substeps that keep them are looked for by bisection
    bool of_user = false;            ///< a scene of the user's, measured against its own refined runs
    std::function<SceneDescription(std::uint32_t size, const Setting&)> scene{};
    std::function<Metrics(const Recording&, References&)> evaluate{};
    std::vector<Sweep> sweeps{};
    std::function<std::string(References&)> about{};  ///< lines for the report: what it is compared with
};

/// The order in which `metric` falls as a problem is refined, fitted over the cases of one family.
struct OrderClaim {
    enum class Variable { substeps, size };
    enum class Kind {
        errors,      ///< slope of log metric against log variable
        differences  ///< of the metric's differences between neighbours, whose variable doubles: for values,
                     ///< not errors
    };
    std::string problem;
    std::string family;  ///< "relax", "explicit"
    std::string metric;
    Variable variable = Variable::substeps;
    double expected = 0;  ///< slope; -2: second order in substeps
    double tolerance = 0;
    double floor = 0, ceiling = 1e300;  ///< values outside are not in the asymptotic range
    std::uint32_t size = 0;             ///< of the problem; 0 when it is the variable
    Kind kind = Kind::errors;
    double least_variable = 0;  ///< smaller ones are not in the asymptotic range either
};

/// Every problem with its sweeps: the full benchmark's, or the short one's.
std::vector<Problem> all_problems(bool is_short);
/// Returns the orders of convergence that theory predicts for these problems.
std::vector<OrderClaim> order_claims();

// --- Sweeps: how coarse, how fine, in what steps

/// Settings of one iteration per substep.
std::vector<Setting> substep_settings(SolverMethod method, std::initializer_list<std::uint32_t> substeps);
/// Settings of one substep and many iterations.
std::vector<Setting> slides_settings(std::initializer_list<std::uint32_t> iterations);
/// Explicit micro-steps, `per_link` times the number of links per frame; from 2.61 on nothing is softened at
/// wave speed 100 m/s and 60 frames/s.
std::vector<Setting> explicit_settings(std::uint32_t links, std::initializer_list<double> per_link);

/// The method's own sweep (cloth/method.h) for `links` links along the cloth.
std::vector<Setting> sweep_settings(const Method& method, std::uint32_t links, bool quick);

/// The sweeps of every method and `auto`, for `links` links over 1 m. Relaxation needs very many substeps for the
/// position error that the others reach: those cases take longest and have a priority of their own.
std::vector<Sweep> work_sweeps(std::uint32_t links, int priority, int finest_relax_priority);
/// Returns the same for a few settings.
std::vector<Sweep> short_sweeps(std::uint32_t links, int priority);

// One function per group of rows; all_problems joins them.
std::vector<Problem> flight_problems(bool is_short);  ///< falls, incline, momentum
std::vector<Problem> chain_problems(bool is_short);  ///< pendulum, chain modes, catenary, law of the column, cantilever
std::vector<Problem> sheet_problems(bool is_short);  ///< swing, drum, drape, strip, hanging sheet, energy

}  // namespace drape::bench
