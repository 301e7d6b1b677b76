// Closed forms agree with tabulated numbers, and with the equations that they solve.
#include "reference/closed_forms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace drape::closed_forms {
namespace {

using std::numbers::pi;

TEST(ClosedFormsTest, DampedFlightIsSmoothInTheDamping) {
    EXPECT_DOUBLE_EQ(flight_displacement(3, -9.81, 0, 2), 3 * 2 - 9.81 * 2);
    for (const double z : {1e-12, 1e-4, 0.1, 0.2499999, 0.2500001, 1.0, 20.0}) {
        const long double x = z, mean = -std::expm1(-x) / x;
        EXPECT_NEAR(damping_mean(z), double(mean), 2e-15);
        if (z > 0.01) {
            EXPECT_NEAR(damping_lag(z), double((1 - mean) / x), 1e-15);
        }
    }
    EXPECT_NEAR(damping_lag(1e-9), 0.5 - 1e-9 / 6, 1e-16);
    // The velocity is the displacement's derivative.
    const double t = 0.7, e = 1e-5;
    const double slope = (flight_displacement(2, 5, 1.3, t + e) - flight_displacement(2, 5, 1.3, t - e)) / (2 * e);
    EXPECT_NEAR(flight_velocity(2, 5, 1.3, t), slope, 1e-9);
}

TEST(ClosedFormsTest, TheStartMakesEveryDampedSubstepExact) {
    const double h = 0.02, c = 0.8, v0 = 3, a = -9.81;
    double d = flight_start_displacement(v0, a, c, h), x = 0;
    for (int n = 1; n <= 100; ++n) {
        d = std::exp(-c * h) * d + damping_mean(c * h) * h * h * a;
        x += d;
        EXPECT_NEAR(x, flight_displacement(v0, a, c, n * h), 1e-13);
    }
}

TEST(ClosedFormsTest, TheSlidesFactorIteratedStepByStep) {
    for (const double factor : {1.0, 0.99, 0.5}) {
        double before = 1.0 - 0.03, x = 1.0;
        for (std::uint64_t n = 1; n <= 50; ++n) {
            const double next = x + factor * (x - before) + 0.002;
            before = x;
            x = next;
            // The loop's own rounding adds up to n^2/2 roundings of x.
            EXPECT_NEAR(factor_damped_fall(1.0, 0.03, 0.002, factor, n), x, 1e-12) << factor << " " << n;
        }
    }
}

TEST(ClosedFormsTest, InclineAndSphere) {
    EXPECT_EQ(incline_distance(9.81, pi / 6, 0.6, 3), 0);
    EXPECT_NEAR(incline_distance(9.81, pi / 6, 0.2, 2), 0.5 * 9.81 * 4 * (0.5 - 0.2 * std::sqrt(0.75)), 1e-14);
    EXPECT_NEAR(sphere_leave_angle(0.1, 0, 9.81, 1) * 180 / pi, 48.445, 5e-4);
    EXPECT_EQ(sphere_leave_angle(0.1, 10, 9.81, 1), 0.1);  // faster than sqrt(g R): leaves at once
}

TEST(ClosedFormsTest, Pendulum) {
    EXPECT_NEAR(pendulum_period(1, 9.81, pi / 2) / (2 * pi * std::sqrt(1 / 9.81)), 1.180340599, 5e-10);
    EXPECT_NEAR(pendulum_period(1, 9.81, 1e-6) / (2 * pi * std::sqrt(1 / 9.81)), 1.0, 1e-12);
    const double period = pendulum_period(0.7, 9.81, 1.5);
    EXPECT_NEAR(pendulum_angle(0.7, 9.81, 1.5, 0), 1.5, 1e-12);
    EXPECT_NEAR(pendulum_angle(0.7, 9.81, 1.5, period / 4), 0, 1e-12);
    EXPECT_NEAR(pendulum_angle(0.7, 9.81, 1.5, period / 2), -1.5, 1e-7);  // sqrt of rounding at the turning point
    for (const double t : {0.1, 0.33, 0.9, 2.0}) {                        // angle'' = -(g/L) sin(angle)
        const auto angle = [](double at) { return pendulum_angle(0.7, 9.81, 1.5, at); };
        const double e = 1e-4, second = (angle(t + e) - 2 * angle(t) + angle(t - e)) / (e * e);
        EXPECT_NEAR(second, -9.81 / 0.7 * std::sin(angle(t)), 1e-5);
    }
}

TEST(ClosedFormsTest, HangingColumn) {
    // With three links of unit weight 3, 2, 1 particles hang below them, or half a particle less.
    EXPECT_DOUBLE_EQ(hanging_link_tension(3, 0, 1, 1, false), 3);
    EXPECT_DOUBLE_EQ(hanging_link_tension(3, 2, 1, 1, true), 0.5);
    EXPECT_DOUBLE_EQ(hanging_length(3, 1, 100, 1, 1, false), 1 + 0.06);
}

TEST(ClosedFormsTest, StretchLaw) {
    EXPECT_NEAR(stretch_law(64, 9.81, 1 / 1200.0, 1, 1), 0.01395, 1e-5);
    for (const std::uint32_t links : {64u, 256u, 1024u}) {
        const std::uint32_t substeps = stretch_law_substeps(links, 9.81, 60, 1, 1, 0.01);
        EXPECT_LE(stretch_law(links, 9.81, 1 / (60.0 * substeps), 1, 1), 0.01);
        EXPECT_GT(stretch_law(links, 9.81, 1 / (60.0 * (substeps - 1)), 1, 1), 0.01);
        EXPECT_NEAR(substeps, 0.3692 * links, 1);  // 94, 378, 1512 at 256, 1024, 4096
    }
}

TEST(ClosedFormsTest, ChainModes) {
    const double zeros[] = {2.404826, 5.520078, 8.653728, 11.791534};
    for (std::uint32_t n = 1; n <= 4; ++n) {
        EXPECT_NEAR(bessel_j0_zero(n), zeros[n - 1], 5e-7);
        EXPECT_NEAR(hanging_chain_frequency(n, 2, 9.81), zeros[n - 1] / 2 * std::sqrt(9.81 / 2), 1e-6);
        EXPECT_NEAR(hanging_chain_shape(n, 2, 2), 0, 1e-12);
        EXPECT_EQ(hanging_chain_shape(n, 2, 0), 1);
        // The shape solves (g z y')' + omega^2 y = 0.
        const double z = 0.8, e = 1e-3, omega = hanging_chain_frequency(n, 2, 9.81);
        const auto y = [n](double at) { return hanging_chain_shape(n, 2, at); };
        const double flux = 9.81 * ((z + e / 2) * (y(z + e) - y(z)) - (z - e / 2) * (y(z) - y(z - e))) / (e * e);
        EXPECT_NEAR(flux, -omega * omega * y(z), 2e-3);
    }
}

TEST(ClosedFormsTest, StringAndMembrane) {
    EXPECT_NEAR(taut_string_frequency(1, 10000, 4, 0.01 / 10000, 1.0 / 10000), string_frequency(1, 1, 4, 0.01), 1e-5);
    EXPECT_NEAR(taut_string_frequency(1, 2, 8, 1, 1), std::sqrt(2 * 8.0), 1e-12);  // one mass between two links
    EXPECT_NEAR(membrane_frequency(3, 4, 2, 9, 1), pi / 2 * 3 * 5, 1e-12);
}

TEST(ClosedFormsTest, Catenary) {
    const Catenary curve = catenary(0.8, 1.0);
    EXPECT_NEAR(curve.a, 0.338201879, 5e-10);
    EXPECT_NEAR(curve.sag, 0.265437509, 5e-10);
    EXPECT_NEAR(curve.tension, 0.603639, 5e-7);
    const PlanePoint end = catenary_point(curve, 0.5);
    EXPECT_NEAR(end.x, 0.4, 1e-14);
    EXPECT_NEAR(end.y, curve.sag, 1e-14);
    const PlanePoint middle = catenary_point(curve, 0.2);
    EXPECT_NEAR(middle.y, curve.a * (std::cosh(middle.x / curve.a) - 1), 1e-14);
    EXPECT_THROW(catenary(1.0, 1.0), std::invalid_argument);
}

TEST(ClosedFormsTest, ElasticCatenary) {
    const Catenary stiff = catenary(0.8, 1.0), nearly = elastic_catenary(0.8, 1.0, 1e9);
    EXPECT_NEAR(nearly.a, stiff.a, 1e-8);
    EXPECT_NEAR(nearly.sag, stiff.sag, 1e-8);
    const double elastic = 20;
    const Catenary curve = elastic_catenary(0.8, 1.0, elastic);
    EXPECT_NEAR(elastic_catenary_point(curve, elastic, 0.5).x, 0.4, 1e-13);
    // The curve's local stretch is 1 + tension/EA.
    const double s = 0.3, e = 1e-5;
    const PlanePoint p = elastic_catenary_point(curve, elastic, s - e),
                     q = elastic_catenary_point(curve, elastic, s + e);
    EXPECT_NEAR(std::hypot(q.x - p.x, q.y - p.y) / (2 * e), 1 + std::hypot(curve.a, s) / elastic, 1e-9);
}

TEST(ClosedFormsTest, HeavyElastica) {
    EXPECT_NEAR(heavy_elastica(1).ratio(), 0.124562, 5e-7);
    EXPECT_NEAR(heavy_elastica(10).ratio(), 1.066802, 5e-7);
    EXPECT_NEAR(heavy_elastica(100).ratio(), 5.888105, 5e-7);
    EXPECT_NEAR(heavy_elastica(1000).ratio(), 21.335, 5e-4);
    EXPECT_NEAR(heavy_elastica(1e-4).drop, 1e-4 / 8, 1e-11);
    EXPECT_NEAR(std::atan(heavy_elastica(8.004).ratio()) * 180 / pi, 41.5, 0.01);
    EXPECT_EQ(heavy_elastica(0).reach, 1);
    for (const double gamma : {1.0, 100.0, 1000.0})  // the steps are fine enough
        EXPECT_NEAR(heavy_elastica(gamma, 4096).ratio() / heavy_elastica(gamma, 2048).ratio(), 1, 1e-9) << gamma;
    const HeavyElastica curve = heavy_elastica(50, 1000);
    double length = 0;
    for (std::size_t k = 1; k < curve.shape.size(); ++k)
        length += std::hypot(curve.shape[k].x - curve.shape[k - 1].x, curve.shape[k].y - curve.shape[k - 1].y);
    EXPECT_NEAR(length, 1, 1e-5);
    EXPECT_NEAR(curve.shape.back().y, curve.drop, 1e-15);
    EXPECT_THROW(heavy_elastica(-1), std::invalid_argument);
}

TEST(ClosedFormsTest, XpbdOscillator) { EXPECT_NEAR(xpbd_oscillator_period(1e-3, 1), 0.198692, 5e-7); }

}  // namespace
}  // namespace drape::closed_forms
