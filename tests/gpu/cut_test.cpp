// Cutting on the device gives the twin's findings and state bit for bit, through a thousand cuts; pieces fall free; an
// idle cutter costs and changes nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>

#include "base/vectors.h"
#include "device_run.h"
#include "gpu_test.h"
#include "simulation/frame_server.h"
#include "support/cut_checks.h"
#include "support/sheets.h"
#include "support/twin_with_cuts.h"

namespace drape {
namespace {

Cutter blade(const Vec3& a, const Vec3& b, const Vec3& c, double begin, double end) {
    Cutter cutter;
    cutter.triangle = {a, b, c};
    cutter.begin = begin;
    cutter.end = end;
    return cutter;
}

FrameOptions positions_only() {
    FrameOptions options;
    options.draw = false;
    options.positions = true;
    return options;
}

std::vector<glsl::vec4> texels(std::span<const float> xyzw) {
    std::vector<glsl::vec4> list(xyzw.size() / 4);
    std::memcpy(list.data(), xyzw.data(), xyzw.size_bytes());
    return list;
}

/// Returns random blades, one after the other, anywhere about the sheet.
std::vector<Cutter> random_blades(std::size_t count, double fps, double size) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 0.9), depth(-0.5, 0.5);
    std::vector<Cutter> cutters;
    for (std::size_t k = 0; k < count; ++k) {
        const double begin = (static_cast<double>(k) + 0.5) / fps;
        const double x = unit(random), y = -unit(random), reach = 0.05 * size;
        Cutter cutter = blade({size * x, size * y, -0.6}, {size * x + reach, size * y - reach * depth(random), 0.6},
                              {size * x, size * y + reach, depth(random)}, begin, begin);
        if (k % 3 == 0) {
            cutter.end = begin + 0.4 / fps;
            cutter.path.keys = {{begin, {0, 0, 0}, {}}, {cutter.end, {0.05, 0.02, 0.1}, {0, 0, 30}}};
        }
        cutters.push_back(cutter);
    }
    return cutters;
}

TEST(CutTest, AThousandCutsKeepEveryInvariantAndEqualTheTwin) {
    constexpr std::uint32_t cut_count = 1450;  // blades; at least a thousand of them cut
    SceneDescription scene = test::sheet(56, 50, 0.9, 0.8, 2);
    scene.time.frame_count = cut_count + 2;
    scene.gravity = {0, -0.02, 0};  // so that pieces stay about
    scene.wind.velocity = {1e-9, 0, 0};
    scene.cloths[0].damping = 3;
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    scene.cloths[0].holes = {{{3, 3}, {6, 7}}};
    scene.colliders.push_back({Plane{{0, 1, 0}, -1}});  // keeps pieces within the blades' reach
    scene.cutters = random_blades(cut_count, scene.time.fps, 0.9);

    test::TwinWithCuts twin(scene);
    const double area = twin.topology(0).rest_area();
    std::uint32_t device_cuts = 0, twin_cuts = 0;
    std::uint64_t springs = 0;
    FrameOptions options = positions_only();
    RunListener listener;
    listener.on_cut = [&](const CutEvent& event, const CutTopology& topology) {
        ++device_cuts;
        springs += event.counts.springs;
        test::expect_consistent(topology);
        EXPECT_NEAR(topology.rest_area(), area, 1e-6 * area);
    };
    FrameServer server(test::gpu().device, twin.model(), options, listener);
    server.run(
        cut_count + 1, [](std::uint32_t) { return true; },
        [&](const FinishedFrame& frame) {
            if (testing::Test::HasFailure()) return;
            twin_cuts += twin.run_frame(frame.frame).any();
            std::string where;
            ASSERT_TRUE(test::same_bits(texels(frame.positions[0]), twin.position(0), where))
                << "frame " << frame.frame << ": " << where;
        },
        [] { return testing::Test::HasFailure(); });
    EXPECT_EQ(device_cuts, twin_cuts);
    EXPECT_GE(device_cuts, 1000u);
    const std::size_t pieces = test::piece_count(twin.topology(0));
    std::printf("[ measured ] %u of %u blades cut, %lu springs, %zu pieces\n", device_cuts, cut_count,
                static_cast<unsigned long>(springs), pieces);
    EXPECT_GT(pieces, 10u);
}

