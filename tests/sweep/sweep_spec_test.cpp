// The specification of a sweep tells the values of run I, and every error with its place.
#include "sweep/sweep_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace drape::sweep {
namespace {

using testing::ElementsAre;
using testing::Pair;

TEST(SweepSpec, CountsGridsThroughAndDrawsTheRest) {
    const SweepSpec spec = read_sweep_text(R"({
        "scene": "flag.json", "seed": 3, // a comment
        "set": {"/time/frames": 3},
        "vary": {"/b": {"grid": [1, 2, 3]}, "/a": {"grid": ["x", [0.1, 0]]}, "/c": {"uniform": [0, 1]}}
    })",
                                           "folder/spec.json");
    EXPECT_EQ(spec.scene, "folder/flag.json");
    ASSERT_EQ(spec.count, 6u);
    std::set<std::string> drawn_values;
    for (std::uint32_t index = 0; index < spec.count; ++index) {
        const auto values = spec.parameters_of(index);
        EXPECT_EQ(values.at("/a"), index < 3 ? "\"x\"" : "[0.1, 0]");
        EXPECT_EQ(values.at("/b"), std::to_string(index % 3 + 1));
        drawn_values.insert(values.at("/c"));
        EXPECT_EQ(values.at("/c"), drawn(Uniform{0, 1}, 3, index, "/c"));
    }
    EXPECT_EQ(drawn_values.size(), 6u);
    EXPECT_THAT(spec.overrides_of(1),
                ElementsAre("/time/frames=3", "/a=\"x\"", "/b=2", "/c=" + spec.parameters_of(1)["/c"]));
}

TEST(SweepSpec, AnotherParameterChangesNoValue) {
    const auto value = [](const std::string& more) {
        return read_sweep_text(R"({"scene": "s", "count": 9, "vary": {"/a": {"uniform": [0, 1]})" + more + "}}", "spec")
            .parameters_of(4)
            .at("/a");
    };
    EXPECT_EQ(value(""), value(R"(, "/0": {"normal": [0, 1]}, "/z": {"integer": [1, 9]})"));
}

TEST(SweepSpec, PartsAreDrawnRunByRunAsTheSplitSays) {
    const auto spec = [](const std::string& more) {
        return read_sweep_text(R"({"scene": "s", "seed": 5, "vary": {"/a": {"uniform": [0, 1]}})" + more + "}", "spec");
    };
    const SweepSpec whole = spec(R"(, "count": 10)");
    EXPECT_EQ(whole.part_of(3), "");
    const std::string split = R"(, "split": {"train": 0.7, "validation": 0.2, "test": 0.1})";
    const SweepSpec few = spec(split + R"(, "count": 10)"), many = spec(split + R"(, "count": 4000)");
    std::map<std::string, int, std::less<>> counts;
    for (std::uint32_t index = 0; index < many.count; ++index) {
        ++counts[std::string(many.part_of(index))];
        if (index >= few.count) continue;
        EXPECT_EQ(few.part_of(index), many.part_of(index)) << "a larger count moves none";
        EXPECT_EQ(many.parameters_of(index), whole.parameters_of(index)) << "nor does a split change values";
    }
    // Four standard deviations of binomial counts.
    EXPECT_NEAR(counts["train"], 2800, 4 * std::sqrt(4000 * 0.7 * 0.3));
    EXPECT_NEAR(counts["validation"], 800, 4 * std::sqrt(4000 * 0.2 * 0.8));
    EXPECT_NEAR(counts["test"], 400, 4 * std::sqrt(4000 * 0.1 * 0.9));
}

struct Wrong {
    const char *name, *text, *message;
};

class WrongSpec : public testing::TestWithParam<Wrong> {};

TEST_P(WrongSpec, IsRefusedAtItsPlace) {
    try {
        read_sweep_text(GetParam().text, "spec.json");
        ADD_FAILURE() << "accepted";
    } catch (const SceneFailure& failure) {
        EXPECT_EQ(failure.result().errors.at(0).text(), GetParam().message);
    }
}

const Wrong wrongs[] = {
    {"SplitOfMore", R"({"scene": "s", "count": 1, "split": {"train": 0.9, "test": 0.2}})",
     "spec.json:1:37: /split: expected shares that add up to 1, got 1.1"},
    {"NoScene", "{\"count\": 1}", "spec.json:1:1: /scene: expected the path of a scene file, got nothing"},
    {"NoCount", "{\"scene\": \"s\"}", "spec.json:1:1: expected a count of runs: without a grid there is no other"},
    {"UnknownKey", "{\"scene\": \"s\", \"cuont\": 1}",
     "spec.json:1:1: expected a count of runs: without a grid there is no other"},
    {"Syntax", "{\"scene\": }", "spec.json:1:11: Syntax error: value, object or array expected"},
    {"NotAPointer", "{\"scene\": \"s\", \"count\": 1,\n \"vary\": {\"wind\": {\"uniform\": [0, 1]}}}",
     "spec.json:2:19: /vary/wind: expected a JSON pointer such as /wind/velocity/0"},
    {"UnknownDistribution", "{\"scene\": \"s\", \"count\": 1,\n \"vary\": {\"/a\": {\"unifrom\": [0, 1]}}}",
     "spec.json:2:17: /vary/~1a: expected exactly one of uniform, log_uniform, normal, integer, choice or grid, got 0"},
    {"TwoDistributions",
     "{\"scene\": \"s\", \"count\": 1,\n \"vary\": {\"/a\": {\"uniform\": [0, 1], \"normal\": [0, 1]}}}",
     "spec.json:2:17: /vary/~1a: expected exactly one of uniform, log_uniform, normal, integer, choice or grid, got 2"},
    {"Backwards", "{\"scene\": \"s\", \"count\": 1,\n \"vary\": {\"/a\": {\"uniform\": [1, 0]}}}",
     "spec.json:2:29: /vary/~1a/uniform: expected a low end below the high one, got [1, 0]"},
    {"LogarithmOfZero", "{\"scene\": \"s\", \"count\": 1,\n \"vary\": {\"/a\": {\"log_uniform\": [0, 1]}}}",
     "spec.json:2:33: /vary/~1a/log_uniform: expected a low end above 0, got [0, 1]"},
    {"HalfNumber", "{\"scene\": \"s\", \"count\": 1,\n \"vary\": {\"/a\": {\"integer\": [0, 1.5]}}}",
     "spec.json:2:29: /vary/~1a/integer: expected two integers, the first not above the second, got [0, 1.5]"},
    {"EmptyChoice", "{\"scene\": \"s\", \"count\": 1,\n \"vary\": {\"/a\": {\"choice\": []}}}",
     "spec.json:2:28: /vary/~1a/choice: expected an array of 1 to 1000000 values, got []"},
    {"WithinAlone", "{\"scene\": \"s\", \"count\": 1,\n \"vary\": {\"/a\": {\"uniform\": [0, 1], \"within\": [0, 1]}}}",
     "spec.json:2:47: /vary/~1a/within: expected \"within\" beside \"normal\" only"},
};
INSTANTIATE_TEST_SUITE_P(Sweep, WrongSpec, testing::ValuesIn(wrongs),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace drape::sweep
