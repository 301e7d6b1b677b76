// The device's record of a frame's statistics has the twin's bits, and the numbers of a plain evaluation in double.
#include "twin/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "cloth/texels.h"
#include "device_run.h"
#include "gpu_test.h"
#include "plain_statistics.h"
#include "run/run_statistics.h"
#include "simulation/frame_checks.h"
#include "simulation/frame_server.h"
#include "solver/host_inputs.h"
#include "solver/state_transfer.h"
#include "solver/statistics_pass.h"
#include "support/every_kind.h"
#include "support/meshes.h"
#include "support/sheets.h"

namespace drape {
namespace {

using glsl::vec4;

/// Runs the statistics passes alone, on a state that the test gives.
class StatisticsRun {
  public:
    explicit StatisticsRun(const SimulationModel& model)
        : model_(model), solver_(test::gpu().device, model), slots_(test::gpu().device) {
        solver_.declare(graph_, {.statistics = true});
        solver_.add_statistics(graph_);
        plan_ = graph::make_plan(graph_);
        const std::pair<const graph::Graph*, const graph::Plan*> plans[] = {{&graph_, &plan_}};
        pool_ = std::make_unique<graph::ResourcePool>(test::gpu().device, plans);
        recorded_ = std::make_unique<graph::RecordedPlan>(graph_, plan_, *pool_, graph::TimestampMode::none);
        upload_start(solver_.layout(), *pool_);
    }

    /// Returns the record of cloth 0.
    glsl::StatisticsRecord record(const TwinCloth& state, std::uint32_t frame) {
        const std::string name = model_.cloths[0].name;
        const auto upload = [&](const std::string& image, const auto& values) {
            vulkan::upload(test::gpu().device, pool_->image(image), std::as_bytes(std::span(values)));
        };
        for (const Field each : {Field::position, Field::displacement, Field::end_excess, Field::angular_error})
            if (!state[each].empty()) upload(resource_name(model_.cloths[0], row_of(each)), state[each]);
        for (std::size_t k = 0; k < stretch_direction_count; ++k)
            upload(name + "/tension " + std::string(spring_directions[k].name), state.tension(k));
        write_inputs(solver_.layout(), *pool_, 0, frame, model_);
        slots_.submit(0, recorded_->commands(0));
        slots_.wait(0);
        glsl::StatisticsRecord result;
        std::memcpy(&result, pool_->buffer(statistics_readback_name(name), 0).mapped().data(), sizeof result);
        return result;
    }

    const graph::Graph& graph() const { return graph_; }