/// The cloth starts bent, and its cells differ in stiffness and density.
TEST(CutTest, CutsOfAGivenShapeWithMapsEqualTheTwin) {
    constexpr std::uint32_t cut_count = 60;
    SceneDescription scene = test::sheet(40, 36, 0.9, 0.8, 4);
    scene.time.frame_count = cut_count + 2;
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness.bend = 1e-4;
    cloth.pins = {test::pin_top(cloth)};
    for (std::size_t cell = 0; cell < std::size_t{39} * 35; ++cell) {
        cloth.cell_stiffness.push_back(0.2f + 0.8f * static_cast<float>(cell % 11) / 10);
        cloth.cell_density.push_back(1 + static_cast<float>(cell % 3));
    }
    for (std::size_t i = 0; i < std::size_t{40} * 36; ++i) {
        const double x = 0.9 * static_cast<double>(i % 40) / 39, y = 0.8 * static_cast<double>(i / 40) / 35;
        cloth.start.push_back({std::sin(x), -y, 0.1 * std::cos(3 * x)});
    }
    scene.wind.velocity = {0.3, 0, 1};
    scene.cutters = random_blades(cut_count, scene.time.fps, 0.9);
    test::TwinWithCuts twin(scene);
    std::uint32_t cuts = 0;
    FrameOptions options = positions_only();
    RunListener listener;
    listener.on_cut = [&](const CutEvent&, const CutTopology& topology) { test::expect_consistent(topology); };
    FrameServer server(test::gpu().device, twin.model(), options, listener);
    server.run(
        cut_count + 1, [](std::uint32_t) { return true; },
        [&](const FinishedFrame& frame) {
            if (testing::Test::HasFailure()) return;
            cuts += twin.run_frame(frame.frame).any();
            std::string where;
            ASSERT_TRUE(test::same_bits(texels(frame.positions[0]), twin.position(0), where))
                << "frame " << frame.frame << ": " << where;
        },
        [] { return testing::Test::HasFailure(); });
    EXPECT_GT(cuts, 20u);
}

/// Mass-weighted centre of the particles below the cut.
Vec3 centre_below(const SimulationModel& model, std::span<const float> xyzw, std::uint32_t first_row) {
    Vec3 sum{};
    double mass = 0;
    const Grid& grid = model.cloths[0].grid;
    for (std::size_t i = std::size_t{first_row} * grid.columns(); i < grid.particle_count(); ++i) {
        const double m = 1 / double(xyzw[4 * i + 3]);
        for (std::size_t k = 0; k < 3; ++k) sum[k] += m * double(xyzw[4 * i + k]);
        mass += m;
    }
    for (double& s : sum) s /= mass;
    return sum;
}

TEST(CutTest, ThePieceCutFromAHangingSheetFallsFreeAndTheOtherHangsOn) {
    SceneDescription scene = test::sheet(33, 33, 1, 1, 16);
    scene.time.frame_count = 62;
    scene.cloths[0].stiffness = {false, 4000, 400, 0};
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    const double y = -0.5 - 0.4 / 32;  // between rows 16 and 17 of the hanging sheet
    scene.cutters = {blade({-5, y, -3}, {5, y, -3}, {0, y, 6}, 20.5 / 60, 20.5 / 60)};
    const SimulationModel model(scene);
    std::vector<Vec3> centre;
    double lowest_above = 0;
    std::uint32_t cut_frame = 0;
    FrameOptions options = positions_only();
    RunListener listener;
    listener.on_cut = [&](const CutEvent& event, const CutTopology& cut) {
        cut_frame = event.frame;
        EXPECT_EQ(test::piece_count(cut), 2u);
    };
    FrameServer server(test::gpu().device, model, options, listener);
    server.run(
        61, [](std::uint32_t) { return true; },
        [&](const FinishedFrame& frame) {
            centre.push_back(centre_below(model, frame.positions[0], 17));
            for (std::size_t i = 0; i < 17 * 33; ++i)
                lowest_above = std::min(lowest_above, double(frame.positions[0][4 * i + 1]));
        });
    EXPECT_EQ(cut_frame, 21u);
    EXPECT_GT(lowest_above, -0.62) << "the upper part hangs on";
    // From the frame of the cut on, nothing outside touches the piece. Its velocity comes from the first step.
    const double g = 9.81, dt = 1.0 / 60;
    const double velocity = (centre[22][1] - centre[21][1]) / dt + g * dt / 2;
    double worst = 0;
    for (std::uint32_t frame = 26; frame <= 61; ++frame) {
        const double t = (frame - 21) * dt;
        const double fallen = velocity * t - g * t * t / 2;
        worst = std::max(worst, std::abs(centre[frame][1] - centre[21][1] - fallen) / std::abs(g * t * t / 2));
    }
    std::printf("[ measured ] centre of mass of the piece: worst relative error %.2e over %.2f s\n", worst, 40 * dt);
    EXPECT_LE(worst, 1e-4);
}

