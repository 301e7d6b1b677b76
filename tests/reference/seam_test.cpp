// Sewn cloth, by the twin, against what nobody tuned: the network in double precision in which a sewn particle is one,
// the plain sheet, and what nothing from outside can change.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/vectors.h"
#include "reference/implicit_reference.h"
#include "reference/sewn_network.h"
#include "sewn_measures.h"
#include "support/sheets.h"

namespace drape {
namespace {

using namespace test;

/// A tube of one cloth, 0.2 m wide, that hangs from its upper rim and is thrown sideways.
SceneDescription tube(std::uint32_t around, std::uint32_t down) {
    const double length = 0.64, height = 0.5;
    SceneDescription scene = test::sheet(around + 1, down + 1, length, height, 8);
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 1000, 100, 1e-4};
    cloth.pins = {test::pin_top(cloth)};
    cloth.velocity = {0.1, 0, 0.04};  // one that is thrown harder crumples, and ends elsewhere by any error
    const double radius = length / around / (2 * std::sin(std::numbers::pi / around));
    for (std::uint32_t row = 0; row <= down; ++row)
        for (std::uint32_t column = 0; column <= around; ++column) {
            const double angle = 2 * std::numbers::pi * (column % around) / around;
            cloth.start.push_back({radius * std::cos(angle), -height * row / down, radius * std::sin(angle)});
        }
    cloth.placement = {};
    scene.seams = {{{cloth.name, SeamEdge::left}, {cloth.name, SeamEdge::right}}};
    return scene;
}

/// Returns how far a run is from the network's motion after so many frames, RMS over the network's particles.
double distance_from(const std::vector<Vec3>& exact, const SewnNetwork& sewn, const Twin& twin) {
    double squares = 0;
    std::vector<bool> seen(exact.size());
    for (std::size_t cloth = 0; cloth < sewn.particle.size(); ++cloth)
        for (std::size_t i = 0; i < sewn.particle[cloth].size(); ++i) {
            const std::uint32_t at = sewn.particle[cloth][i];
            if (seen[at]) continue;
            seen[at] = true;
            const Vec3 way = minus(place_of(twin.cloth(cloth), i), exact[at]);
            squares += dot(way, way);
        }
    return std::sqrt(squares / static_cast<double>(exact.size()));
}

double distance_after(const SceneDescription& scene, const std::vector<Vec3>& exact, const SewnNetwork& sewn,
                      std::uint32_t frames) {
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= frames; ++frame) twin.run_frame(frame);
    return distance_from(exact, sewn, twin);
}

std::vector<Vec3> exact_after(const SewnNetwork& sewn, double seconds) {
    const double times[] = {seconds};
    return implicit_states(sewn.network, times, 5e-4).front().position;
}

TEST(Seam, LinesConvergeToTheNetworkWithSharedParticles) {
    constexpr std::uint32_t frames = 12;
    for (const SceneDescription& scene : {halves(24, true), halves(24, false), tube(24, 16)}) {
        const SewnNetwork sewn = sewn_network(scene);
        const std::vector<Vec3> exact = exact_after(sewn, frames / 60.0);
        double before = 1;
        for (const std::uint32_t substeps : {8u, 16u, 32u}) {
            const double off = distance_after(with_method(scene, SolverMethod::line, substeps), exact, sewn, frames);
            std::printf("[ measured ] line, %u substeps: %.3f mm\n", substeps, 1000 * off);
            EXPECT_LT(off, before / 1.5) << substeps;
            before = off;
        }
        EXPECT_LT(before, 2e-4) << "m";
    }
}

TEST(Seam, RelaxationConvergesToTheNetwork) {
    constexpr std::uint32_t frames = 12;
    const SceneDescription scene = halves(8, true);
    const SewnNetwork sewn = sewn_network(scene);
    const std::vector<Vec3> exact = exact_after(sewn, frames / 60.0);
    double before = 1;
    for (const std::uint32_t substeps : {64u, 128u, 256u}) {
        const double off = distance_after(with_method(scene, SolverMethod::relax, substeps), exact, sewn, frames);
        std::printf("[ measured ] relax, %u substeps: %.3f mm\n", substeps, 1000 * off);
        EXPECT_LT(off, before / 1.5) << substeps;
        before = off;
    }
}

TEST(Seam, ExplicitStepsOfHalvesAreThoseOfTheSheet) {
    constexpr std::uint32_t frames = 18;
    const auto limp = [](SceneDescription scene) {  // bending ends at a seam
        for (Cloth& cloth : scene.cloths) cloth.stiffness.bend = 0;
        return with_method(std::move(scene), SolverMethod::explicit_steps, 64);
    };
    const SimulationModel plain(limp(plain_sheet(16))), model(limp(halves(16, true)));
    Twin sheet(plain), twin(model);
    for (std::uint32_t frame = 1; frame <= frames; ++frame) {
        sheet.run_frame(frame);
        twin.run_frame(frame);
    }
    double farthest = 0;
    for (std::size_t i = 0; i < 17 * 17; ++i) {
        const std::size_t row = i / 17, in_other = i - 17 * 8;
        const Vec3 sewn = row <= 8 ? place_of(twin.cloth(0), i) : place_of(twin.cloth(1), in_other);
        farthest = std::max(farthest, length(minus(sewn, place_of(sheet.cloth(0), i))));
    }
    std::printf("[ measured ] halves by explicit steps: %.2g m from the sheet\n", farthest);
    EXPECT_LT(farthest, 1e-4);
}