  private:
    const SimulationModel& model_;
    ClothSolver solver_;
    graph::Graph graph_;
    graph::Plan plan_;
    std::unique_ptr<graph::ResourcePool> pool_;
    std::unique_ptr<graph::RecordedPlan> recorded_;
    vulkan::FrameSlots slots_;
};

/// Returns the initial state, stretched by `stretch`, crumpled at random by up to `noise` (m), moving at random.
TwinCloth crumpled_state(const SimulationModel& model, float stretch, float noise, unsigned seed) {
    TwinCloth state = Twin(model).cloth(0);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> jitter(-noise, noise), speed(-1e-3f, 1e-3f);
    for (std::size_t i = 0; i < state[Field::position].size(); ++i) {
        vec4& x = state[Field::position][i];
        x = {stretch * x.x + jitter(random), stretch * x.y + jitter(random), stretch * x.z + jitter(random), x.w};
        state[Field::displacement][i] = {speed(random), speed(random), speed(random), 0};
        state[Field::end_excess][i] = {speed(random), speed(random), speed(random), 0};
    }
    for (std::size_t direction = 0; direction < 4; ++direction)
        for (float& extension : state.tension(direction)) extension = jitter(random);
    return state;
}

void expect_relative(double value, double expected, const char* what, double floor = 0) {
    EXPECT_NEAR(value, expected, 1e-5 * std::abs(expected) + floor) << what;
}

void expect_strain(const StrainStatistics& strain, const StrainStatistics& expected, double floor) {
    EXPECT_EQ(strain.spring_count, expected.spring_count);
    expect_relative(strain.rms, expected.rms, "rms strain", floor);
    expect_relative(strain.largest, expected.largest, "largest strain", floor);
    expect_relative(strain.smallest, expected.smallest, "smallest strain", floor);
}

/// `floor`: absolute rounding of a strain.
void expect_plain(const ClothStatistics& statistics, const ClothStatistics& plain, double floor = 0) {
    expect_strain(statistics.stretch, plain.stretch, floor);
    expect_strain(statistics.shear, plain.shear, floor);
    expect_relative(statistics.stretch_error_rms, plain.stretch_error_rms, "RMS stretch error", floor);
    expect_relative(statistics.stretch_error_max, plain.stretch_error_max, "largest stretch error", floor);
    expect_relative(statistics.kinetic_energy, plain.kinetic_energy, "kinetic energy");
    expect_relative(statistics.potential_energy, plain.potential_energy, "potential energy");
    expect_relative(statistics.elastic_energy, plain.elastic_energy, "elastic energy");
    expect_relative(statistics.mass, plain.mass, "mass");
    // Coordinates may cancel, so their error is relative to the distance.
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(statistics.center_of_mass[k], plain.center_of_mass[k], 1e-5 * plain.largest_distance);
    test::expect_momenta(statistics, plain);
    expect_relative(statistics.largest_distance, plain.largest_distance, "largest distance");
    expect_relative(statistics.largest_speed, plain.largest_speed, "largest speed");
    EXPECT_EQ(statistics.non_finite_count, 0u);
}

glsl::StatisticsRecord expect_same_record(const SimulationModel& model, const TwinCloth& state,
                                          std::uint32_t frame = 1) {
    StatisticsRun run(model);
    const auto device = run.record(state, frame), twin = twin_statistics(model, 0, state, frame_inputs(model, frame));
    EXPECT_EQ(std::memcmp(&device, &twin, sizeof device), 0)
        << "stretch " << device.squares.x << " against " << twin.squares.x << ", shear " << device.squares.y
        << " against " << twin.squares.y << ", springs " << device.counts.z << " against " << twin.counts.z;
    return device;
}

SceneDescription soft_sheet(std::uint32_t columns, std::uint32_t rows) {
    SceneDescription scene = test::sheet(columns, rows, 1.2, 0.8, 10);
    scene.cloths[0].stiffness = {false, 700, 90, 0, 0.1};
    scene.cloths[0].placement.origin = {3, 5, -2};
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 0)};
    return scene;
}

void compare(const SceneDescription& scene, const ModelOptions& options = {}, float stretch = 1.15f, double floor = 0) {
    const SimulationModel model(scene, options);
    const float cell = static_cast<float>(std::min(model.cloths[0].spacing[0], model.cloths[0].spacing[1]));
    const TwinCloth state = crumpled_state(model, stretch, 0.1f * cell, 5);
    expect_plain(cloth_statistics(model, model.cloths[0], expect_same_record(model, state)),
                 test::plain_statistics(scene, model, state), floor);
}

TEST(StatisticsTest, SmallestGrid) { compare(soft_sheet(2, 2)); }
TEST(StatisticsTest, OneColumnMoreThanAWorkgroup) { compare(soft_sheet(65, 33)); }
TEST(StatisticsTest, ManyWorkgroupsWide) { compare(soft_sheet(300, 7)); }
TEST(StatisticsTest, MoreRecordsThanLanes) { compare(soft_sheet(40, 130)); }
TEST(StatisticsTest, MoreRecordsThanAChunk) { compare(soft_sheet(4097, 2)); }
TEST(StatisticsTest, SpringsPushedTogetherStoreTheirShare) { compare(soft_sheet(40, 33), {}, 0.97f); }