TEST(CutTest, AnIdleCutterCostsNothingAndChangesNoBit) {
    SceneDescription scene = test::sheet(20, 20, 1, 1, 8);
    scene.time.frame_count = 20;
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    scene.wind.velocity = {0, 0, 3};
    SceneDescription idle = scene;
    idle.cutters = {blade({-5, -0.5, -3}, {5, -0.5, -3}, {0, -0.5, 6}, 90, 100)};
    std::vector<std::vector<glsl::vec4>> without, with;
    const SimulationModel plain_model(scene), idle_model(idle);
    FrameServer plain_server(test::gpu().device, plain_model, positions_only());
    plain_server.run(
        19, [](std::uint32_t) { return true; },
        [&](const FinishedFrame& frame) { without.push_back(texels(frame.positions[0])); });
    FrameOptions options = positions_only();
    options.timestamps = graph::TimestampMode::passes;
    std::vector<std::string> timed;
    FrameServer idle_server(test::gpu().device, idle_model, options);
    idle_server.run(
        19, [](std::uint32_t) { return true; },
        [&](const FinishedFrame& frame) {
            with.push_back(texels(frame.positions[0]));
            for (const StageTime& timing : frame.timings) timed.push_back(timing.name);
        });
    ASSERT_EQ(with.size(), without.size());
    std::string where;
    for (std::size_t frame = 0; frame < with.size(); ++frame)
        EXPECT_TRUE(test::same_bits(with[frame], without[frame], where)) << frame << ": " << where;
    EXPECT_FALSE(timed.empty());
    for (const std::string& name : timed) EXPECT_EQ(name.find("cut"), std::string::npos) << name;
    const PlannedGraph& searched_not = idle_server.graphs().planned(idle_server.graphs().contents(true, true));
    for (const graph::PlannedPass& pass : searched_not.plan.passes)
        EXPECT_NE(searched_not.graph.passes()[pass.pass].stage, "cut");
    EXPECT_FALSE(idle_server.graphs().pool().has("sheet/spring shares")) << "the image comes with the first cut";
    EXPECT_FALSE(plain_server.graphs().pool().has("cutters"));
}

/// Runs `frames` frames on the device and on the twin: the bits after each are the same, and there are at least ten
/// cuts. Returns the tethers of the twin's first cloth as the cuts left them.
std::vector<glsl::ParticleTethers> expect_the_twins_cuts(const SceneDescription& scene, std::uint32_t frames,
                                                         const Kernels& kernels = Kernels::automatic()) {
    test::TwinWithCuts twin(scene, kernels);
    std::uint32_t device_cuts = 0, twin_cuts = 0;
    FrameOptions options = positions_only();
    options.kernels = kernels;
    RunListener listener;
    listener.on_cut = [&](const CutEvent&, const CutTopology&) { ++device_cuts; };
    FrameServer server(test::gpu().device, twin.model(), options, listener);
    server.run(
        frames, [](std::uint32_t) { return true; },
        [&](const FinishedFrame& frame) {
            if (testing::Test::HasFailure()) return;
            twin_cuts += twin.run_frame(frame.frame).any();
            std::string where;
            ASSERT_TRUE(test::same_bits(texels(frame.positions[0]), twin.position(0), where))
                << "frame " << frame.frame << ": " << where;
        },
        [] { return testing::Test::HasFailure(); });
    EXPECT_EQ(device_cuts, twin_cuts);
    EXPECT_GE(device_cuts, 10u);
    return twin.topology(0).tethers();
}

