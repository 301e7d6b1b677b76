// Profiles of measured frames have the right statistics, come back from their reports, and are compared.
#include "profile/profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/reader.h>

#include <sstream>

#include "profile/comparison.h"
#include "profile/profile_report.h"

namespace drape::profile {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Returns eleven frames of 10, 11 .. 20 ms, times `factor`; `copy` takes 1 ms in every second one.
Profile measured(double factor) {
    Profile profile;
    profile.scene = "flag.json";
    profile.device = "a device";
    profile.solver = "line";
    profile.passes = true;
    profile.copy_bandwidth = 10e9;
    profile.work = {{"relax", "simulate", 4, 30'000'000, 12e6}};
    double at = 0;
    for (int k = 0; k < 11; ++k) {
        const double milliseconds = factor * (10 + k);
        ProfiledFrame frame{static_cast<std::uint32_t>(k + 6), at, at + 1e-3 * milliseconds, {.substeps = 4}, {}};
        frame.device.push_back({"relax", factor * 6});
        if (k % 2 == 1) frame.device.push_back({"copy", 1});
        profile.frames.push_back(frame);
        at = frame.end;
    }
    return profile;
}

Json::Value parsed(const std::string& text) {
    std::istringstream stream(text);
    Json::Value value;
    stream >> value;
    return value;
}

TEST(ProfileStatistics, AreQuantilesBetweenTheSortedValues) {
    const Statistics s = statistics_of({4, 1, 3, 2, 5});
    EXPECT_DOUBLE_EQ(s.minimum, 1);
    EXPECT_DOUBLE_EQ(s.median, 3);
    EXPECT_DOUBLE_EQ(s.p95, 4.8);
    EXPECT_DOUBLE_EQ(s.p99, 4.96);
    EXPECT_DOUBLE_EQ(s.spread, 2.0 / 3);
    EXPECT_DOUBLE_EQ(statistics_of({7}).p99, 7);
}

TEST(ProfileRows, HaveAValueForEveryFrame) {
    const std::vector<Row> rows = rows_of(measured(1));
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0].name, "frame");
    EXPECT_NEAR(rows[0].milliseconds[10], 20, 1e-9);
    EXPECT_EQ(rows[1].name, "device");
    EXPECT_THAT(rows[1].milliseconds, ElementsAre(6, 7, 6, 7, 6, 7, 6, 7, 6, 7, 6));
    EXPECT_EQ(rows[3].name, "copy");
    EXPECT_THAT(rows[3].milliseconds, ElementsAre(0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0));
}

TEST(ProfileRows, FramesThatAreHandedOutTogetherHaveNoTimeOfTheirOwn) {
    Profile profile = measured(1);
    profile.substeps_vary = true;
    EXPECT_EQ(rows_of(profile)[0].name, "device");
    EXPECT_THAT(profile_text(profile), HasSubstr("15.000 ms per frame on the host on average"));
    EXPECT_THAT(profile_text(profile), Not(HasSubstr("GB/s   of copy")));
}

TEST(ProfileText, SaysWhatAPassMovesAndWhatIsUnavailable) {
    // 30 MB in 6 ms are 5 GB/s, half of what a copy moves.
    EXPECT_THAT(profile_text(measured(1)), HasSubstr("5.00      50 %      12.0     2.00\n"));  // 12 Mflop: 2 GFLOP/s
    Profile blind = measured(1);
    for (ProfiledFrame& frame : blind.frames) frame.device.clear();
    EXPECT_THAT(profile_text(blind), HasSubstr("device times: unavailable"));
    EXPECT_THAT(profile_csv(measured(1)), HasSubstr("\nrelax,6,6,6,6,0,4,30000000,5e+09,0.5,1.2e+07,2e+09\n"));
    Profile unknown = measured(1);
    unknown.work[0].flops = 0;
    EXPECT_THAT(profile_csv(unknown), HasSubstr("\nrelax,6,6,6,6,0,4,30000000,5e+09,0.5,,\n"));
}

TEST(ProfileJson, HasARepetitionPerFrameAndAggregates) {
    const Json::Value value = parsed(profile_json(measured(1)));
    EXPECT_EQ(value["context"]["scene"], "flag.json");
    int repetitions = 0;
    double median = 0;
    for (const Json::Value& entry : value["benchmarks"]) {
        if (entry["run_name"] != "frame") continue;
        EXPECT_EQ(entry["time_unit"], "ms");
        if (entry["run_type"] == "iteration") ++repetitions;
        if (entry["aggregate_name"] == "median") median = entry["real_time"].asDouble();
        EXPECT_FALSE(entry.isMember("flops_per_second")) << "a frame is no pass";
    }
    for (const Json::Value& entry : value["benchmarks"])
        if (entry["name"] == "relax_median") {
            EXPECT_NEAR(entry["flops_per_second"].asDouble(), 2e9, 1);
        }
    EXPECT_EQ(repetitions, 11);
    EXPECT_NEAR(median, 15, 1e-9);
}

TEST(ProfileTrace, LaysTheDevicesWorkAtTheEndOfItsFrame) {
    const Json::Value events = parsed(profile_trace(measured(1)))["traceEvents"];
    double frame_end = 0, work_end = 0;
    for (const Json::Value& event : events) {
        if (event["ph"] != "X") continue;
        const double end = event["ts"].asDouble() + event["dur"].asDouble();
        (event["tid"] == 1 ? frame_end : work_end) = end;
    }
    EXPECT_NEAR(frame_end, 1e3 * 165, 1e-6);
    EXPECT_NEAR(work_end, frame_end, 1e-6);
}

TEST(ProfileComparison, OnlyWhatIsBeyondTheNoiseIsSlower) {
    const auto against = [](double factor) {
        return compare(profile_json(measured(1)), "a", profile_json(measured(factor)), "b");
    };
    EXPECT_FALSE(against(1).slower());
    // The frames spread by a third, so 1.2 times as long is noise there, but not for the pass, which took the same each
    // time.
    const Comparison comparison = against(1.2);
    ASSERT_EQ(comparison.rows.size(), 4u);
    EXPECT_EQ(comparison.rows[0].verdict, ComparedRow::Verdict::same);
    EXPECT_EQ(comparison.rows[2].name, "relax");
    EXPECT_EQ(comparison.rows[2].verdict, ComparedRow::Verdict::slower);
    EXPECT_TRUE(comparison.slower());
    EXPECT_EQ(against(0.5).rows[2].verdict, ComparedRow::Verdict::faster);
}

TEST(ProfileComparison, SaysWhatDiffersAndWhatIsNoProfile) {
    Profile other = measured(1);
    other.kernels = "plain";
    const Comparison comparison = compare(profile_json(measured(1)), "a", profile_json(other), "b");
    EXPECT_THAT(comparison.differences, ElementsAre(HasSubstr("kernels")));
    for (const char* text : {"", "[]", "{}", "{\"context\": {}, \"benchmarks\": []}",
                             "{\"context\": {}, \"benchmarks\": 3}", "{\"context\": {}, \"benchmarks\": [1]}"})
        try {
            compare(text, "wrong.json", profile_json(other), "b");
            FAIL() << text;
        } catch (const NoProfile& error) {
            EXPECT_THAT(error.what(), HasSubstr("wrong.json"));
        }
}

}  // namespace
}  // namespace drape::profile
