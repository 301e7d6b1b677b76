// Rows with a closed form: pendulum, hanging chain, column law, catenary, cantilever. Sheets one or two cells
// wide stand for chains and strips.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bench/problem.h"
#include "reference/closed_forms.h"
#include "reference/model_scenes.h"

namespace drape::bench {

namespace {

using namespace model_scenes;

/// Times (in samples) at which a sampled signal crosses zero, by the cubic through the four samples around.
std::vector<double> zero_crossings(std::span<const double> signal) {
    std::vector<double> times;
    for (std::size_t k = 1; k + 2 < signal.size(); ++k) {
        if ((signal[k] > 0) == (signal[k + 1] > 0)) continue;
        const auto cubic = [&](double t) {
            return -t * (t - 1) * (t - 2) / 6 * signal[k - 1] + (t + 1) * (t - 1) * (t - 2) / 2 * signal[k] -
                   (t + 1) * t * (t - 2) / 2 * signal[k + 1] + (t + 1) * t * (t - 1) / 6 * signal[k + 2];
        };
        double low = 0, high = 1;
        for (int halving = 0; halving < 60; ++halving) {
            const double middle = 0.5 * (low + high);
            ((cubic(middle) > 0) == (signal[k] > 0) ? low : high) = middle;
        }
        times.push_back(static_cast<double>(k) + low);
    }
    return times;
}

// --- Pendulum
// ---------------------------------------------------------------------------------------------------

struct Swing {
    double period;  ///< s
    double height;  ///< m relative to the support, of the highest point after one period
};

/// Measures the swing of a pendulum of 1 m released at 90 degrees; `at(k)` is the bob at frame k, frames 0 .. `last`.
template <class At>
Swing swing_of(const At& at, std::uint32_t last, double fps) {
    std::vector<double> angle;
    for (std::uint32_t frame = 0; frame <= last; ++frame) {
        const Vec3 bob = at(frame);
        angle.push_back(std::atan2(bob[2], -bob[1]));
    }
    const std::vector<double> crossings = zero_crossings(angle);
    Swing swing{crossings.size() >= 3 ? (crossings[2] - crossings[0]) / fps : NAN, -INFINITY};
    for (auto frame = static_cast<std::uint32_t>(2.1 * fps); frame < last && frame < 2.7 * fps; ++frame) {
        const double before = at(frame - 1)[1], here = at(frame)[1], after = at(frame + 1)[1];
        const double bend = 2 * here - before - after;
        const double peak = bend > 0 ? here + (after - before) * (after - before) / (8 * bend) : here;
        if (here >= before && here >= after) swing.height = std::max(swing.height, peak);
    }
    return swing;
}

Problem pendulum(bool is_short) {
    Problem problem{
        .name = "pendulum", .title = "Pendulum released at 90 degrees", .metric = "period_error", .unit = "1"};
    problem.scene = [](std::uint32_t, const Setting&) {
        SceneDescription scene = sheet(2, 2, 1, 1, 1);
        scene.time.frame_count = 211;
        Cloth& cloth = scene.cloths[0];
        cloth.placement.v = {0, 0, 1};
        set_wave_speed(cloth, 100, 0);
        cloth.pins = {pin_top(cloth)};
        return scene;
    };
    problem.evaluate = [](const Recording& run, References& references) -> Metrics {
        const SpringNetwork network(run.scene, 0);
        const double fps = run.scene.time.fps;
        const auto last = static_cast<std::uint32_t>(run.samples.size() - 1);
        std::vector<double> times;
        for (std::uint32_t frame = 1; frame <= last; ++frame) times.push_back(frame / fps);
        const ReferenceRun& reference = references.motion(network, times);
        const Swing own = swing_of([&](std::uint32_t k) { return run.samples[k].position[2]; }, last, fps);
        const Swing exact = swing_of(
            [&](std::uint32_t k) { return k == 0 ? network.rest_position[2] : reference.states[k - 1].position[2]; },
            last, fps);
        const double closed = closed_forms::pendulum_period(1, gravity, std::numbers::pi / 2);
        double squares = 0;
        for (std::uint32_t k = 1; k <= last; ++k) {
            const double rms = position_rms(run.samples[k].position, reference.states[k - 1].position);
            squares += rms * rms;
        }
        return {{"period_error", std::abs(own.period / exact.period - 1)},
                {"period", own.period},
                {"position_rms", std::sqrt(squares / last)},
                {"period_error_closed_form", std::abs(own.period / closed - 1)},
                {"reference_period_error_closed_form", std::abs(exact.period / closed - 1)},
                // It is a share of the energy at the start, m g L above the lowest point.
                {"energy_lost_per_period", exact.height - own.height}};
    };
    for (const Method& row : methods()) {
        const SolverMethod method = row.method;
        std::vector<Setting> settings = substep_settings(method, {4, 8, 16, 24, 32, 48, 64});
        if (!row.sweep.per_link)
            settings = is_short ? substep_settings(method, {5, 10, 20})
                                : substep_settings(method, {1, 2, 5, 10, 20, 40, 80, 160});
        problem.sweeps.push_back({1, settings, 1});
    }
    return problem;
}

// --- Hanging chain
// ----------------------------------------------------------------------------------------------

/// Lowest small modes of a hanging chain of `links` links with half a mass at its end; row per free particle
/// from the top, one mode per column, times the masses: what a shape is projected with.
Eigen::MatrixXd modal_weights(std::uint32_t links) {
    const auto n = static_cast<Eigen::Index>(links);
    Eigen::VectorXd mass = Eigen::VectorXd::Ones(n);
    mass[n - 1] = 0.5;
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index link = 0; link < n; ++link) {
        const double tension = closed_forms::hanging_link_tension(links, static_cast<std::uint32_t>(link), 1, 1, true);
        stiffness(link, link) += tension;
        if (link == 0) continue;
        stiffness(link - 1, link - 1) += tension;
        stiffness(link, link - 1) -= tension;
        stiffness(link - 1, link) -= tension;
    }
    const Eigen::VectorXd root = mass.cwiseSqrt(), inverse = root.cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(inverse.asDiagonal() * stiffness *
                                                                inverse.asDiagonal());
    return root.asDiagonal() * solver.eigenvectors();
}

/// A quarter of a degree of swing: finite amplitude changes the frequencies by 1e-6. The chain starts
/// straight, which wakes the modes that are measured.
Problem chain_modes(bool is_short) {
    constexpr double degrees = 0.25;
    Problem problem{
        .name = "chain modes", .title = "Modes of a hanging chain", .metric = "frequency_error_1", .unit = "1"};
    problem.scene = [](std::uint32_t size, const Setting&) {
        SceneDescription scene = swing(size, 200, degrees);
        scene.time.frame_count = 301;
        Cloth& cloth = scene.cloths[0];
        cloth.grid[0] = 2;
        cloth.size[0] = 1.0 / size;
        cloth.stiffness.shear = 0;
        cloth.pins = {pin_top(cloth)};
        return scene;
    };
    problem.evaluate = [](const Recording& run, References&) -> Metrics {
        const std::uint32_t links = run.scene.cloths[0].grid[1] - 1;
        const Eigen::MatrixXd weights = modal_weights(links);
        Metrics metrics;
        for (std::uint32_t mode = 1; mode <= 3; ++mode) {
            std::vector<double> amplitude;
            for (const Sample& sample : run.samples) {
                double sum = 0;
                for (std::uint32_t row = 1; row <= links; ++row)
                    sum += weights(row - 1, mode - 1) * (sample.position[2 * row][2] + sample.position[2 * row + 1][2]);
                amplitude.push_back(sum);
            }
            const std::vector<double> crossings = zero_crossings(amplitude);
            if (crossings.size() < 2) return {{"frequency_error_1", NAN}};
            const double half_periods = static_cast<double>(crossings.size() - 1);
            const double omega =
                std::numbers::pi * half_periods / (crossings.back() - crossings.front()) * run.scene.time.fps;
            const double exact = closed_forms::hanging_chain_frequency(mode, 1, gravity);
            metrics[fmt::format("frequency_{}", mode)] = omega;
            metrics[fmt::format("frequency_error_{}", mode)] = std::abs(omega / exact - 1);
        }
        return metrics;
    };
    for (const std::uint32_t size :
         is_short ? std::vector<std::uint32_t>{8, 16, 32} : std::vector<std::uint32_t>{8, 16, 32, 64, 128})
        problem.sweeps.push_back({size, explicit_settings(size, {5.3}), 1});
    return problem;
}

// --- Column law
// -------------------------------------------------------------------------------------------------

/// Rigid columns without shear hang under one parity-split sweep per substep: mean strain N^2 g h^2/(2 L).
Problem column_law(bool is_short) {
    Problem problem{.name = "column law",
                    .title = "Stretch of hanging rigid columns under one sweep per substep",
                    .metric = "law_error",
                    .unit = "1"};
    problem.record_every = 180;
    problem.scene = [](std::uint32_t size, const Setting&) {
        SceneDescription scene = sheet(3, size + 1, 2.0 / size, 1, 1);
        scene.time.frame_count = 181;
        Cloth& cloth = scene.cloths[0];
        cloth.stiffness = {false, 1e12, 0, 0};
        cloth.damping = 6;
        cloth.pins = {pin_top(cloth)};
        return scene;
    };
    problem.evaluate = [](const Recording& run, References&) -> Metrics {
        const Cloth& cloth = run.scene.cloths[0];
        const std::uint32_t links = cloth.grid[1] - 1;
        const double h = 1 / (run.scene.time.fps * run.scene.solver.substeps);
        double sum = 0;
        for (std::size_t p = 0; p < run.samples.back().position.size() - 3; ++p) {
            const Vec3 &a = run.samples.back().position[p], &b = run.samples.back().position[p + 3];
            sum += std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) * links - 1;
        }
        const double mean = sum / (3.0 * links);
        // Damping takes a little of gravity's push: the law holds for the force that a substep applies.
        const double effective = gravity * closed_forms::damping_mean(cloth.damping * h);
        const double law = closed_forms::stretch_law(links, effective, h, run.scene.solver.iterations, 1);
        return {{"law_error", std::abs(mean / law - 1)}, {"stretch_mean", mean}};
    };
    for (const std::uint32_t size :
         is_short ? std::vector<std::uint32_t>{16, 32} : std::vector<std::uint32_t>{32, 64, 128})
        problem.sweeps.push_back({size, substep_settings(SolverMethod::relax, {10, 20, 40}), 1});
    return problem;
}