TEST(CutTest, TheLineSolverCarriesItsHistoryThroughCuts) {
    // Without colliders the solver is of second order, so that its history goes over to the new resources too.
    constexpr std::uint32_t frames = 40;
    SceneDescription scene = test::sheet(40, 36, 0.9, 0.8, 3);
    scene.time.frame_count = frames + 1;
    scene.solver.method = SolverMethod::line;
    scene.solver.iterations = 2;
    scene.solver.tethers = true;  // end with the first cut
    scene.gravity = {0, -0.5, 0};
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    scene.cutters = random_blades(frames - 5, scene.time.fps, 0.9);
    const ClothModel model(scene, 0);
    ASSERT_TRUE(model.scheme.second_order);
    ASSERT_EQ(model.tethers[5 * 40].anchor_a, 0);
    EXPECT_EQ(expect_the_twins_cuts(scene, frames)[5 * 40].anchor_a, -1);
}

constexpr std::uint32_t bending_frames = 30;

SceneDescription bending_cut(SolverMethod method) {
    SceneDescription scene = test::sheet(40, 36, 0.9, 0.8, 3);
    scene.time.frame_count = bending_frames + 1;
    scene.solver.method = method;
    scene.cloths[0].stiffness = {false, 20, 2, 1e-4};
    scene.cloths[0].pins = {test::pin_top(scene.cloths[0])};
    scene.gravity = {0, -0.5, 0.3};
    scene.cutters = random_blades(bending_frames - 5, scene.time.fps, 0.9);
    return scene;
}

class CutBending : public testing::TestWithParam<SolverMethod> {};

TEST_P(CutBending, EndsAtCuts) { expect_the_twins_cuts(bending_cut(GetParam()), bending_frames); }

INSTANTIATE_TEST_SUITE_P(Methods, CutBending,
                         testing::Values(SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line));

TEST(CutTest, BendingByCyclicReductionEndsAtCuts) {
    expect_the_twins_cuts(bending_cut(SolverMethod::line), bending_frames, cyclic_kernels);
}

TEST(CutTest, ABladeInFrameZeroActsFromFrameOneOn) {
    SceneDescription scene = test::sheet(9, 9, 0.8, 0.8, 4);
    scene.time.frame_count = 4;
    scene.cutters = {blade({0.33, 5, -5}, {0.33, -10, -5}, {0.33, -2, 10}, 0, 0)};
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 8)};
    test::TwinWithCuts twin(scene);
    std::vector<std::uint32_t> cut_frames;
    FrameOptions options = positions_only();
    RunListener listener;
    listener.on_cut = [&](const CutEvent& event, const CutTopology&) { cut_frames.push_back(event.frame); };
    FrameServer server(test::gpu().device, twin.model(), options, listener);
    server.run(
        3, [](std::uint32_t) { return true; },
        [&](const FinishedFrame& frame) {
            twin.run_frame(frame.frame);
            std::string where;
            EXPECT_TRUE(test::same_bits(texels(frame.positions[0]), twin.position(0), where)) << where;
        });
    EXPECT_EQ(cut_frames, std::vector<std::uint32_t>{0});
}

/// The surface that a triangle sweeps on its way: its last place, its first, and two triangles per side.
std::vector<std::array<Vec3, 3>> prism(const std::array<Vec3, 3>& from, const Vec3& way) {
    std::array<Vec3, 3> to = from;
    for (Vec3& corner : to)
        for (std::size_t k = 0; k < 3; ++k) corner[k] += way[k];
    std::vector<std::array<Vec3, 3>> faces{to, from};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        faces.push_back({from[k], from[next], to[next]});
        faces.push_back({from[k], to[next], to[k]});
    }
    return faces;
}

