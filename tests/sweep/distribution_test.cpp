// Random numbers of a sweep are the published generator's, and values follow their distributions.
#include "sweep/distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "sweep/philox.h"

namespace drape::sweep {
namespace {

// The answers are known: the authors publish them with Random123 (kat_vectors).
TEST(Philox, GivesTheKnownAnswers) {
    using Words = std::array<std::uint32_t, 4>;
    EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    const std::uint32_t ones = 0xffffffff;
    EXPECT_EQ(philox({ones, ones, ones, ones}, {ones, ones}), (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
              (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
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
