// Cases, tables, fits and plots of `drape bench speed` are checked on made-up times.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "bench/bench_run.h"
#include "bench/speed_report.h"

namespace drape::bench {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

SpeedTime time_of(const std::string& name, double median, double spread = 0.1) {
    return {name, {0.9 * median, median, 1.1 * median, 1.2 * median, spread}};
}

SpeedResult sheet_result(std::uint32_t size, double frame, double device, double spread = 0.1) {
    SpeedCase about{.name = fmt::format("line/{}", size), .group = "line", .variable = size, .size = size};
    return {about, {}, {time_of("frame", frame, spread), time_of("device", device)}, 2e6, 4e6};
}

SpeedReport report_of(std::vector<SpeedResult> results) {
    return {{"0", "today", "device", "driver"}, 2, 1e10, std::move(results)};
}

TEST(SpeedCases, HaveNamesOfTheirOwnAndTheirScenes) {
    std::set<std::string> names;
    for (const SpeedCase& each : speed_cases(false)) {
        EXPECT_TRUE(names.insert(each.name).second) << each.name;
        if (each.kind == SpeedKind::skip || each.kind == SpeedKind::ensemble || each.size > 64) continue;
        const SceneDescription scene = scene_of(each);
        EXPECT_EQ(scene.cloths.size(), each.cloths);
        EXPECT_EQ(scene.colliders.size(), each.colliders);
    }
    for (const char* name : {"explicit/2048", "line/32/64 cloths", "line/128/64 colliders", "picture/64/4 samples",
                             "start/render", "skip/iterations", "ensemble/32/4096 members"})
        EXPECT_TRUE(names.contains(name)) << name;
    for (const SpeedCase& each : speed_cases(true)) EXPECT_LE(each.size, 256u);
}

TEST(SpeedCases, EverySkipNamesAShippedScene) {
    for (const SkipCase& skip : skip_cases())
        EXPECT_TRUE(std::ifstream(DRAPE_SOURCE_DIR "/scenes/" + skip.scene)) << skip.scene;
}

TEST(SpeedReports, EnsemblesStandBesideProcesses) {
    SpeedCase about{.name = "ensemble/32/64 members", .kind = SpeedKind::ensemble, .variable = 64, .cloths = 64};
    const SpeedResult result{
        about, {}, {time_of("frame", 16, 0.1), time_of("device", 15, 0.1), time_of("alone", 1, 0.1)}};
    const std::string text = speed_text(report_of({result}));
    // 64 cloths in 16 ms, and two cores that take 1 ms for each.
    EXPECT_THAT(text, testing::ContainsRegex("ensemble/32/64 members +16.000 +15.000 +4000 +2000 +2.00"));
}

TEST(SpeedResults, RatiosAreOfMediansAndNoneWithoutBoth) {
    const SpeedResult result = sheet_result(64, 3, 2);
    EXPECT_DOUBLE_EQ(result.ratio("frame", "device"), 1.5);
    EXPECT_EQ(result.ratio("frame", "without"), 0);
    EXPECT_EQ(result.find("without"), nullptr);
}

TEST(SpeedResults, ScalingIsFittedToMillisecondsPerSubstepFrom64On) {
    std::vector<SpeedResult> results{sheet_result(32, 100, 100)};
    // Frames below 1024 have twice as many substeps, since the fit is to the time per substep.
    for (const std::uint32_t size : {64u, 256u, 1024u}) {
        const double particles = double(size) * size, substeps = size < 1024 ? 8 : 2;
        results.push_back(sheet_result(size, substeps * 1e-4 * particles, substeps * 1e-6 * std::pow(particles, 1.2)));
    }
    const std::vector<ScalingFit> fits = fit_scaling(results);
    ASSERT_EQ(fits.size(), 2u);
    EXPECT_EQ(fits[0].time, "frame");
    EXPECT_NEAR(fits[0].exponent, 1, 1e-9);
    EXPECT_NEAR(fits[1].exponent, 1.2, 1e-9);
    EXPECT_EQ(fits[0].points.size(), 3u);
    results.pop_back();
    EXPECT_TRUE(fit_scaling(results).empty()) << "two points are no fit";
}

TEST(SpeedReport, TableHasRatiosRatesAndMarksDoubtfulTimes) {
    const std::string text = speed_text(report_of({sheet_result(64, 4, 2), sheet_result(128, 8, 1, 0.5)}));
    EXPECT_THAT(text, AllOf(HasSubstr("a copy moves 10.00 GB/s"), HasSubstr("Solvers, ms per substep"),
                            Not(HasSubstr("Skips")), Not(HasSubstr("Starts"))));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("line/64")) {  // 0.5 ms of a substep, twice the device's; 2 MB in 2 ms
            EXPECT_THAT(line, testing::ContainsRegex("0.5000 +0.2500 +0.0250 +2.00 +122.1 +1.0 +10 % +2.0 +10 %$"));
        } else if (line.starts_with("line/128")) {
            EXPECT_THAT(line, AllOf(HasSubstr("8.00"), HasSubstr("time doubtful")));
        }
    }
}