TEST(CutTest, EveryFaceOfWhatABladeSweepsCuts) {
    const std::array<Vec3, 3> triangle{{{0, 0, 0}, {1, 0.1, 0}, {0.2, 1, 0.1}}};
    const Vec3 way{0.3, -0.2, 0.9};
    for (const auto& [a, b, c] : prism(triangle, way)) {
        SceneDescription scene = test::sheet(6, 6, 0.02, 0.02, 2);  // far smaller than the face, across its middle
        scene.time.frame_count = 3;
        scene.gravity = {0, 0, 0};
        const double begin = 0.2 / scene.time.fps, end = 0.8 / scene.time.fps;
        Cutter cutter = blade(triangle[0], triangle[1], triangle[2], begin, end);
        cutter.path.keys = {{begin, {0, 0, 0}, {}}, {end, way, {}}};
        scene.cutters = {cutter};
        Vec3 along, beside, middle;
        for (std::size_t k = 0; k < 3; ++k) {
            along[k] = b[k] - a[k];
            beside[k] = c[k] - a[k];
            middle[k] = (a[k] + b[k] + c[k]) / 3;
        }
        const Vec3 across = cross(along, beside);
        Placement& place = scene.cloths[0].placement;
        for (std::size_t k = 0; k < 3; ++k) {
            place.u[k] = across[k] / length(across);
            place.v[k] = along[k] / length(along);
            place.origin[k] = middle[k] - 0.01 * (place.u[k] + place.v[k]);
        }
        test::TwinWithCuts twin(scene);
        std::uint32_t springs = 0;
        FrameOptions options = positions_only();
        RunListener listener;
        listener.on_cut = [&](const CutEvent& event, const CutTopology&) { springs += event.counts.springs; };
        FrameServer server(test::gpu().device, twin.model(), options, listener);
        server.run(
            2, [](std::uint32_t) { return true; },
            [&](const FinishedFrame& frame) {
                twin.run_frame(frame.frame);
                std::string where;
                EXPECT_TRUE(test::same_bits(texels(frame.positions[0]), twin.position(0), where)) << where;
            });
        EXPECT_GE(springs, 6u);  // the middle one of every row, and diagonals
    }
}

TEST(CutTest, DrawingACutClothIsCleanAndKeepsTheWholeSheetCovered) {
    SceneDescription scene = test::sheet(17, 17, 1, 1, 4);
    scene.time.frame_count = 8;
    scene.gravity = {0, 0, 0};
    scene.cloths[0].appearance.pattern = Pattern::plain;
    scene.cutters = {blade({0.31, 5, -5}, {0.37, -10, -5}, {0.33, -2, 10}, 0.02, 0.02),
                     blade({-5, -0.41, -3}, {5, -0.45, -3}, {0, -0.43, 6}, 0.05, 0.05)};
    scene.camera = Camera{{0.5, -0.5, -2}, {0.5, -0.5, 0}, 40};
    FrameOptions options;
    options.width = options.height = 256;
    options.samples = 1;
    std::vector<std::vector<std::uint8_t>> pictures;
    int cuts = 0;
    RunListener listener;
    listener.on_cut = [&](const CutEvent&, const CutTopology&) { ++cuts; };
    const SimulationModel model(scene);
    FrameServer server(test::gpu().device, model, options, listener);
    server.run(
        7, [](std::uint32_t) { return true; },
        [&](const FinishedFrame& frame) { pictures.emplace_back(frame.rgba.begin(), frame.rgba.end()); });
    EXPECT_EQ(cuts, 2);
    // Nothing moves, so the cut sheet, drawn in parts, covers the pixels that the whole one did.
    std::size_t different = 0, covered = 0;
    for (std::size_t pixel = 0; pixel < pictures[0].size(); pixel += 4) {
        covered += std::memcmp(&pictures[0][pixel], &pictures[0][0], 3) != 0;
        different += std::abs(int(pictures[0][pixel]) - int(pictures[7][pixel])) > 8;
    }
    EXPECT_GT(covered, 256u * 256u / 4);
    std::printf("[ measured ] %zu of %zu covered pixels differ after two cuts at rest\n", different, covered);
    EXPECT_LE(different, covered / 500);
}

}  // namespace
}  // namespace drape
