// Orders of convergence are fitted by least squares.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/claims.h"
#include "results.h"

namespace drape::bench {
namespace {

using Points = std::vector<std::array<double, 2>>;

TEST(FitTest, FindsTheSlopeOfAPowerAndOfScatteredPowers) {
    EXPECT_NEAR(*log_slope(Points{{1, 5}, {2, 1.25}, {4, 0.3125}}), -2, 1e-12);
    // Residuals +e, -2e, +e are orthogonal to a line through three equally spaced points.
    EXPECT_NEAR(*log_slope(Points{{1, std::exp(0.1)}, {2, 2 * std::exp(-0.2)}, {4, 4 * std::exp(0.1)}}), 1, 1e-12);
}

TEST(FitTest, HasNoSlopeWithoutTwoDifferentPoints) {
    EXPECT_FALSE(log_slope(Points{}));
    EXPECT_FALSE(log_slope(Points{{2, 1}}));
    EXPECT_FALSE(log_slope(Points{{2, 1}, {2, 3}}));
    EXPECT_FALSE(log_slope(Points{{2, 1}, {4, 0}}));  // a zero has no logarithm
}

TEST(FitTest, DifferencesRevealTheOrderOfAValueWithAnUnknownLimit) {
    Points points;
    for (const double n : {8.0, 16.0, 32.0, 64.0}) points.push_back({n, 3.7 + 0.5 / (n * n)});
    EXPECT_NEAR(*log_slope(differences(points)), -2, 1e-9);
    EXPECT_GT(*log_slope(points), -0.1);
}

TEST(FitTest, AClaimIsAboutOneFamilyAndLeavesOutWhatIsOutsideItsRange) {
    std::vector<CaseResult> results;
    for (const std::uint32_t n : {10u, 20u, 40u, 80u})
        results.push_back(test::swing_result(SolverMethod::relax, n, 1, 0, 4.0 / (n * n)));
    results.push_back(test::swing_result(SolverMethod::relax, 160, 1, 0, 1e-3));  // stuck at the floor
    results.push_back(test::swing_result(SolverMethod::relax, 1, 1, 0, 0.5, 40));
    results.push_back(test::swing_result(SolverMethod::explicit_steps, 40, 1, 0, 77));
    OrderClaim claim{"swing", "relax", "stretch_error", OrderClaim::Variable::substeps, -2, 0.1, 2e-3, 0.03, 64};
    claim.floor = 1.1e-3;
    std::vector<OrderFit> fits = fit_orders(std::vector{claim}, results);
    ASSERT_TRUE(fits.empty()) << "only 0.01 and 0.0025 are in range, and two points are no order";
    claim.ceiling = 0.05;
    fits = fit_orders(std::vector{claim}, results);
    ASSERT_EQ(fits.size(), 1u);
    EXPECT_EQ(fits[0].points.size(), 3u);
    EXPECT_NEAR(fits[0].slope, -2, 1e-9);
    EXPECT_TRUE(fits[0].met);
    claim.floor = 5e-4;  // now the floor's point spoils it
    fits = fit_orders(std::vector{claim}, results);
    EXPECT_FALSE(fits[0].met);
}

}  // namespace
}  // namespace drape::bench