TEST(SpeedReport, SkipsSayWhatTheySave) {
    SpeedCase about{.name = "skip/pictures", .kind = SpeedKind::skip};
    const SpeedReport report = report_of({{about, "a.json: pictures", {time_of("frame", 2), time_of("without", 8)}}});
    EXPECT_THAT(speed_text(report), AllOf(HasSubstr("75 %"), HasSubstr("a.json: pictures")));
    EXPECT_THAT(speed_json(report), HasSubstr("\"skipped\": \"a.json: pictures\""));
}

TEST(SpeedReport, KernelsSayWhichAreTakenAndWhichAreTheFastest) {
    SpeedCase about{.name = "kernels/line/64", .kind = SpeedKind::kernels};
    const SpeedReport report =
        report_of({{about, "plain", {time_of("frame", 8), time_of("plain", 8), time_of("buffer_store", 4)}}});
    EXPECT_THAT(speed_text(report),
                testing::ContainsRegex("kernels/line/64 +1.0000 +0.5000 +- +- +- +- +buffer_store +2.00 +plain"));
    EXPECT_THAT(speed_json(report), HasSubstr("\"taken\": \"plain\""));
}

TEST(SpeedReport, TheCostOfASubstepIsAPartPerDispatchAndOnePerParticle) {
    std::vector<SpeedResult> results;
    for (const std::uint32_t size : {32u, 64u, 256u}) {
        SpeedResult& result = results.emplace_back(
            SpeedResult{{.name = "kernels/line", .kind = SpeedKind::kernels, .variable = size, .size = size}});
        const double ms = result.about.substeps() * (0.03 + 2e-6 * result.about.particles());
        result.times = {{"frame", profile::Statistics{.median = ms}}};
    }
    const std::vector<MeasuredCost> costs = fit_costs(results);
    ASSERT_EQ(costs.size(), 1u);
    EXPECT_EQ(costs[0].method, SolverMethod::line);
    EXPECT_NEAR(costs[0].cost.ms, 0.03, 1e-9);
    EXPECT_NEAR(costs[0].cost.particle_ns, 2, 1e-6);
    results.resize(1);
    EXPECT_TRUE(fit_costs(results).empty()) << "one size is no fit";
}

TEST(SpeedCases, OfKernelsAreThoseOfSheetsAndCloths) {
    std::set<std::string> names;
    for (const SpeedCase& each : kernel_cases(true)) {
        EXPECT_EQ(each.kind, SpeedKind::kernels);
        EXPECT_TRUE(names.insert(each.name).second) << each.name;
    }
    for (const char* name : {"kernels/explicit/32", "kernels/relax/256", "kernels/line/32/64 cloths"})
        EXPECT_TRUE(names.contains(name)) << name;
}

TEST(SpeedReport, JsonAndCsvHaveEveryTime) {
    const SpeedReport report = report_of({sheet_result(64, 4, 2)});
    EXPECT_THAT(speed_json(report), AllOf(HasSubstr("\"format\": \"drape bench speed 1\""),
                                          HasSubstr("\"frame_over_this\": 2"), HasSubstr("\"flops_per_frame\"")));
    EXPECT_THAT(speed_csv(report), HasSubstr("line/64,solve,4096,8,1,0,device,1.8,2,2.2,0.1,0,2\n"));
}

TEST(SpeedReport, PlotsHaveUnitsAndASeriesPerSide) {
    const auto plots = speed_plots(report_of({sheet_result(64, 4, 2), sheet_result(128, 8, 1, 0.5)}));
    ASSERT_EQ(plots.size(), 1u);
    EXPECT_EQ(plots[0].first, "speed_line.svg");
    const plot::Plot& plot = plots[0].second;
    EXPECT_EQ(plot.y_label, "ns per particle and substep");
    ASSERT_EQ(plot.curves.size(), 2u);
    EXPECT_NEAR(plot.curves[0].points[0][1], 1e6 * 4 / 8 / 4096, 1e-9);
    EXPECT_EQ(plot.curves[0].doubtful, (std::vector<bool>{false, true}));
    EXPECT_TRUE(speed_plots(report_of({sheet_result(64, 4, 2)})).empty()) << "one point is no line";
}

TEST(Budget, LetsBeginWhatWillEndInTime) {
    Budget free(std::nullopt, 1);
    EXPECT_TRUE(free.allows(1e9));
    Budget budget(1, 0.1);  // a minute in all, and a tenth of a second per unit at first
    EXPECT_TRUE(budget.allows(500));
    EXPECT_FALSE(budget.allows(700));
    budget.done(100, 100);
    EXPECT_FALSE(budget.allows(500)) << "the measured rate counts";
    budget.left(30);
    budget.left_out(10);
    EXPECT_DOUBLE_EQ(budget.seconds_left(), 20);
    EXPECT_EQ(duration_text(3723), "1:02:03");
    EXPECT_EQ(duration_text(60.2), "1:01");
}

}  // namespace
}  // namespace drape::bench
