// Rows without springs at work: flight, the incline, momentum. Exact to rounding at every number of substeps.
#include <cmath>

#include "bench/problem.h"
#include "reference/closed_forms.h"
#include "reference/model_scenes.h"

namespace drape::bench {

namespace {

using namespace model_scenes;

std::vector<Sweep> every_method(std::uint32_t size, std::initializer_list<std::uint32_t> counts) {
    std::vector<Sweep> sweeps;
    for (const Method& method : methods()) sweeps.push_back({size, substep_settings(method.method, counts), 1});
    return sweeps;
}

Vec3 center_of_mass(const SpringNetwork& network, std::span<const Vec3> position) {
    Vec3 sum{};
    double mass = 0;
    for (std::size_t p = 0; p < position.size(); ++p) {
        mass += network.mass[p];
        for (std::size_t k = 0; k < 3; ++k) sum[k] += network.mass[p] * position[p][k];
    }
    for (double& component : sum) component /= mass;
    return sum;
}

/// Thrown upwards and sideways, 10 s; damping 1/s.
Problem flight(const char* name, const char* title, double damping, std::initializer_list<std::uint32_t> counts) {
    Problem problem{.name = name, .title = title, .metric = "position_relative", .unit = "1", .floor = 0};
    problem.record_every = 600;
    problem.scene = [damping](std::uint32_t size, const Setting&) {
        SceneDescription scene = sheet(size, size, 0.1, 0.1, 1);
        scene.time.frame_count = 601;
        Cloth& cloth = scene.cloths[0];
        cloth.damping = damping;
        cloth.velocity = {2, 5, -1};
        cloth.stiffness = {false, 1, 0, 0};
        return scene;
    };
    problem.evaluate = [](const Recording& run, References&) -> Metrics {
        const Cloth& cloth = run.scene.cloths[0];
        const double time = run.samples.back().frame / run.scene.time.fps;
        double squares = 0, distance = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double moved =
                closed_forms::flight_displacement(cloth.velocity[k], run.scene.gravity[k], cloth.damping, time);
            const double error = run.samples.back().position[0][k] - run.samples.front().position[0][k] - moved;
            squares += error * error;
            distance += moved * moved;
        }
        return {{"position_relative", std::sqrt(squares / distance)}, {"position_rms", std::sqrt(squares)}};
    };
    problem.sweeps = every_method(2, counts);
    return problem;
}

/// From rest on a 30 degree incline for 1 s, pair friction mu: slides by Coulomb's law, or sticks.
Problem incline(const char* name, const char* title, double mu, std::initializer_list<std::uint32_t> counts) {
    constexpr double angle = std::numbers::pi / 6;
    Problem problem{.name = name, .title = title, .metric = "distance_error", .unit = "m"};
    problem.record_every = 60;
    problem.scene = [mu](std::uint32_t size, const Setting&) {
        SceneDescription scene = sheet(size, size, 0.4, 0.4, 1);
        scene.time.frame_count = 61;
        scene.colliders.push_back({Plane{{-std::sin(angle), std::cos(angle), 0}, 0}, mu});
        Cloth& cloth = scene.cloths[0];
        cloth.friction = mu;
        cloth.stiffness = {false, 1, 0, 0};
        cloth.thickness = 0.01;
        cloth.placement = {
            {-0.01 * std::sin(angle), 0.01 * std::cos(angle), 0}, {std::cos(angle), std::sin(angle), 0}, {0, 0, 1}};
        return scene;
    };
    problem.evaluate = [mu](const Recording& run, References&) -> Metrics {
        const std::size_t middle = run.samples[0].position.size() / 2;
        const Vec3 &start = run.samples.front().position[middle], &end = run.samples.back().position[middle];
        const double slid = (start[0] - end[0]) * std::cos(angle) + (start[1] - end[1]) * std::sin(angle);
        const double expected = closed_forms::incline_distance(gravity, angle, mu, 1.0);
        return {{"distance_error", std::abs(slid - expected)}, {"distance", slid}};
    };
    problem.sweeps = every_method(5, counts);
    return problem;
}

constexpr double release_time = 0.1;
constexpr std::uint32_t first_free_frame = 8;

/// Thrown with one corner held for 0.1 s, so that it tumbles and shakes; from then on nothing acts on it. Its
/// momentum is the slope of its centre of mass over the first and over the second half of 1e4 substeps.
Problem momentum() {
    Problem problem{.name = "momentum",
                    .title = "Momentum of a free, shaking sheet over 1e4 substeps",
                    .metric = "momentum_drift",
                    .unit = "1"};
    problem.scene = [](std::uint32_t size, const Setting& setting) {
        SceneDescription scene = sheet(size + 1, size + 1, 1, 1, 1);
        scene.gravity = {0, 0, 0};
        const std::uint32_t half = (5000 + setting.substeps - 1) / setting.substeps;
        scene.time.frame_count = first_free_frame + 2 * half + 1;
        Cloth& cloth = scene.cloths[0];
        set_wave_speed(cloth, 20);
        cloth.velocity = {1, 0.5, 2};
        cloth.pins = {pin_box(0, 0, 0, 0)};
        cloth.pins[0].release = release_time;
        return scene;
    };
    problem.evaluate = [](const Recording& run, References&) -> Metrics {
        const SpringNetwork network(run.scene, 0);
        const std::size_t last = run.samples.size() - 1, half = (last - first_free_frame) / 2;
        const Vec3 a = center_of_mass(network, run.samples[first_free_frame].position);
        const Vec3 b = center_of_mass(network, run.samples[first_free_frame + half].position);
        const Vec3 c = center_of_mass(network, run.samples[last].position);
        const double per_second = run.scene.time.fps / static_cast<double>(half);
        double squares = 0, speed = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double before = (b[k] - a[k]) * per_second, after = (c[k] - b[k]) * per_second;
            squares += (after - before) * (after - before);
            speed += before * before;
        }
        return {{"momentum_drift", std::sqrt(squares / speed)}, {"speed", std::sqrt(speed)}};
    };
    problem.sweeps = every_method(16, {20});
    return problem;
}

}  // namespace

std::vector<Problem> flight_problems(bool is_short) {
    std::vector<Problem> problems;
    if (is_short) {
        problems.push_back(flight("free fall", "Damped fall of 10 s", 0.5, {1, 16}));
        problems.push_back(incline("incline slide", "Sliding down an incline, friction 0.3", 0.3, {4, 16}));
    } else {
        problems.push_back(flight("free fall", "Damped fall of 10 s", 0.5, {1, 4, 16, 64, 256}));
        problems.push_back(flight("ballistic", "Ballistic flight of 10 s", 0, {1, 4, 16, 64, 256}));
        problems.push_back(incline("incline slide", "Sliding down an incline, friction 0.3", 0.3, {1, 4, 16, 64}));
        problems.push_back(incline("incline stick", "Sticking on an incline, friction 0.6", 0.6, {1, 4, 16, 64}));
    }
    problems.push_back(momentum());
    return problems;
}

}  // namespace drape::bench