TEST(StatisticsTest, Holes) {
    SceneDescription scene = soft_sheet(65, 33);
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{50, 20}, {64, 32}}};
    compare(scene);
    const SimulationModel with_holes(scene), whole(soft_sheet(65, 33));
    const TwinCloth state = crumpled_state(with_holes, 1.1f, 0, 1), all = crumpled_state(whole, 1.1f, 0, 1);
    const auto statistics = [](const SimulationModel& model, const TwinCloth& of) {
        return cloth_statistics(model, model.cloths[0], expect_same_record(model, of));
    };
    const ClothStatistics few = statistics(with_holes, state), many = statistics(whole, all);
    // 70 and 168 cells less are as many masses, twice as many diagonals, and the sides that have no cell left.
    EXPECT_NEAR(few.mass / many.mass, 1 - 238.0 / (64 * 32), 1e-6);
    EXPECT_EQ(many.shear.spring_count - few.shear.spring_count, 2 * 238u);
    EXPECT_LT(few.stretch.spring_count, many.stretch.spring_count);
}

std::vector<Vec3> wavy_start(const std::array<std::uint32_t, 2>& grid) {
    std::vector<Vec3> start;
    for (std::uint32_t row = 0; row < grid[1]; ++row)
        for (std::uint32_t column = 0; column < grid[0]; ++column)
            start.push_back({0.02 * column, 0.03 * std::sin(0.5 * column + 0.3 * row), 0.02 * row});
    return start;
}

TEST(StatisticsTest, AClothThatRestsAsItStarts) {
    SceneDescription scene = soft_sheet(65, 33);
    Cloth& cloth = scene.cloths[0];
    cloth.start = wavy_start(cloth.grid);
    cloth.placement = {};
    cloth.rest = Rest::start;
    const SimulationModel model(scene);
    const TwinCloth state = crumpled_state(model, 1.15f, 2e-3f, 5);
    // Some springs are of nearly the length that they have at rest: the difference of two, each rounded to 24 bits.
    expect_plain(cloth_statistics(model, model.cloths[0], expect_same_record(model, state)),
                 test::plain_statistics(scene, model, state), 0x1p-22);
}

/// The sheet is so stiff that bending has most of the energy.
SceneDescription bending_sheet(std::uint32_t columns, std::uint32_t rows) {
    SceneDescription scene = soft_sheet(columns, rows);
    scene.cloths[0].stiffness.bend = 2e-2;
    scene.cloths[0].placement.origin = {0, 0, 0};
    scene.solver.substeps = 2000;
    return scene;
}

TEST(StatisticsTest, BendingIsElasticEnergy) {
    for (const auto& [columns, rows] : {std::pair(2u, 2u), std::pair(2u, 9u), std::pair(65u, 33u), std::pair(70u, 3u)})
        compare(bending_sheet(columns, rows), {}, 1.15f, 0x1p-22);  // as below, some springs are hardly strained
}

TEST(StatisticsTest, BendingBesideHolesAndOfFactors) {
    SceneDescription scene = bending_sheet(65, 33);
    scene.cloths[0].holes = {{{10, 5}, {20, 12}}, {{30, 7}, {31, 8}}, {{50, 20}, {64, 32}}};
    compare(scene);
    Cloth& cloth = scene.cloths[0];
    for (std::uint32_t cell = 0; cell < 64 * 32; ++cell)
        cloth.cell_stiffness.push_back(1.0f + 0.5f * std::sin(0.1f * static_cast<float>(cell)));
    compare(scene);
}

TEST(StatisticsTest, BendingIsCountedAsStiffAsTheMethodMakesIt) {
    SceneDescription scene = bending_sheet(40, 33);
    const auto energy = [&](double rigidity, std::uint32_t substeps) {
        scene.cloths[0].stiffness.bend = rigidity;
        scene.solver.substeps = substeps;
        const SimulationModel model(scene);
        const TwinCloth state = crumpled_state(model, 1, 1e-3f, 5);
        const glsl::StatisticsRecord record = expect_same_record(model, state);
        return cloth_statistics(model, model.cloths[0], record).elastic_energy;
    };
    const double springs = energy(0, 5), whole = energy(2e-2, 2000) - springs, part = energy(2e-2, 5) - springs;
    const double share = ClothModel(scene, 0).scheme.used_bend / 2e-2;
    EXPECT_LT(share, 0.5);
    EXPECT_GT(whole, 0);
    EXPECT_NEAR(part, share * whole, 1e-4 * whole);
}