// --- Catenary
// ---------------------------------------------------------------------------------------------------

constexpr double span = 0.8;

/// A level strip whose right end moves in by a fifth in the first second; it then hangs still.
Problem catenary(bool is_short) {
    Problem problem{.name = "catenary",
                    .title = "Catenary over 0.8 of the length",
                    .metric = "position_rms",
                    .unit = "m",
                    .floor = 1e-6};
    problem.record_every = 480;
    problem.scene = [](std::uint32_t size, const Setting&) {
        SceneDescription scene = sheet(size + 1, 2, 1, 1.0 / size, 1);
        scene.time.frame_count = 481;
        Cloth& cloth = scene.cloths[0];
        cloth.placement.v = {0, 0, 1};
        set_wave_speed(cloth, 100, 0);
        cloth.damping = 4;
        cloth.pins = {pin_box(0, 0, 0, 1), pin_box(size, 0, size, 1)};
        cloth.pins[1].path.keys = {{0, {0, 0, 0}, {}}, {1, {span - 1, 0, 0}, {}}};
        return scene;
    };
    problem.evaluate = [](const Recording& run, References&) -> Metrics {
        using namespace closed_forms;
        const Cloth& cloth = run.scene.cloths[0];
        const std::uint32_t links = cloth.grid[0] - 1;
        const double elastic_length = cloth.stiffness.stretch.weft / (cloth.areal_density * gravity);
        const Catenary elastic = elastic_catenary(span, 1, elastic_length), stiff = closed_forms::catenary(span, 1);
        double squares = 0, stiff_squares = 0, lowest = 0;
        for (std::uint32_t k = 0; k <= links; ++k) {
            const double s = static_cast<double>(k) / links - 0.5;
            const Vec3 &a = run.samples.back().position[k], &b = run.samples.back().position[k + links + 1];
            const double x = 0.5 * (a[0] + b[0]) - 0.5 * span, y = 0.5 * (a[1] + b[1]);
            const auto square = [&](const PlanePoint& exact, double sag) {
                return (x - exact.x) * (x - exact.x) + (y + sag - exact.y) * (y + sag - exact.y);
            };
            squares += square(elastic_catenary_point(elastic, elastic_length, s), elastic.sag);
            stiff_squares += square(catenary_point(stiff, s), stiff.sag);
            lowest = std::min(lowest, y);
        }
        return {{"position_rms", std::sqrt(squares / (links + 1))},
                {"position_rms_inextensible", std::sqrt(stiff_squares / (links + 1))},
                {"sag_error", std::abs(-lowest - elastic.sag)}};
    };
    for (const std::uint32_t size :
         is_short ? std::vector<std::uint32_t>{8, 16} : std::vector<std::uint32_t>{8, 16, 32, 64})
        problem.sweeps.push_back({size, explicit_settings(size, {2.61}), 1});
    if (!is_short) {
        problem.sweeps.push_back({64, substep_settings(SolverMethod::relax, {20, 80, 320}), 1});
        problem.sweeps.push_back({64, substep_settings(SolverMethod::line, {4, 8, 20}), 1});
        problem.sweeps.push_back({64, slides_settings({20}), 1});
    }
    return problem;
}

