// What frames tell of each spring and each particle, by named methods and by auto: tensions against the weight below
// and the pins' forces, contact forces against the weight above and the colliders' forces, and springs that blades cut.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "drape/ensemble.h"
#include "library_device.h"
#include "support/force_scenes.h"

namespace drape {
namespace {

using test::expect_near;
using test::level_sheet;
using test::library_device;

constexpr int offsets[4][2] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}};

/// A frame's arrays of a cloth.
struct FieldsOfFrame {
    explicit FieldsOfFrame(const Simulation& simulation, std::size_t cloth = 0)
        : columns(simulation.scene().cloths[cloth].grid[0]),
          rows(simulation.scene().cloths[cloth].grid[1]),
          statistics(simulation.frame().statistics[cloth]) {
        const FinishedFrame& frame = simulation.frame();
        const auto copy = [](std::span<const float> from) { return std::vector<float>(from.begin(), from.end()); };
        positions = copy(frame.positions[cloth]);
        tensions = copy(frame.tensions.at(cloth));
        contacts = copy(frame.contact_forces.at(cloth));
        springs = simulation.spring_bits(cloth);
    }

    Vec3 place(std::size_t particle) const {
        const float* const at = &positions[4 * particle];
        return {double{at[0]}, double{at[1]}, double{at[2]}};
    }
    double tension(std::size_t particle, std::size_t direction) const {
        return double{tensions[4 * particle + direction]};
    }
    /// Returns the force that the springs give to the particles for which `is` holds, by the others.
    template <class Is>
    Vec3 pull_on(const Is& is) const {
        Vec3 sum{};
        for (std::size_t row = 0; row < rows; ++row)
            for (std::size_t column = 0; column < columns; ++column)
                for (std::size_t k = 0; k < 4; ++k) {
                    const std::size_t here = row * columns + column, y = row + std::size_t(offsets[k][1]);
                    if ((springs[here] >> k & 1) == 0) continue;
                    const std::size_t x = column + std::size_t(offsets[k][0]), there = y * columns + x;
                    const bool own = is(column, row), other = is(x, y);
                    if (own == other) continue;
                    const Vec3 edge = minus(place(there), place(here));
                    const double along = (own ? 1 : -1) * tension(here, k) / length(edge);
                    sum = plus(sum, times(along, edge));
                }
        return sum;
    }
    Vec3 touched() const {
        Vec3 sum{};
        for (std::size_t i = 0; i < contacts.size(); ++i)
            if (i % 4 != 3) sum[i % 4] += double{contacts[i]};
        return sum;
    }
    Vec3 force(const std::string& by) const {
        for (const ForceOnCloth& each : statistics.forces)
            if (each.by == by) return each.force;
        ADD_FAILURE() << "no force by " << by;
        return {};
    }
    double weight() const { return 9.81 * statistics.mass; }

    std::size_t columns, rows;
    ClothStatistics statistics;
    std::vector<float> positions, tensions, contacts;
    std::vector<std::uint8_t> springs;
};

/// Returns a scene that tells fields, by a method with so many substeps.
SceneDescription with_fields(SceneDescription scene, SolverMethod method, std::uint32_t substeps, std::uint32_t last) {
    scene = test::by_method(scene, method, substeps);
    if (method == SolverMethod::automatic) scene.solver = {};
    scene.forces = scene.worst_forces = scene.force_fields = true;
    scene.time.frame_count = last + 1;
    return scene;
}

/// Runs such a scene to its last frame.
FieldsOfFrame last_frame(const SceneDescription& scene, SolverMethod method, std::uint32_t substeps,
                         std::uint32_t last) {
    Simulation simulation(with_fields(scene, method, substeps, last), {}, library_device());
    while (simulation.step()) {
    }
    return FieldsOfFrame(simulation);
}

class ForceFieldsTest : public test::LibraryTest, public testing::WithParamInterface<SolverMethod> {};