TEST(StatisticsTest, BendingOfAClothThatRestsBent) {
    SceneDescription scene = bending_sheet(65, 33);
    Cloth& cloth = scene.cloths[0];
    cloth.start = wavy_start(cloth.grid);
    cloth.placement = {};
    cloth.rest = Rest::start;
    cloth.holes = {{{10, 5}, {20, 12}}, {{30, 7}, {31, 8}}};
    const SimulationModel model(scene);
    const TwinCloth state = crumpled_state(model, 1.15f, 2e-3f, 5);
    expect_plain(cloth_statistics(model, model.cloths[0], expect_same_record(model, state)),
                 test::plain_statistics(scene, model, state), 0x1p-22);
    const glsl::StatisticsRecord rest = expect_same_record(model, crumpled_state(model, 1, 0, 5));
    EXPECT_LT(cloth_statistics(model, model.cloths[0], rest).elastic_energy, 1e-6);
}

TEST(StatisticsTest, AMaskChangesNothingOnAWholeCloth) {
    const SceneDescription scene = soft_sheet(37, 20);
    const SimulationModel plain(scene), masked(scene, {.skip = false});
    ASSERT_TRUE(masked.cloths[0].starts_masked);
    const glsl::StatisticsRecord a = expect_same_record(plain, crumpled_state(plain, 1.1f, 1e-3f, 3)),
                                 b = expect_same_record(masked, crumpled_state(masked, 1.1f, 1e-3f, 3));
    EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
}

TEST(StatisticsTest, SmallStrainsUpToTheRoundingOfALength) {
    SceneDescription scene = soft_sheet(64, 48);
    scene.cloths[0].placement.origin = {0, 0, 0};
    const SimulationModel model(scene);
    const TwinCloth state = crumpled_state(model, 1.001f, 0, 1);
    const ClothStatistics statistics = cloth_statistics(model, model.cloths[0], expect_same_record(model, state));
    const ClothStatistics plain = test::plain_statistics(scene, model, state);
    // A strain is the difference of two nearly equal lengths, each rounded to 24 bits.
    constexpr double rounding = 0x1p-22;
    expect_strain(statistics.stretch, plain.stretch, rounding);
    expect_strain(statistics.shear, plain.shear, rounding);
    EXPECT_NEAR(statistics.stretch.rms, 1e-3, 1e-5);
}

TEST(StatisticsTest, SpringsOfZeroStiffnessAreNotCounted) {
    SceneDescription scene = soft_sheet(20, 20);
    scene.cloths[0].stiffness.shear = 0;
    const SimulationModel model(scene);
    const TwinCloth state = crumpled_state(model, 1.2f, 0, 1);
    const ClothStatistics statistics = cloth_statistics(model, model.cloths[0], expect_same_record(model, state));
    EXPECT_EQ(statistics.shear.spring_count, 0u);
    EXPECT_EQ(statistics.shear.rms, 0.0);
    EXPECT_EQ(statistics.stretch.spring_count, 2u * 20 * 19);
    EXPECT_NEAR(statistics.stretch.rms, 0.2, 1e-5);
}

TEST(StatisticsTest, RigidSpringsStoreNoEnergy) {
    SceneDescription scene = soft_sheet(20, 20);
    scene.cloths[0].stiffness.rigid = true;
    for (const SolverMethod method : {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line}) {
        scene.solver.method = method;
        const SimulationModel model(scene);
        const auto record = expect_same_record(model, crumpled_state(model, 1.2f, 0, 1));
        const ClothStatistics statistics = cloth_statistics(model, model.cloths[0], record);
        EXPECT_EQ(statistics.elastic_energy, 0.0);
        EXPECT_NEAR(statistics.stretch.rms, 0.2, 1e-5);
        EXPECT_FALSE(statistics.penetration.has_value());
    }
}