// --- Cantilever
// -------------------------------------------------------------------------------------------------

Problem cantilever_strip(double gamma, bool is_short) {
    Problem problem{.name = fmt::format("cantilever {:g}", gamma),
                    .title = fmt::format("Heavy elastica, Gamma {:g}: fall over reach", gamma),
                    .metric = "ratio_error",
                    .unit = "1"};
    problem.record_every = 1u << 30;
    problem.scene = [gamma](std::uint32_t size, const Setting& setting) {
        return hanging_cantilever(size, gamma, setting.method);
    };
    problem.evaluate = [gamma](const Recording& run, References&) -> Metrics {
        const Vec3& tip = run.samples.back().position[run.scene.cloths[0].grid[0] - 1];
        const double ratio = -tip[1] / tip[0], exact = closed_forms::heavy_elastica(gamma).ratio();
        return {{"ratio", ratio}, {"ratio_error", std::abs(ratio / exact - 1)}};
    };
    const auto add = [&](SolverMethod method, std::initializer_list<std::uint32_t> sizes) {
        for (const std::uint32_t size : sizes)
            problem.sweeps.push_back({size, {{method, cantilever(size, gamma, method).solver.substeps, 1}}, 4});
    };
    if (is_short) {
        add(SolverMethod::explicit_steps, {8, 16});
    } else {
        add(SolverMethod::explicit_steps, {16, 32, 64});
        add(SolverMethod::relax, {16, 32});
        problem.sweeps.push_back({32, substep_settings(SolverMethod::line, {4, 8, 20}), 4});
    }
    return problem;
}

}  // namespace

std::vector<Problem> chain_problems(bool is_short) {
    std::vector<Problem> problems = {pendulum(is_short), chain_modes(is_short), column_law(is_short),
                                     catenary(is_short)};
    for (const double gamma : is_short ? std::vector<double>{10} : std::vector<double>{1, 10, 100})
        problems.push_back(cantilever_strip(gamma, is_short));
    return problems;
}

}  // namespace drape::bench
