// Random values of a sweep: what they are, and that they follow their distributions.
#include "sweep/distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace drape::sweep {
namespace {

// A specification must draw the same in every version of Drape.
TEST(Distributions, DrawTheNumbersTheyAlwaysDrew) {
    EXPECT_EQ(drawn(Uniform{0, 1}, 1, 5, "/a"), "0.12108068891473878");
    EXPECT_EQ(drawn(Uniform{0, 1}, (std::uint64_t{7} << 32) + 1, 100'000, "/wind/velocity/0"), "0.5797873050396178");
    EXPECT_EQ(drawn(Normal{10, 2, -INFINITY, INFINITY}, 3, 0, "/b"), "7.373847139926779");
}

struct Moments {
    double mean = 0, deviation = 0, least = INFINITY, most = -INFINITY;
};

Moments moments(
    const Distribution& distribution, double (*map)(double) = [](double x) { return x; }) {
    constexpr std::uint32_t count = 20'000;
    Moments result;
    double squares = 0;
    for (std::uint32_t index = 0; index < count; ++index) {
        const double value = map(std::stod(drawn(distribution, 7, index, "/a")));
        result.mean += value / count;
        squares += value * value / count;
        result.least = std::min(result.least, value);
        result.most = std::max(result.most, value);
    }
    result.deviation = std::sqrt(squares - result.mean * result.mean);
    return result;
}

// The mean of 20,000 values is off by 0.007 standard deviations (one sigma); limits are four times that.
constexpr double sigmas = 4 / 141.0;

TEST(Distributions, HaveTheirMoments) {
    const Moments uniform = moments(Uniform{2, 5});
    EXPECT_NEAR(uniform.mean, 3.5, sigmas * 3 / std::sqrt(12));
    EXPECT_NEAR(uniform.deviation, 3 / std::sqrt(12), sigmas);
    EXPECT_GE(uniform.least, 2);
    EXPECT_LT(uniform.most, 5);
    const Moments logarithm = moments(LogUniform{1e-6, 1e-2}, [](double x) { return std::log10(x); });
    EXPECT_NEAR(logarithm.mean, -4, sigmas * 4 / std::sqrt(12));
    EXPECT_GE(logarithm.least, -6 - 1e-12);
    EXPECT_LE(logarithm.most, -2 + 1e-12);
    const Moments normal = moments(Normal{10, 2, -INFINITY, INFINITY});
    EXPECT_NEAR(normal.mean, 10, sigmas * 2);
    EXPECT_NEAR(normal.deviation, 2, sigmas * 2);
    const Moments within = moments(Normal{0, 1, 0.5, 1});
    EXPECT_GE(within.least, 0.5);
    EXPECT_LE(within.most, 1);
    EXPECT_THROW(drawn(Normal{0, 1, 50, 60}, 1, 0, "/a"), std::runtime_error);
}

TEST(Distributions, WholeNumbersAndChoicesAreEachAsLikely) {
    std::map<std::string, int> count;
    for (std::uint32_t index = 0; index < 20'000; ++index) {
        ++count[drawn(WholeNumber{-1, 2}, 3, index, "/n")];
        ++count[drawn(Choice{{"\"cotton\"", "[1,2]"}}, 3, index, "/c")];
    }
    ASSERT_EQ(count.size(), 6u);
    for (const char* number : {"-1", "0", "1", "2"}) EXPECT_NEAR(count[number], 5000, 4 * std::sqrt(20'000 * 3 / 16.0));
    for (const char* value : {"\"cotton\"", "[1,2]"}) EXPECT_NEAR(count[value], 10'000, 4 * std::sqrt(20'000 / 4.0));
}

TEST(Distributions, AValueDependsOnSeedIndexAndPointerAlone) {
    const Uniform range{0, 1};
    const std::string value = drawn(range, 1, 5, "/a");
    EXPECT_EQ(drawn(range, 1, 5, "/a"), value);
    EXPECT_NE(drawn(range, 2, 5, "/a"), value);
    EXPECT_NE(drawn(range, 1, 6, "/a"), value);
    EXPECT_NE(drawn(range, 1, 5, "/b"), value);
    EXPECT_NE(drawn(range, 1 + (std::uint64_t{1} << 32), 5, "/a"), value);
}

}  // namespace
}  // namespace drape::sweep