TEST(StatisticsTest, NonFiniteParticlesAreCountedLocatedAndLeftOut) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (const bool holes : {false, true}) {
        SceneDescription scene = soft_sheet(65, 33);
        if (holes) scene.cloths[0].holes = {{{1, 1}, {3, 3}}};
        const SimulationModel model(scene);
        const TwinCloth good = crumpled_state(model, 1.1f, 1e-3f, 2);
        const ClothStatistics before = cloth_statistics(model, model.cloths[0], expect_same_record(model, good));
        TwinCloth bad = good;
        const Grid& grid = model.cloths[0].grid;
        bad[Field::position][grid.particle(64, 32)].z = nan;
        bad[Field::position][grid.particle(40, 17)].x = -infinity;
        bad[Field::displacement][grid.particle(7, 12)].y = -nan;
        const ClothStatistics statistics = cloth_statistics(model, model.cloths[0], expect_same_record(model, bad));
        EXPECT_EQ(before.non_finite_count, 0u);
        EXPECT_EQ(statistics.non_finite_count, 3u);
        EXPECT_EQ(statistics.first_non_finite, grid.particle(7, 12));
        // Two of the three are inner particles, one is a corner.
        EXPECT_NEAR(statistics.mass, before.mass - 2.25 * model.cloths[0].inner_mass, 1e-6 * before.mass);
        EXPECT_LT(statistics.stretch.spring_count, before.stretch.spring_count);
        EXPECT_TRUE(std::isfinite(statistics.stretch.rms + statistics.kinetic_energy + statistics.largest_speed));
    }
}

TEST(StatisticsTest, WhatOverflowsIsLeftOutOfTheNamedValuesAndExtremesAreNamed) {
    const SimulationModel model(soft_sheet(130, 40));
    const Grid& grid = model.cloths[0].grid;
    TwinCloth state = crumpled_state(model, 1, 0, 1);
    state[Field::position][grid.particle(77, 3)].x = 1e30f;
    for (const std::uint32_t column : {100u, 20u})  // as fast as each other, so the lower index counts
        state[Field::displacement][grid.particle(column, 29 - column / 5)] = {0, 1e3f, 0, 0};
    const ClothStatistics statistics = cloth_statistics(model, model.cloths[0], expect_same_record(model, state));
    EXPECT_EQ(statistics.non_finite_count, 0u);
    EXPECT_EQ(statistics.fastest, grid.particle(100, 9));
    EXPECT_EQ(statistics.farthest, grid.particle(77, 3));
    FinishedFrame frame;
    frame.statistics = {statistics};
    Watch watch(model);
    EXPECT_EQ(frame_failure(model, watch, frame).value().particle, (std::array{77u, 2u}));  // a spring's first
    const FrameValues values = frame_values(model.scene, frame);
    EXPECT_FALSE(values.contains("sheet/distance_max_m"));
    EXPECT_TRUE(values.contains("sheet/kinetic_energy_j"));
    for (const auto& [name, value] : values) EXPECT_TRUE(std::isfinite(value)) << name;
}

std::vector<Collider> every_kind() {
    std::vector<Collider> all = test::colliders_of(test::of_every_kind(
        Plane{{0, 1, 0}, 4.3}, Sphere{{3.4, 4.9, -2.05}, 0.1}, Box{{3.9, 4.7, -2}, {0.1, 0.02, 0.3}},
        Ellipsoid{{3.3, 4.5, -1.95}, {0.2, 0.1, 0.07}}, Capsule{{3.6, 4.6, -2.1}, {3.8, 4.65, -1.9}, {0.08, 0.04}},
        test::mesh_of(test::torus_mesh(0.1, 0.05, 24), {3.6, 4.6, -2})));
    all[1].path.keys = {{0, {0, 0, 0}, {}}, {0.5, {0.4, 0, 0}, {}}}, all[2].rotate = {0, 0, 30};
    return all;
}

TEST(StatisticsTest, PenetrationIntoEveryKindOfCollider) {
    for (const std::uint32_t frame : {0u, 1u, 20u})
        for (int kind = -1; kind < glsl::collider_kind_count; ++kind) {  // -1: all at once
            SceneDescription scene = soft_sheet(70, 50);
            scene.time.frame_count = 31, scene.colliders = every_kind();
            std::erase_if(scene.colliders, [&](const Collider& c) { return kind >= 0 && c.kind() != kind; });
            const SimulationModel model(scene);
            const TwinCloth state = Twin(model).cloth(0);
            const auto statistics = cloth_statistics(model, model.cloths[0], expect_same_record(model, state, frame));
            EXPECT_GT(statistics.penetration.value(), 0.003) << "kind " << kind;
        }
}