TEST(Seam, FreeClothKeepsItsMomentum) { expect_kept_momentum(halves(12, true)); }

/// The sides of a seam take steps of one order, also through a cloth between them: where one crumples so that it
/// cannot follow in second order, and the others could, nothing from outside changes their momentum either.
TEST(Seam, FreeClothOfWhichOnePartCrumplesKeepsItsMomentum) {
    for (const std::size_t crumpled : {0u, 1u, 2u}) {
        SceneDescription scene = with_method(halves(12, true), SolverMethod::line, 8);
        scene.gravity = {};
        scene.cloths[0].pins.clear();
        Cloth third = scene.cloths[1];
        third.name = "third";
        third.placement.origin[2] += 0.5;
        third.areal_density = 0.3;
        scene.cloths.push_back(third);
        scene.seams.push_back({{"other", SeamEdge::bottom}, {"third", SeamEdge::top}});
        scene.cloths[crumpled].placement.jitter = 0.08;
        const SimulationModel model(scene);
        Twin twin(model);
        double most = 0;
        for (std::uint32_t frame = 1; frame <= 30; ++frame) {
            twin.run_frame(frame);
            most = std::max(most, length(momenta_of(model, twin).linear));
        }
        EXPECT_GT(kinetic_energy(model, twin), 0.01) << "J: it moves by what strained it";
        std::printf("[ measured ] crumpled %zu: momentum of %.1e kg m/s\n", crumpled, most);
        EXPECT_LT(most, 2e-6) << "kg m/s";
    }
}

TEST(Seam, AFollowerOfAHeldLeaderIsHeldAndOneThatIsLetGoIsFree) {
    SceneDescription scene = with_method(halves(8, true), SolverMethod::line, 8);
    Pin released = test::pin_box(4, 0, 4, 0);
    released.release = 0.05;
    scene.cloths[0].pins = {test::pin_box(0, 4, 0, 4)};
    scene.cloths[1].pins = {released};
    const SimulationModel model(scene);
    Twin twin(model);
    const auto weight = [&](std::size_t cloth, std::size_t i) { return twin.cloth(cloth)[Field::position][i].w; };
    const Vec3 start = place_of(twin.cloth(1), 0);
    for (std::uint32_t frame = 1; frame <= 2; ++frame) twin.run_frame(frame);
    EXPECT_EQ(weight(0, 4 * 9 + 4), 0.0f) << "the leader of a held follower";
    for (std::uint32_t frame = 3; frame <= 12; ++frame) twin.run_frame(frame);
    EXPECT_EQ(place_of(twin.cloth(1), 0), start) << "the follower of a held leader";
    EXPECT_EQ(weight(1, 0), 0.0f);
    EXPECT_EQ(weight(0, 4 * 9 + 4), 1.0f);
    EXPECT_EQ(weight(1, 4), 1.0f) << "both have the mass of both";
}

/// Cloth never has more than the energy of its strained start and of its fall, whose most is that of a metre.
TEST(Seam, FortyBadStartsDoNotBlowUp) {
    double most = 0;
    for (const SolverMethod method : {SolverMethod::line, SolverMethod::relax})
        for (const bool across : {true, false})
            for (std::uint32_t seed = 0; seed < 20; ++seed) {
                SceneDescription scene = with_method(halves(12, across), method, 2 + seed % 6);
                for (Cloth& cloth : scene.cloths) {
                    cloth.placement.jitter = 0.08;
                    cloth.placement.seed = seed + (&cloth == scene.cloths.data() ? 0 : 100);
                }
                const SimulationModel model(scene);
                Twin twin(model);
                const SewnNetwork sewn = sewn_network(scene);
                std::vector<Vec3> start(sewn.network.particle_count());
                for (std::size_t cloth = 0; cloth < 2; ++cloth)
                    for (std::size_t i = 0; i < sewn.particle[cloth].size(); ++i)
                        start[sewn.particle[cloth][i]] = place_of(twin.cloth(cloth), i);
                const double given =
                    sewn.network.spring_energy(start) + sewn.network.bending_energy(start) + 0.2 * 9.81 * 1;
                for (std::uint32_t frame = 1; frame <= 40; ++frame) {
                    twin.run_frame(frame);
                    const double part = kinetic_energy(model, twin) / given;
                    most = std::max(most, part);
                    ASSERT_LT(part, 1) << named(method).name << ", seed " << seed << ", frame " << frame;
                }
            }
    std::printf("[ measured ] 80 bad starts: at most %.2f of their energy is kinetic\n", most);
}

}  // namespace
}  // namespace drape