/// Cloth so soft and heavy that rounded positions tell its strain, some hundredths, to 1e-5 of it.
SceneDescription hanging_strip() {
    SceneDescription scene = test::sheet(4, 13, 0.12, 0.48, 8);
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 60, 20, 0};
    cloth.areal_density = 1;
    cloth.damping = 12;
    cloth.pins = {test::pin_top(cloth)};
    return scene;
}

TEST_P(ForceFieldsTest, AHangingStripBearsTheWeightBelow) {
    const FieldsOfFrame frame =
        last_frame(hanging_strip(), GetParam(), GetParam() == SolverMethod::relax ? 400 : 24, 120);
    double worst = 0;
    for (std::size_t row = 1; row < frame.rows; ++row) {
        const double below = (static_cast<double>(frame.rows - row) - 0.5) / static_cast<double>(frame.rows - 1);
        const Vec3 pull = frame.pull_on([&](std::size_t, std::size_t y) { return y >= row; });
        worst = std::max(worst, length(minus(pull, {0, below * frame.weight(), 0})) / frame.weight());
    }
    std::printf("[ measured ] springs across a strip: off by %.1e of its weight at most\n", worst);
    EXPECT_LT(worst, 1e-4);
}

TEST_P(ForceFieldsTest, AtItsEndACatenaryBearsWhatThePinsGive) {
    const FieldsOfFrame frame =
        last_frame(test::catenary(), GetParam(), GetParam() == SolverMethod::relax ? 600 : 24, 240);
    const double link = frame.weight() / test::catenary_links;
    for (const std::size_t end : {std::size_t{0}, frame.columns - 1}) {
        const Vec3 pull = frame.pull_on([&](std::size_t x, std::size_t) { return x == end; });
        const Vec3 held{0, 0.5 * link, 0};  // a pin also bears the half link that it holds
        expect_near(minus(held, pull), frame.force(end == 0 ? "pins_0" : "pins_1"), 1e-4, "an end's springs");
    }
}

/// A sheet lies on another, and that on a box.
TEST_P(ForceFieldsTest, ASheetBearsTheOneOnIt) {
    SceneDescription scene = level_sheet(0.1042, 12);
    scene.cloths[0].self_collision = SelfCollision{0.004, {}};
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "upper";
    scene.cloths[1].placement.origin[1] += 0.0042;
    scene.colliders = {{Box{{0, 0, 0}, {0.5, 0.1, 0.5}}, 0.5}};
    scene = with_fields(scene, GetParam(), 8, 40);
    Simulation simulation(scene, {}, library_device());
    while (simulation.step()) {
    }
    const FieldsOfFrame lower(simulation), upper(simulation, 1);
    const Vec3 weight{0, upper.weight(), 0};
    expect_near(upper.touched(), weight, 1e-4, "contact forces of the upper sheet");
    expect_near(upper.touched(), upper.force("other_cloths"), 1e-5, "the lower one's force");
    expect_near(lower.touched(), weight, 1e-4, "contact forces of the lower one");
    expect_near(lower.touched(), plus(lower.force("collider_0_box"), lower.force("other_cloths")), 1e-5, "both");
}

TEST_P(ForceFieldsTest, ContactForcesAreTheWeightAndTheCollidersForce) {
    SceneDescription scene = level_sheet(0.105, 3);
    scene.colliders = {{Plane{{0, 1, 0}, -1}, 0.5}, {Box{{0, 0, 0}, {0.5, 0.1, 0.5}}, 0.5}};
    const FieldsOfFrame frame = last_frame(scene, GetParam(), 8, 120);
    expect_near(frame.touched(), {0, frame.weight(), 0}, 1e-4, "contact forces of a sheet on a box");
    expect_near(frame.touched(), frame.force("collider_1_box"), 1e-6, "the box's force");
    // Corners bear a quarter of what inner particles do.
    EXPECT_NEAR(double{frame.contacts[1]}, frame.weight() / 64 / 4, 1e-3 * frame.weight() / 64);
    EXPECT_NEAR(double{frame.contacts[4 * 40 + 1]}, frame.weight() / 64, 1e-3 * frame.weight() / 64);
}