TEST(StatisticsTest, PenetrationIsTheDepthUnderTheThicknessOfFreeParticles) {
    SceneDescription scene = test::sheet(33, 17, 1, 0.5, 4);  // y from 0 down to -0.5
    scene.time.frame_count = 31;
    scene.cloths[0].thickness = 0.01;
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    scene.colliders = {{Plane{{0, 1, 0}, -0.45}, 0.3, {}, {{{0, {0, 0, 0}, {}}, {0.5, {0, 0.4, 0}, {}}}}}};
    const SimulationModel model(scene);
    const TwinCloth state = Twin(model).cloth(0);
    const auto penetration = [&](std::uint32_t frame) {
        return cloth_statistics(model, model.cloths[0], expect_same_record(model, state, frame)).penetration.value();
    };
    EXPECT_NEAR(penetration(0), 0.05 + 0.01, 1e-6);
    EXPECT_NEAR(penetration(30), 0.45 + 0.01, 1e-6);  // the plane has come up to y = -0.05
    scene.cloths[0].pins = {test::pin_box(0, 0, 32, 16)};
    const SimulationModel held(scene);
    const glsl::StatisticsRecord record = expect_same_record(held, Twin(held).cloth(0), 0);
    EXPECT_EQ(cloth_statistics(held, held.cloths[0], record).penetration, 0.0);
}

class FrameStatistics : public testing::TestWithParam<std::pair<SolverMethod, std::uint32_t>> {};

TEST_P(FrameStatistics, TheyAreHandedOutForEveryFrameThatIsWanted) {
    SceneDescription scene = soft_sheet(40, 30);
    scene.solver.method = GetParam().first;
    scene.solver.iterations = GetParam().second;
    scene.time.frame_count = 9;
    scene.colliders = every_kind();
    Cloth second = scene.cloths[0];
    second.name = "second";
    second.grid = {24, 41};
    second.start = wavy_start(second.grid);
    second.placement = {};
    second.rest = Rest::start;
    scene.cloths.push_back(second);
    const SimulationModel model(scene);
    FrameOptions options;
    options.draw = false;
    options.statistics = true;
    FrameServer server(test::gpu().device, model, options);
    Twin twin(model);
    std::uint32_t next = 0;
    server.run(
        8, [](std::uint32_t frame) { return frame % 2 == 0; },
        [&](const FinishedFrame& frame) {
            ASSERT_EQ(frame.frame, next);
            ASSERT_EQ(frame.statistics.size(), 2u);
            EXPECT_TRUE(frame.positions.empty());
            for (std::size_t cloth = 0; cloth < 2; ++cloth) {
                if (model.cloths[cloth].scheme.gathered_tension) twin.tension(cloth);
                const ClothStatistics expected = cloth_statistics(
                    model, model.cloths[cloth],
                    twin_statistics(model, cloth, twin.cloth(cloth), frame_inputs(model, frame.frame)), frame.frame);
                EXPECT_EQ(frame.statistics[cloth].stretch.rms, expected.stretch.rms);
                EXPECT_EQ(frame.statistics[cloth].stretch_error_rms, expected.stretch_error_rms);
                EXPECT_EQ(frame.statistics[cloth].stretch_error_max, expected.stretch_error_max);
                EXPECT_EQ(frame.statistics[cloth].kinetic_energy, expected.kinetic_energy);
                EXPECT_EQ(frame.statistics[cloth].potential_energy, expected.potential_energy);
                EXPECT_EQ(frame.statistics[cloth].penetration, expected.penetration);
                EXPECT_EQ(frame.statistics[cloth].largest_speed, expected.largest_speed);
            }
            twin.run_frame(next + 1);
            twin.run_frame(next + 2);
            next += 2;
        });
    EXPECT_EQ(next, 10u);
}
INSTANTIATE_TEST_SUITE_P(Methods, FrameStatistics,
                         testing::Values(std::pair(SolverMethod::relax, 1u), std::pair(SolverMethod::relax, 3u),
                                         std::pair(SolverMethod::explicit_steps, 1u), std::pair(SolverMethod::line, 1u),
                                         std::pair(SolverMethod::line, 3u)));

