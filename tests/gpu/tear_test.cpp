// Cloth that tears: it holds up to the load asked for and no farther, parts in one line, and the device's bits are the
// twin's.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "device_run.h"
#include "drape/scene_reader.h"
#include "gpu_test.h"
#include "simulation/frame_server.h"
#include "support/cut_checks.h"
#include "support/sheets.h"
#include "support/twin_with_cuts.h"

namespace drape {
namespace {

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

bool always(std::uint32_t) { return true; }

/// A strip hangs from its top edge, and gravity grows from nothing; below `seam` the strip weighs what the seam bears.
SceneDescription weighed_strip(SolverMethod method, std::array<std::uint32_t, 2> grid, std::uint32_t frames) {
    const std::uint32_t substeps = method == SolverMethod::line ? 12 : 48;  // explicit steps follow the springs then
    SceneDescription scene = test::sheet(grid[0], grid[1], 0.1, 0.4, substeps);
    scene.solver.method = method;
    if (method == SolverMethod::relax) scene.solver.iterations = 8;
    scene.time.frame_count = frames + 1;
    scene.gravity_keys = {{0, {0, 0, 0}}, {frames / scene.time.fps, {0, -40, 0}}};
    Cloth& cloth = scene.cloths[0];
    cloth.areal_density = 0.5;
    cloth.stiffness = {false, 150, 30, 0};
    cloth.damping = 6;
    cloth.pins = {test::pin_top(cloth)};
    return scene;
}

/// Makes the cells of a row bear so much of what the others do.
void add_seam(Cloth& cloth, std::uint32_t row, float factor) {
    const std::uint32_t cells = cloth.grid[0] - 1;
    cloth.cell_tear.assign(std::size_t{cells} * (cloth.grid[1] - 1), 1);
    std::fill_n(cloth.cell_tear.begin() + static_cast<std::ptrdiff_t>(row * cells), cells, factor);
}

struct TornOff {
    std::uint32_t frame = 0, events = 0, pieces = 0, crumbs = 0, springs = 0, triangles = 0;
    std::vector<std::uint32_t> rows;  ///< in which column springs ended
};

TornOff torn_off(const SceneDescription& scene) {
    const SimulationModel model(scene);
    TornOff torn;
    const FrameOptions options = positions_only();
    RunListener listener;
    listener.on_cut = [&](const CutEvent& event, const CutTopology& topology) {
        if (torn.events++ == 0) torn.frame = event.frame;
        torn.pieces = event.counts.pieces;
        torn.crumbs = event.counts.crumbs;
        torn.springs += event.counts.torn;
        torn.triangles += event.counts.triangles;
        test::expect_consistent(topology);
        torn.rows.clear();
        for (std::size_t k = 0; k < model.cloths[0].grid.particle_count(); ++k)
            if (topology.cut_fraction(k, 1) >= 0)
                torn.rows.push_back(static_cast<std::uint32_t>(k) / model.cloths[0].grid.columns());
    };
    FrameServer server(test::gpu().device, model, options, listener);
    server.run(scene.time.frame_count - 1, always, [](const FinishedFrame&) {});
    return torn;
}

class TornBy : public testing::TestWithParam<SolverMethod> {};

/// Weight is a force that no spring's law is needed for.
TEST_P(TornBy, TheTensionAskedFor) {
    for (const std::array<std::uint32_t, 2> grid : {std::array{5u, 17u}, {9u, 33u}}) {
        constexpr std::uint32_t frames = 240;
        if (GetParam() == SolverMethod::relax && grid[1] > 17) continue;  // takes iterations with the square of rows
        SceneDescription scene = weighed_strip(GetParam(), grid, frames);
        Cloth& cloth = scene.cloths[0];
        const std::uint32_t seam = (grid[1] - 1) / 2 - 1;  // the cells above the middle
        cloth.tear = Tear{.strain = {}, .tension = 8};
        add_seam(cloth, seam, 0.25f);
        const TornOff torn = torn_off(scene);
        ASSERT_EQ(torn.pieces, 2u);
        EXPECT_EQ(torn.rows, std::vector<std::uint32_t>(grid[0], seam)) << "the seam and nothing else";
        EXPECT_EQ(torn.triangles, 2 * (grid[0] - 1));
        // Below the middle of the seam hangs this area over the width.
        const double below = cloth.size[1] * (1 - (seam + 0.5) / (grid[1] - 1));
        const double gravity = 40.0 * torn.frame / frames;
        const double tension = cloth.areal_density * below * gravity;
        std::printf("[ measured ] %ux%u particles: parted in frame %u at %.4f N/m, asked for 2\n", grid[0], grid[1],
                    torn.frame, tension);
        EXPECT_NEAR(tension, 2, 0.02 * 2);
    }
}

/// The ends are drawn apart at 2 cm/s; away from them the strain is that of the whole.
TEST_P(TornBy, TheStrainAskedFor) {
    SceneDescription scene = weighed_strip(GetParam(), {5, 33}, 240);
    scene.gravity_keys.clear();
    scene.gravity = {0, 0, 0};
    Cloth& cloth = scene.cloths[0];
    cloth.pins.push_back(test::pin_box(0, 32, 4, 32));
    cloth.pins[1].path.keys = {{0, {0, 0, 0}, {}}, {4, {0, -0.08, 0}, {}}};
    cloth.tear = Tear{.strain = 0.2, .tension = {}};
    add_seam(cloth, 16, 0.5f);
    const TornOff torn = torn_off(scene);
    ASSERT_EQ(torn.pieces, 2u);
    EXPECT_EQ(torn.rows, std::vector<std::uint32_t>(5, 16));
    const double strain = 0.08 / 0.4 * torn.frame / 240;
    std::printf("[ measured ] parted in frame %u at a strain of %.4f, asked for 0.1\n", torn.frame, strain);
    EXPECT_NEAR(strain, 0.1, 0.02 * 0.1);
}

/// A strip that is as strong everywhere is jerked apart: wherever it gives way, it is one line.
TEST_P(TornBy, AnEvenStripPartsInTwoPieces) {
    SceneDescription scene = weighed_strip(GetParam(), {9, 33}, 90);
    scene.gravity_keys.clear();
    scene.gravity = {0, -1, 0};
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness.compression = 0.1;  // it buckles as it snaps back
    cloth.pins.push_back(test::pin_box(0, 32, 8, 32));
    cloth.pins[1].path.keys = {{0, {0, 0, 0}, {}}, {1, {0, -0.2, 0}, {}}};
    cloth.tear = Tear{.strain = {}, .tension = 30};
    const TornOff torn = torn_off(scene);
    EXPECT_EQ(torn.pieces, 2u);
    EXPECT_EQ(torn.crumbs, 0u);
    EXPECT_GE(torn.rows.size(), 9u);
    EXPECT_LE(torn.rows.size(), 9u + 4u) << "beside the line at most a nick at every corner that is held";
}

constexpr std::uint32_t twin_frames = 45;

/// Two cloths, one with a hole, cells that differ in all that they can, and pins that pull aslant.
SceneDescription pulled_apart(SolverMethod method) {
    SceneDescription scene = test::sheet(24, 20, 0.6, 0.5, 3);
    scene.solver.method = method;
    scene.time.frame_count = twin_frames + 1;
    scene.gravity = {0, -2, 0.3};
    scene.wind.velocity = {0, 0, 4};
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 60, 20, 1e-5, 0.5};
    cloth.holes = {{{8, 6}, {12, 8}}};
    cloth.pins = {test::pin_box(0, 0, 23, 0), test::pin_box(0, 19, 23, 19), test::pin_box(23, 5, 23, 9)};
    cloth.pins[1].path.keys = {{0, {0, 0, 0}, {}}, {0.7, {0.1, -0.25, 0.1}, {0, 0, 15}}};
    cloth.tear = Tear{.strain = {}, .tension = 12};
    for (std::size_t cell = 0; cell < std::size_t{23} * 19; ++cell) {
        cloth.cell_stiffness.push_back(0.5f + 0.5f * static_cast<float>(cell % 11) / 10);
        cloth.cell_tear.push_back(0.7f + 0.1f * static_cast<float>(cell % 7));
    }
    scene.cloths.push_back(cloth);
    scene.cloths[1].name = "other";
    scene.cloths[1].placement.origin = {2, 0, 0};
    scene.cloths[1].holes.clear();
    scene.cloths[1].cell_stiffness.clear();
    scene.cloths[1].tear = Tear{.strain = 0.15, .tension = {}};
    return scene;
}

void expect_the_twins_bits(const SceneDescription& scene) {
    test::TwinWithCuts twin(scene);
    CutCounts device, expected;
    std::array<std::uint32_t, 2> events{};
    const FrameOptions options = positions_only();
    RunListener listener;
    listener.on_cut = [&](const CutEvent& event, const CutTopology& topology) {
        device.torn += event.counts.torn;
        device.triangles += event.counts.triangles;
        ++events[event.cloth];
        test::expect_consistent(topology);
    };
    FrameServer server(test::gpu().device, twin.model(), options, listener);
    server.run(
        twin_frames, always,
        [&](const FinishedFrame& frame) {
            if (testing::Test::HasFailure()) return;
            const CutCounts counts = twin.run_frame(frame.frame);
            expected.torn += counts.torn;
            expected.triangles += counts.triangles;
            std::string where;
            for (std::size_t cloth = 0; cloth < 2; ++cloth)
                ASSERT_TRUE(test::same_bits(texels(frame.positions[cloth]), twin.position(cloth), where))
                    << "frame " << frame.frame << ", cloth " << cloth << ": " << where;
        },
        [] { return testing::Test::HasFailure(); });
    std::printf("[ measured ] %u springs torn, %u triangles split, in %u and %u frames\n", device.torn,
                device.triangles, events[0], events[1]);
    EXPECT_EQ(device.torn, expected.torn);
    EXPECT_EQ(device.triangles, expected.triangles);
    EXPECT_GT(device.torn, 40u);
    for (const std::uint32_t each : events) EXPECT_GE(each, 3u) << "tears go on from frame to frame";
}

TEST_P(TornBy, TheTwinsBits) { expect_the_twins_bits(pulled_apart(GetParam())); }

TEST(TearTest, ClothThatRestsAsItStartsHasTheTwinsBits) {
    SceneDescription scene = pulled_apart(SolverMethod::line);
    for (Cloth& cloth : scene.cloths) {
        const double x = cloth.placement.origin[0];
        for (std::uint32_t row = 0; row < 20; ++row)
            for (std::uint32_t column = 0; column < 24; ++column)
                cloth.start.push_back(
                    {x + 0.026 * column, -0.026 * row, 0.01 * std::sin(0.9 * column) * std::cos(0.7 * row)});
        cloth.placement = {};
        cloth.rest = Rest::start;
        cloth.stiffness.bend = 1e-4;
    }
    expect_the_twins_bits(scene);
}

TEST(TearTest, ClothThatMeetsItselfHasTheTwinsBits) {
    SceneDescription scene = pulled_apart(SolverMethod::line);
    for (Cloth& cloth : scene.cloths) cloth.self_collision = SelfCollision{};
    expect_the_twins_bits(scene);
}

INSTANTIATE_TEST_SUITE_P(Methods, TornBy,
                         testing::Values(SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line),
                         [](const auto& method) { return std::string(named(method.param).name); });

TEST(TearTest, AutoTearsAndGoesOn) {
    SceneDescription scene = weighed_strip(SolverMethod::automatic, {9, 33}, 120);
    Cloth& cloth = scene.cloths[0];
    cloth.tear = Tear{.strain = {}, .tension = 6};
    add_seam(cloth, 20, 0.25f);
    const SimulationModel model(scene);
    std::uint32_t torn = 0, pieces = 0, attempts = 0, frames = 0;
    FrameOptions options = positions_only();
    options.statistics = true;
    RunListener listener;
    listener.on_cut = [&](const CutEvent& event, const CutTopology&) {
        torn += event.counts.torn;
        pieces = event.counts.pieces;
    };
    FrameServer server(test::gpu().device, model, options, listener);
    server.run(120, always, [&](const FinishedFrame& frame) {
        ++frames;
        attempts += frame.effort.attempts;
        if (frame.frame > 0) {
            EXPECT_LE(frame.statistics[0].stretch_error_rms, model.stretch_limits().rms) << frame.frame;
        }
    });
    EXPECT_EQ(frames, 121u);
    EXPECT_EQ(pieces, 2u);
    EXPECT_EQ(torn, 9u + 8u + 8u);
    EXPECT_LE(attempts, 3 * frames) << "a tear makes no frame begin again and again";
}

/// A cutter makes the nick that the tear begins at.
TEST(TearTest, ItGoesOnFromACut) {
    SceneDescription scene = weighed_strip(SolverMethod::line, {9, 33}, 120);
    scene.time.frame_count = 80;
    Cloth& cloth = scene.cloths[0];
    cloth.tear = Tear{.strain = {}, .tension = 3};
    Cutter cutter;  // from the left through three columns' springs, near the top
    cutter.triangle = {{{-1, -0.044, -1}, {0.03, -0.044, 0}, {-1, -0.044, 1}}};
    cutter.begin = cutter.end = 0;
    scene.cutters = {cutter};
    const TornOff torn = torn_off(scene);
    EXPECT_EQ(torn.pieces, 2u);
    EXPECT_EQ(torn.rows, std::vector<std::uint32_t>(9, 3));
}

TEST(TearTest, AClothThatHoldsHasTheBitsOfOneThatCannotTear) {
    SceneDescription holds = test::sheet(20, 20, 1, 1, 8);
    holds.time.frame_count = 20;
    holds.cloths[0].pins = {test::pin_top(holds.cloths[0])};
    const SceneDescription plain = holds;
    holds.cloths[0].tear = Tear{.strain = 5.0, .tension = {}};
    std::vector<std::vector<glsl::vec4>> bits;
    for (const SceneDescription& scene : {plain, holds}) {
        const SimulationModel model(scene);
        FrameServer server(test::gpu().device, model, positions_only());
        std::size_t k = 0;
        std::string where;
        server.run(19, always, [&](const FinishedFrame& frame) {
            if (scene.tears()) {
                EXPECT_TRUE(test::same_bits(texels(frame.positions[0]), bits[k++], where)) << k << ": " << where;
            } else {
                bits.push_back(texels(frame.positions[0]));
            }
        });
        EXPECT_EQ(server.graphs().pool().has("sheet/tear loads"), scene.tears());
        EXPECT_FALSE(server.graphs().pool().has("sheet/spring shares")) << "the image comes with the first tear";
        const auto& skipped = server.graphs().planned(server.graphs().contents(true, true)).graph.skipped();
        const auto search = std::ranges::find(skipped, "tear search", &graph::Remark::what);
        ASSERT_NE(search, skipped.end());
        EXPECT_EQ(search->reason,
                  scene.tears() ? "nothing tears in this kind of frame" : "no cloth of the scene tears");
    }
}

}  // namespace
}  // namespace drape