/// Cloth in motion over several colliders, some of whose particles touch two of them.
TEST_P(ForceFieldsTest, ContactForcesAddUpToThoseOfAllColliders) {
    SceneDescription scene = level_sheet(0.105, 3);
    scene.cloths[0].velocity = {1.5, -2, 0.5};
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 0)};
    scene.colliders = {
        {Plane{}, 0.4}, {Box{{0.1, 0, 0}, {0.1, 0.1, 0.1}}, 0.4, {10, 30, 0}}, {Sphere{{-0.1, 0, 0.1}, 0.1}, 0.4}};
    for (const std::uint32_t last : {1u, 4u, 12u}) {
        const FieldsOfFrame frame = last_frame(scene, GetParam(), 8, last);
        Vec3 all{};
        for (const ForceOnCloth& each : frame.statistics.forces)
            if (each.moment) all = plus(all, each.force);
        expect_near(frame.touched(), all, 2e-6, "the colliders' forces");
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, ForceFieldsTest,
                         testing::Values(SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps,
                                         SolverMethod::automatic),
                         [](const auto& each) { return std::string(named(each.param).name); });

using ForceFieldsOnceTest = test::LibraryTest;

TEST_F(ForceFieldsOnceTest, NobodyHasThemUnasked) {
    SceneDescription scene = level_sheet(0.105, 3);
    scene.colliders = {{Plane{}, 0.4}};
    scene.time.frame_count = 4;
    const auto skips = [](const Simulation& simulation) {
        return simulation.describe_plan("text").find("readback of tensions and contact forces") != std::string::npos;
    };
    Simulation plain(scene, {}, library_device());
    scene.forces = scene.worst_forces = scene.force_fields = true;
    Simulation asked(scene, {}, library_device()), unseen(scene, {.positions = false}, library_device());
    EXPECT_TRUE(skips(plain) && skips(unseen));
    EXPECT_FALSE(skips(asked));
    while (plain.step()) {
        ASSERT_TRUE(asked.step() && unseen.step());
        EXPECT_TRUE(plain.frame().tensions.empty() && plain.frame().contact_forces.empty());
        EXPECT_TRUE(unseen.frame().tensions.empty());
        EXPECT_EQ(asked.frame().tensions.size(), 1u);
        EXPECT_TRUE(std::ranges::equal(plain.frame().positions[0], asked.frame().positions[0]));
    }
}

TEST_F(ForceFieldsOnceTest, SavedStatesHaveThem) {
    for (const SolverMethod method : test::all_methods) {
        SceneDescription scene = test::by_method(hanging_strip(), method, 8);
        scene.colliders = {{Sphere{{0.06, -0.25, -0.05}, 0.1}, 0.4}};
        scene.forces = scene.force_fields = true;
        scene.time.frame_count = 8;
        Simulation whole(scene, {}, library_device()), rest(scene, {}, library_device());
        for (int frame = 0; frame < 4; ++frame) whole.step();
        rest.restore(whole.save());
        while (whole.step()) {
            ASSERT_TRUE(rest.step());
            EXPECT_TRUE(std::ranges::equal(whole.frame().tensions[0], rest.frame().tensions[0]));
            EXPECT_TRUE(std::ranges::equal(whole.frame().contact_forces[0], rest.frame().contact_forces[0]));
        }
    }
}

/// Members of ensembles have those of their scenes alone.
TEST_F(ForceFieldsOnceTest, MembersHaveThem) {
    for (const SolverMethod method : test::all_methods) {
        SceneDescription scene = test::by_method(hanging_strip(), method, 8);
        scene.colliders = {{Sphere{{0.06, -0.25, -0.05}, 0.1}, 0.4}};
        scene.forces = scene.force_fields = true;
        scene.time.frame_count = 5;
        std::vector<SceneDescription> scenes(3, scene);
        for (std::size_t k = 0; k < 3; ++k) scenes[k].gravity[2] = 0.5 * static_cast<double>(k);
        Ensemble ensemble(scenes, {}, library_device());
        for (int frame = 1; frame < 5; ++frame) ensemble.step();
        const MemberArray tensions = ensemble.tensions(0), contacts = ensemble.contact_forces(0);
        ASSERT_EQ(tensions.members, 3u);
        for (std::size_t k = 0; k < 3; ++k) {
            Simulation alone(scenes[k], {}, library_device());
            while (alone.step()) {
            }
            const auto same = [&](const MemberArray& all, std::span<const float> own) {
                return std::ranges::equal(std::span(all.data + k * all.member_stride, 4 * all.rows * all.columns), own);
            };
            EXPECT_TRUE(same(tensions, alone.frame().tensions[0])) << named(method).name << k;
            EXPECT_TRUE(same(contacts, alone.frame().contact_forces[0])) << named(method).name << k;
        }
    }
    EXPECT_THROW(Ensemble({hanging_strip(), hanging_strip()}, {}, library_device()).tensions(0), Error);
}

