// The stability benchmark has the right cases, and its judge sees what is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "bench/stability_judge.h"
#include "bench/stability_result.h"

namespace drape::bench {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(StabilityCases, ExtremesAloneAreReadOrRefusedAsTheirTierSays) {
    std::set<std::string> names;
    for (const StabilityCase& each : stability_cases({.is_short = true})) {
        EXPECT_TRUE(names.insert(each.name).second) << each.name;
        const SceneResult result = scene_of(each);
        if (each.tier != Tier::refused) {
            EXPECT_TRUE(result.scene.has_value()) << each.name << ": " << result.errors.front().text();
        }
    }
}

TEST(StabilityCases, AllPairsOfDifferentAxesByEveryMethod) {
    std::size_t pairs = 0;
    for (const StabilityCase& each : stability_cases({})) {
        if (!each.name.starts_with("pair/")) continue;
        ++pairs;
        ASSERT_EQ(each.extremes.size(), 2u);
        EXPECT_STRNE(extremes()[each.extremes[0]].axis, extremes()[each.extremes[1]].axis);
        EXPECT_EQ(each.tier, Tier::bounded);
    }
    EXPECT_GT(pairs, 1100u * solver_method_names.size());
}

TEST(StabilityCases, MixesAndRandomScenesAreThoseOfTheSeed) {
    const StabilityPlan plan{.is_short = true, .seed = 3, .mixes = 50, .randoms = 3};
    const std::vector<StabilityCase> first = stability_cases(plan), again = stability_cases(plan);
    std::size_t drawn = 0;
    for (std::size_t k = 0; k < first.size(); ++k) {
        EXPECT_EQ(first[k].name, again[k].name);
        drawn += first[k].name.starts_with("mix/") || first[k].random;
        if (first[k].random) {
            EXPECT_EQ(scene_of(first[k]).scene, scene_of(again[k]).scene);
        }
    }
    EXPECT_EQ(drawn, 53u);
}

struct Seen {
    explicit Seen(std::vector<std::string> overrides = {})
        : model(read_scene_text(base_scene(), "base", overrides).scene.value()), judge(model) {
        for (const glsl::vec4& x : model.cloths[0].position) positions.insert(positions.end(), {x.x, x.y, x.z, x.w});
        statistics.mass = 0.2 * 0.6 * 0.4;
        statistics.largest_distance = 1;
        statistics.potential_energy = -1000;  // low enough for any frame
    }
    Metrics after(std::uint32_t frames) {
        FinishedFrame frame;
        frame.positions = {positions};
        frame.statistics = {statistics};
        frame.effort.substeps = 20;
        for (std::uint32_t k = 0; k < frames; ++k) {
            frame.frame = next++;
            judge.see(frame);
        }
        return judge.numbers();
    }
    SimulationModel model;
    StabilityJudge judge;
    std::vector<float> positions;
    ClothStatistics statistics;
    std::uint32_t next = 0;
};

TEST(StabilityJudgeTest, APlainRunIsNoGarbage) {
    Seen seen({"/solver/method=relax"});
    const Metrics numbers = seen.after(20);
    EXPECT_THAT(garbage(numbers), IsEmpty());
    EXPECT_THAT(breach(numbers, 0.06, 1e-3), IsEmpty());
    EXPECT_NEAR(numbers.at("stretch_law"), 0.02 + 0.12 * 0.0196, 1e-4);
}

TEST(StabilityJudgeTest, SeesEachThingThatIsWrong) {
    const auto found = [](const std::function<void(Seen&)>& spoil, std::uint32_t frames = 20) {
        Seen seen({"/solver/method=relax"});
        seen.after(2);
        spoil(seen);
        return garbage(seen.after(frames));
    };
    EXPECT_THAT(found([](Seen& seen) { seen.statistics.non_finite_count = 1; }), HasSubstr("non_finite"));
    EXPECT_THAT(found([](Seen& seen) { seen.statistics.largest_distance = 30; }), HasSubstr("distance"));
    EXPECT_THAT(found([](Seen& seen) { seen.statistics.largest_distance = NAN; }), HasSubstr("distance"));
    EXPECT_THAT(found([](Seen& seen) {
                    seen.positions[4] = std::nextafter(seen.positions[4], 9.0f);  // a pinned particle, moved by a bit
                }),
                HasSubstr("pins"));
    EXPECT_THAT(found([](Seen& seen) { seen.statistics.stretch_error_max = 0.3; }), HasSubstr("stretch"));
    EXPECT_THAT(found([](Seen& seen) {
                    seen.statistics.stretch_error_max = 0.3;  // an impact that is over soon
                    seen.after(2);
                    seen.statistics.stretch_error_max = 0;
                }),
                IsEmpty());
}

TEST(StabilityJudgeTest, WhatIsThrownMayFlyAsFastAsThatExplains) {
    // Returns the distance of the last of 60 frames over the allowed one, after so much stretch in the frame before.
    const auto found = [](std::vector<std::string> overrides, double distance, double stretch, double error = 0) {
        overrides.push_back(R"(/cloths/0/pins=[{"edge":"top","release":0.3}])");
        Seen seen(overrides);
        seen.after(58);
        seen.statistics.stretch.largest = stretch;
        seen.statistics.stretch_error_max = error;
        seen.after(1);
        seen.statistics.stretch.largest = 0;
        seen.statistics.largest_distance = distance;
        return seen.after(1).at("distance");
    };
    const std::vector<std::string> windy{"/wind/velocity=[300,0,0]"};
    EXPECT_LT(found(windy, 500, 0), 1);  // 300 m/s against the wind, turned by lift: at most 600 m/s
    EXPECT_GT(found(windy, 620, 0), 1);
    // The ball moves 12 m in 0.15 s, at most at 150 m/s; cloth let go makes 71 m/s (sqrt(1000/0.2)) per strain of 1.
    const std::vector<std::string> pushed{
        R"(/colliders/spheres=[{"center":[0,0.8,-6],"radius":0.1,"path":[{"t":0.2},{"t":0.35,"translate":[0,0,12]}]}])"};
    EXPECT_LT(found(pushed, 120, 0), 1);
    EXPECT_GT(found(pushed, 300, 0), 1);
    EXPECT_LT(found(pushed, 300, 5), 1);
    EXPECT_GT(found(pushed, 300, 5, 5), 1);  // stretch that is the solver's error explains nothing
    EXPECT_GT(found({}, 300, 5), 1);         // nor does any stretch where nothing moves
}

TEST(StabilityJudgeTest, EnergyMassAndPenetrationAreBreaches) {
    const auto found = [](const std::function<void(Seen&)>& spoil) {
        Seen seen({"/solver/method=relax"});
        spoil(seen);
        return breach(seen.after(20), 1, 0.05);
    };
    EXPECT_THAT(found([](Seen& seen) { seen.statistics.kinetic_energy = 2000; }), HasSubstr("energy"));
    EXPECT_THAT(found([](Seen& seen) { seen.statistics.mass *= 1.00001; }), HasSubstr("mass"));
    EXPECT_THAT(found([](Seen& seen) { seen.statistics.penetration = 0.01; }), HasSubstr("penetration_end"));
}

TEST(StabilityJudgeTest, FlightHasAClosedForm) {
    Seen seen({"/cloths/0/pins=[]", "/cloths/0/damping=0"});
    const auto fly = [&](double error) {
        for (std::size_t k = 0; k < 3; ++k) seen.statistics.center_of_mass[k] = 0;
        const double time = seen.next / 60.0;
        seen.statistics.center_of_mass = {0, 1 - 0.16 - 0.5 * 9.81 * time * time + error, 0.12};
        return seen.after(1).at("flight");
    };
    EXPECT_LT(fly(0), 1);
    EXPECT_LT(fly(0), 1);
    EXPECT_GT(fly(1e-3), 1);
}

TEST(StabilityResultTest, ALineGivesBackEverything) {
    StabilityResult result{"pair/wind 50 + start line/relax",
                           "key",
                           Verdict::unsettled,
                           "why",
                           "what",
                           "line",
                           {{"frames", 61}, {"stretch", std::numeric_limits<double>::infinity()}}};
    const std::string line = json_line(json_of(result));
    EXPECT_THAT(line, Not(HasSubstr("\n")));
    EXPECT_EQ(parsed_result<StabilityResult>(line), result);
    EXPECT_FALSE(parsed_result<StabilityResult>(line.substr(0, line.size() - 3)));
    EXPECT_FALSE(parsed_result<StabilityResult>("{}"));
}

TEST(StabilityResultTest, EachTierHasItsShortfalls) {
    StabilityCase each;
    StabilityResult result;
    const auto is_short = [&](Tier tier, Verdict verdict) {
        each.tier = tier;
        result.verdict = verdict;
        return !shortfall(each, result).empty();
    };
    EXPECT_FALSE(is_short(Tier::accurate, Verdict::holds));
    EXPECT_TRUE(is_short(Tier::accurate, Verdict::bends));
    EXPECT_TRUE(is_short(Tier::accurate, Verdict::refuses));
    EXPECT_FALSE(is_short(Tier::bounded, Verdict::bends));
    EXPECT_FALSE(is_short(Tier::bounded, Verdict::refuses));
    EXPECT_TRUE(is_short(Tier::bounded, Verdict::unsettled));
    EXPECT_TRUE(is_short(Tier::bounded, Verdict::fails));
    EXPECT_FALSE(is_short(Tier::refused, Verdict::refuses));
    EXPECT_TRUE(is_short(Tier::refused, Verdict::holds));
    result.garbage = "pins";
    EXPECT_TRUE(is_short(Tier::bounded, Verdict::holds));
}

TEST(StabilityResultTest, TheMapHasAPlaceForEveryPairAndVerdict) {
    StabilityReport report;
    for (const StabilityCase& each : stability_cases({})) {
        if (each.method != SolverMethod::relax || !each.name.starts_with("pair/")) continue;
        report.cases.push_back(each);
        report.results.push_back({each.name, "", Verdict::fails, "", "", "relax", {}});
    }
    const std::string map = stability_map(report, SolverMethod::relax);
    std::size_t count = 0;
    for (std::size_t at = 0; (at = map.find("<title>pair/", at)) != map.npos; ++at) ++count;
    EXPECT_EQ(count, report.cases.size());
    EXPECT_THAT(map, HasSubstr("wind 50"));
    EXPECT_THAT(stability_map(report, SolverMethod::line), Not(HasSubstr("pair/")));
}

}  // namespace
}  // namespace drape::bench