TEST(StatisticsTest, TheStretchErrorIsWhatTheSolverMissedNotWhatTheClothGives) {
    // A soft sheet hangs. It stretches truly by gL/c^2/sqrt(3) RMS, which full-stiffness micro-steps follow exactly and
    // softened ones by the share of the stiffness that they use; relaxation errs by its law, 0.83 of it RMS over
    // columns and hardly over rows.
    SceneDescription scene = test::sheet(25, 25, 1, 1, 64);
    Cloth& cloth = scene.cloths[0];
    cloth.areal_density = 0.2;
    cloth.damping = 12;
    cloth.stiffness = {false, 300, 30, 0};
    cloth.pins = {test::pin_top(cloth)};
    scene.solver.method = SolverMethod::explicit_steps;
    scene.time.frame_count = 121;
    const auto at_rest = [&] {
        const SimulationModel model(scene);
        FrameOptions options;
        options.draw = false;
        options.statistics = true;
        FrameServer server(test::gpu().device, model, options);
        ClothStatistics last;
        server.run(
            120, [](std::uint32_t frame) { return frame == 120; },
            [&](const FinishedFrame& frame) { last = frame.statistics[0]; });
        return last;
    };
    const double truly = 9.81 * 0.2 / 300;
    const ClothStatistics full = at_rest();
    EXPECT_LT(full.stretch_error_rms, 1e-3 * full.stretch.rms);
    EXPECT_GT(full.stretch.rms, 0.3 * truly);
    scene.solver.substeps = 4;
    const ClothModel softened(scene, 0);
    const double share = softened.scheme.used_stiffness[1] / softened.stiffness_constant.spring[1];
    ASSERT_LT(share, 0.5);
    const ClothStatistics soft = at_rest();
    EXPECT_NEAR(soft.stretch_error_rms, (1 - share) * soft.stretch.rms, 0.02 * soft.stretch.rms);
    scene.solver.method = SolverMethod::relax;
    const ClothStatistics relaxed = at_rest();
    scene.solver.method = SolverMethod::line;
    const ClothStatistics solved = at_rest();
    std::printf("[ measured ] line, 4 substeps: stretch error %.2e of a stretch of %.2e, RMS\n",
                solved.stretch_error_rms, solved.stretch.rms);
    EXPECT_LT(solved.stretch_error_rms, 0.01 * solved.stretch.rms);
    EXPECT_GT(solved.stretch.rms, 0.3 * truly);
    const double law = 0.83 / std::sqrt(2.0) * 24 * 24 * 9.81 / (2 * 240.0 * 240.0);
    EXPECT_NEAR(relaxed.stretch_error_rms, law, 0.15 * law);
}

TEST(StatisticsTest, NobodyAsksNothingRuns) {
    const SimulationModel model(soft_sheet(16, 16));
    FrameOptions options;
    options.draw = false;
    options.positions = true;
    FrameServer server(test::gpu().device, model, options);
    EXPECT_FALSE(server.graphs().pool().has(statistics_readback_name(model.cloths[0].name)));
    const auto& skipped = server.graphs().planned(server.graphs().contents(true, true)).plan.skipped;
    EXPECT_TRUE(std::ranges::any_of(skipped, [](const graph::Remark& s) { return s.what == "statistics"; }));
    options.statistics = true;
    FrameServer asked(test::gpu().device, model, options);
    const auto statistics_passes = [&](const FrameContents& contents) {
        return std::ranges::count(asked.graphs().planned(contents).graph.passes(), "statistics", &graph::Pass::stage);
    };
    EXPECT_EQ(statistics_passes(asked.graphs().contents(true, false)), 0);
    EXPECT_EQ(statistics_passes(asked.graphs().contents(true, true)), 2);
    EXPECT_EQ(statistics_passes(asked.graphs().contents(false, true, true)), 2);
}

}  // namespace
}  // namespace drape
