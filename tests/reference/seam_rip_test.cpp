// Seams that rip, by the twin, against Newton's laws: what a seam bears is what it moves, and no momentum is made where
// it comes apart.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "sewn_measures.h"
#include "support/sewn_scenes.h"
#include "twin/twin_loop.h"

namespace drape {
namespace {

using namespace test;

constexpr double width = 0.2, growth = 3, upper_mass = 0.5 * 0.2 * 0.3, lower_mass = 0.2 * 0.2 * 0.2;

class SeamRip : public testing::TestWithParam<SolverMethod> {};

SeamStatistics seams_of(const SimulationModel& model, const Twin& twin, std::size_t cloth) {
    return seam_statistics(model.cloths[cloth], twin.cloth(cloth).bytes(Field::seam_loads));
}

std::uint32_t substeps_of(SolverMethod method) { return method == SolverMethod::explicit_steps ? 64 : 12; }

/// Tells what a run of the strip shows.
struct Ripped {
    double load = 0;      ///< N/m: the largest before
    double expected = 0;  ///< N/m: in closed form, in the middle of the frame in which it rips
    std::uint32_t places = 0, frame = 0;

    /// Takes what the seam bears at a frame's end; returns whether it has ripped.
    bool take(const SeamStatistics& seams, std::uint32_t now) {
        if (seams.ripped == 0) {
            load = seams.load;
            return false;
        }
        places = seams.ripped, frame = now;
        // The whole strip accelerates, and the seam moves the upper panel.
        expected = growth * (now - 0.5) / 60 * upper_mass / (upper_mass + lower_mass) / width;
        return true;
    }
    void expect(const std::string& by, double rip) const {
        std::printf("[ measured ] %s: a seam of %.3g N/m rips at %.4g N/m, in frame %u\n", by.c_str(), rip, expected,
                    frame);
        EXPECT_NEAR(expected, rip, 0.01 * rip);
        EXPECT_LE(load, rip);
        EXPECT_EQ(places, 9u) << "all of it at once";
    }
};

/// The seam moves the upper panel alone, which is heavier than the lower one: of two panels of unlike mass it bears
/// neither the force on the lower one nor half of it.
TEST_P(SeamRip, APulledStripRipsAtTheStatedLoad) {
    const double rip = 15;
    const SimulationModel model(
        with_method(pulled_strip(GetParam(), growth, rip), GetParam(), substeps_of(GetParam())));
    Twin twin(model);
    Ripped found;
    for (std::uint32_t frame = 1; frame <= 150 && found.frame == 0; ++frame) {
        twin.run_frame(frame);
        found.take(seams_of(model, twin, 0), frame);
        EXPECT_EQ(seams_of(model, twin, 0).ripped, seams_of(model, twin, 1).ripped);
    }
    found.expect(name_of(GetParam()), rip);
}

TEST(SeamRipAuto, APulledStripRipsAtTheStatedLoad) {
    const double rip = 15;
    const SimulationModel model(pulled_strip(SolverMethod::automatic, growth, rip));
    TwinLoop loop(model);
    Ripped found;
    loop.run(120, [&](std::uint32_t frame, const Twin& twin, const FrameEffort&) {
        if (found.frame == 0) found.take(seams_of(model, twin, 0), frame);
    });
    found.expect("auto", rip);
}

/// Two panels that fly apart rip off each other. Nothing from outside acts, so their momentum stays; what has come
/// apart does not come together.
TEST_P(SeamRip, MomentumIsKeptAndPlacesPart) {
    SceneDescription scene = with_method(pulled_strip(GetParam(), 0, 2), GetParam(), substeps_of(GetParam()));
    scene.cloths[0].velocity = {0.2, 1, 0.3};
    scene.cloths[1].velocity = {-0.1, -2, 0};
    for (Cloth& cloth : scene.cloths) cloth.stiffness.shear = 100;
    const SimulationModel model(scene);
    Twin twin(model);
    std::uint32_t ripped = 0;
    for (std::uint32_t frame = 1; frame <= 30; ++frame) {
        twin.run_frame(frame);
        EXPECT_GE(seams_of(model, twin, 0).ripped, ripped);
        ripped = seams_of(model, twin, 0).ripped;
    }
    ASSERT_EQ(ripped, 9u);
    const Momenta all = momenta_of(model, twin);
    const Vec3 linear = plus(times(upper_mass, scene.cloths[0].velocity), times(lower_mass, scene.cloths[1].velocity));
    const double error = length(minus(all.linear, linear)) / (all.mass * 1);
    const double gap = length(minus(place_of(twin.cloth(0), std::size_t{12} * 9 + 4), place_of(twin.cloth(1), 4)));
    std::printf("[ measured ] %s: momentum off by %.1e of mass times 1 m/s, the panels are %.3g m apart\n",
                name_of(GetParam()).c_str(), error, gap);
    EXPECT_LT(error, 2e-6);
    EXPECT_GT(gap, 0.1);
    for (std::size_t k = 0; k < 9; ++k) {
        EXPECT_EQ(twin.cloth(0)[Field::position][std::size_t{12} * 9 + k].w, k % 8 == 0 ? 4 : 2) << "a border's again";
        EXPECT_EQ(twin.cloth(1)[Field::position][k].w, k % 8 == 0 ? 4 : 2);
    }
}

/// A seam that is pulled at one end opens from there on, place by place, and bears more at the next one each time.
TEST_P(SeamRip, AnEndThatIsPulledOpensPlaceByPlace) {
    const SimulationModel model(with_method(opening_seam(GetParam(), 12), GetParam(), substeps_of(GetParam())));
    Twin twin(model);
    std::uint32_t before = 0, steps = 0;
    for (std::uint32_t frame = 1; frame <= 90; ++frame) {
        twin.run_frame(frame);
        std::uint32_t ripped = 0;
        bool from_end = true;
        for (std::size_t column = 0; column < 33; ++column) {
            const glsl::vec4& load = twin.cloth(0)[Field::seam_loads][std::size_t{8} * 33 + column];
            if (load.w == 0) from_end = false;
            if (load.w != 0) ++ripped;
            EXPECT_TRUE(load.w == 0 || from_end) << "from the left end, frame " << frame;
        }
        if (ripped > before) ++steps;
        before = ripped;
    }
    std::printf("[ measured ] %s: %u places in %u frames\n", name_of(GetParam()).c_str(), before, steps);
    EXPECT_EQ(before, 33u);
    EXPECT_GT(steps, 20u);
}

INSTANTIATE_TEST_SUITE_P(Methods, SeamRip,
                         testing::Values(SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps),
                         [](const auto& each) {
                             return each.param == SolverMethod::explicit_steps ? "Explicit" : name_of(each.param);
                         });

}  // namespace
}  // namespace drape
