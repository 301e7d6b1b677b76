// The benchmark's rows are complete, their names unique, and its evaluations see a wrong motion.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string_view>

#include "bench/measure.h"
#include "bench/problem.h"
#include "cloth/frame_steps.h"
#include "output/temporary_folder.h"
#include "reference/closed_forms.h"

namespace drape::bench {
namespace {

const Problem& named(const std::vector<Problem>& problems, std::string_view name) {
    for (const Problem& problem : problems)
        if (problem.name == name) return problem;
    throw std::runtime_error("no problem " + std::string(name));
}

TEST(ProblemsTest, EveryCaseHasANameOfItsOwnAndAModel) {
    for (const bool is_short : {false, true}) {
        std::set<std::string> names;
        for (const Problem& problem : all_problems(is_short))
            for (const Sweep& sweep : problem.sweeps) {
                for (const Setting& setting : sweep.settings) {
                    const std::string name = case_name(problem, sweep.size, setting);
                    EXPECT_TRUE(names.insert(name).second) << name;
                    EXPECT_GT(case_work({}, problem, sweep.size, setting), 0) << name;
                }
                SceneDescription scene = problem.scene(sweep.size, sweep.settings[0]);
                EXPECT_GT(scene.time.frame_count, 1u) << problem.name;
                if (sweep.size > 64) continue;  // building the large ones takes long
                scene.solver.method = sweep.settings[0].method;
                EXPECT_NO_THROW(SimulationModel{scene}) << problem.name;
            }
        EXPECT_TRUE(names.contains("swing/32/explicit/84"));
        EXPECT_EQ(names.contains("drum/256/relax/1x40"), !is_short);
    }
}

TEST(ProblemsTest, OrdersAreClaimedOfProblemsThatExist) {
    const std::vector<Problem> problems = all_problems(false);
    for (const OrderClaim& claim : order_claims()) {
        const Problem& problem = named(problems, claim.problem);
        bool is_there = false;
        for (const Sweep& sweep : problem.sweeps)
            for (const Setting& s : sweep.settings)
                is_there |= family_name(s.method, s.substeps, s.iterations) == claim.family &&
                            (claim.size == 0 || claim.size == sweep.size);
        EXPECT_TRUE(is_there) << claim.problem << " " << claim.family << " " << claim.size;
    }
}

struct Evaluated {
    Metrics exact, wrong;
};

/// Evaluates a run whose samples are the reference's own states, `offset` m off.
Evaluated evaluated(const std::string& name, std::uint32_t size, double offset) {
    const TemporaryFolder folder;
    References references(folder.path(), [](const std::string&) {}, {});
    const std::vector<Problem> problems = all_problems(true);
    const Problem& problem = named(problems, name);
    SceneDescription scene = problem.scene(size, {SolverMethod::relax, 1, 1});
    const SpringNetwork network(scene, 0);
    std::vector<double> times;
    for (std::uint32_t frame = problem.record_every; frame < scene.time.frame_count; frame += problem.record_every)
        times.push_back(frame / scene.time.fps);
    const bool is_motion = problem.record_every < scene.time.frame_count - 1;
    const ReferenceRun& reference = is_motion ? references.motion(network, times) : references.equilibrium(network);
    Recording exact{scene, {{0, network.rest_position, {}}}};
    for (std::size_t k = 0; k < times.size(); ++k)
        exact.samples.push_back({static_cast<std::uint32_t>((k + 1) * problem.record_every),
                                 reference.states[is_motion ? k : 0].position,
                                 {}});
    Recording wrong = exact;
    for (Sample& sample : wrong.samples)
        for (Vec3& x : sample.position) x[2] += offset;
    const std::size_t computed = references.computed_count();
    Evaluated result{problem.evaluate(exact, references), problem.evaluate(wrong, references)};
    EXPECT_EQ(references.computed_count(), computed) << "the same reference twice";
    References again(folder.path(), [](const std::string&) {}, {});
    EXPECT_EQ(problem.evaluate(exact, again), result.exact);
    EXPECT_EQ(again.computed_count(), 0u) << "the reference is on disk";
    return result;
}

TEST(ProblemsTest, TheReferenceItselfHasNoErrorAndAnOffsetHasItsOwn) {
    for (const char* name : {"swing", "drum", "drape", "strip"}) {
        const Evaluated result = evaluated(name, 8, 0.01);
        EXPECT_EQ(result.exact.at("position_rms"), 0) << name;
        EXPECT_NEAR(result.wrong.at("position_rms"), 0.01, 1e-12) << name;
        EXPECT_EQ(result.exact.at("strain_difference"), 0) << name;
        EXPECT_GT(result.exact.at("stretch_rms"), 1e-4) << name;
        EXPECT_NEAR(result.exact.at("stretch_rms"), result.exact.at("stretch_rms_reference"), 1e-15) << name;
        EXPECT_LT(result.exact.at("reference_error"), 1e-4) << name;
    }
}

TEST(ProblemsTest, ThePendulumsPeriodIsTheClosedFormsButForItsSpring) {
    const Evaluated result = evaluated("pendulum", 1, 0);
    EXPECT_EQ(result.exact.at("period_error"), 0);
    EXPECT_EQ(result.exact.at("energy_lost_per_period"), 0);
    EXPECT_NEAR(result.exact.at("period"), closed_forms::pendulum_period(1, 9.81, M_PI / 2), 0.0025);
}

TEST(ProblemsTest, AFallIsMeasuredAgainstTheClosedForm) {
    const std::vector<Problem> problems = all_problems(true);
    const Problem& problem = named(problems, "free fall");
    const SceneDescription scene = problem.scene(2, {});
    const Cloth& cloth = scene.cloths[0];
    const TemporaryFolder folder;
    References references(folder.path(), [](const std::string&) {}, {});
    Recording run{scene, {{0, {{0, 0, 0}}, {}}, {600, {{}}, {}}}};
    for (std::size_t k = 0; k < 3; ++k)
        run.samples[1].position[0][k] =
            closed_forms::flight_displacement(cloth.velocity[k], scene.gravity[k], cloth.damping, 10);
    EXPECT_EQ(problem.evaluate(run, references).at("position_relative"), 0);
    run.samples[1].position[0][0] += 0.1;
    EXPECT_NEAR(problem.evaluate(run, references).at("position_rms"), 0.1, 1e-12);
}

}  // namespace
}  // namespace drape::bench