/// Rigid springs have no law, and relaxation keeps no multiplier of them.
TEST_F(ForceFieldsOnceTest, WhatNobodyKnowsIsNoNumber) {
    SceneDescription scene = level_sheet(0, 3);
    scene.cloths[0].stiffness.rigid = true;
    const FieldsOfFrame frame = last_frame(scene, SolverMethod::relax, 4, 2);
    EXPECT_TRUE(std::isnan(frame.tensions[0]));
    EXPECT_EQ(frame.tensions[4 * 80], 0) << "the last particle is the first of no spring";
}

int count(const std::vector<std::uint8_t>& springs) {
    return std::accumulate(springs.begin(), springs.end(), 0,
                           [](int sum, std::uint8_t bits) { return sum + std::popcount(bits); });
}

TEST_F(ForceFieldsOnceTest, SpringsThatAreCutAreGone) {
    for (const SolverMethod method : test::all_methods) {
        SceneDescription scene = test::by_method(hanging_strip(), method, 12);
        scene.forces = scene.force_fields = true;
        scene.time.frame_count = 60;
        Cutter blade;
        blade.triangle = {{{-1, -0.26, -1}, {2, -0.26, -1}, {0, -0.26, 2}}};
        blade.begin = blade.end = 0.05;
        scene.cutters = {blade};
        std::vector<Cut> cuts;
        Simulation simulation(scene, {.on_cut = [&](const Cut& cut) { cuts.push_back(cut); }}, library_device());
        simulation.step();
        const int before = count(simulation.spring_bits(0));
        EXPECT_EQ(before, 3 * 13 + 4 * 12 + 2 * 3 * 12);
        while (simulation.step()) {
        }
        ASSERT_EQ(cuts.size(), 1u);
        const FieldsOfFrame frame(simulation);
        EXPECT_EQ(cuts[0].spring_bits, frame.springs);
        EXPECT_EQ(before - count(frame.springs), static_cast<int>(cuts[0].springs));
        EXPECT_EQ(cuts[0].springs, 10u) << "four threads and six diagonals, or more where they lie across the blade";
        for (std::size_t k = 0; k < frame.tensions.size(); ++k) {
            const bool is_there = (frame.springs[k / 4] >> (k % 4) & 1) != 0;
            EXPECT_TRUE(is_there || frame.tensions[k] == 0) << k;
        }
    }
}

/// Cloth that tears says so, too.
TEST_F(ForceFieldsOnceTest, SpringsThatTearAreGone) {
    SceneDescription scene = test::by_method(hanging_strip(), SolverMethod::line, 12);
    scene.forces = scene.force_fields = true;
    scene.time.frame_count = 40;
    Tear tear;
    tear.tension = 2;  // N/m, of the 4.7 that the strip's weight comes to
    scene.cloths[0].tear = tear;
    std::uint32_t ended = 0;
    Simulation simulation(scene, {.on_cut = [&](const Cut& cut) { ended += cut.springs; }}, library_device());
    simulation.step();
    const int before = count(simulation.spring_bits(0));
    while (simulation.step()) {
    }
    EXPECT_GT(ended, 0u);
    EXPECT_EQ(before - count(simulation.spring_bits(0)), static_cast<int>(ended));
}

}  // namespace
}  // namespace drape
