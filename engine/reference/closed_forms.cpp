#include "reference/closed_forms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace drape::closed_forms {

using std::numbers::pi;

namespace {

/// phi (first = 1) and psi (first = 2) without cancellation at small z: the sum of (-z)^k / (k + first)! for k = 0..
double damping_series(double z, int first) {
    double term = 1, sum = 0;
    for (int k = 2; k <= first; ++k) term /= k;
    for (int k = 0; k < 14; ++k) {
        sum += term;
        term *= -z / (k + first + 1);
    }
    return sum;
}

constexpr double series_limit = 0.25;  // 0.25^14/15! is far below one rounding

/// Root of an increasing function between low and high, to the last bits.
template <class Function>
double bisect(double low, double high, const Function& function) {
    for (int k = 0; k < 200 && low < high; ++k) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        (function(middle) < 0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace

double damping_mean(double z) { return std::abs(z) < series_limit ? damping_series(z, 1) : -std::expm1(-z) / z; }

double damping_lag(double z) { return std::abs(z) < series_limit ? damping_series(z, 2) : (1 - damping_mean(z)) / z; }

double flight_displacement(double v0, double acceleration, double damping, double time) {
    const double z = damping * time;
    return v0 * time * damping_mean(z) + acceleration * time * time * damping_lag(z);
}

double flight_velocity(double v0, double acceleration, double damping, double time) {
    const double z = damping * time;
    return v0 * std::exp(-z) + acceleration * time * damping_mean(z);
}

double flight_start_displacement(double v0, double acceleration, double damping, double h) {
    return -flight_displacement(v0, acceleration, damping, -h);
}

double factor_damped_fall(double x0, double step_velocity, double step_acceleration, double factor, std::uint64_t n) {
    const double count = static_cast<double>(n);
    if (factor == 1.0) return x0 + count * step_velocity + step_acceleration * count * (count + 1) / 2;
    const double series = factor * (1 - std::pow(factor, count)) / (1 - factor);
    return x0 + step_velocity * series + step_acceleration / (1 - factor) * (count - series);
}

double incline_distance(double gravity, double angle, double friction, double time) {
    return std::max(0.0, 0.5 * gravity * time * time * (std::sin(angle) - friction * std::cos(angle)));
}

double sphere_leave_angle(double start_angle, double v0, double gravity, double radius) {
    const double cosine = 2.0 / 3.0 * std::cos(start_angle) + v0 * v0 / (3 * gravity * radius);
    return cosine >= std::cos(start_angle) ? start_angle : std::acos(cosine);
}

double complete_elliptic_k(double k) {
    double a = 1, b = std::sqrt((1 - k) * (1 + k));
    for (int step = 0; step < 40 && std::abs(a - b) > 1e-16 * a; ++step) {
        const double mean = 0.5 * (a + b);
        b = std::sqrt(a * b);
        a = mean;
    }
    return pi / (2 * a);
}

double pendulum_period(double length, double gravity, double amplitude) {
    return 4 * complete_elliptic_k(std::sin(0.5 * amplitude)) * std::sqrt(length / gravity);
}

namespace {

/// Jacobi's sn(u, k) by the descending sequence of the arithmetic-geometric mean (Abramowitz and Stegun 16.4).
double jacobi_sn(double u, double k) {
    std::array<double, 40> a{}, c{};
    a[0] = 1;
    c[0] = k;
    double b = std::sqrt((1 - k) * (1 + k));
    std::size_t last = 0;
    while (last + 1 < a.size() && std::abs(c[last]) > 1e-17) {
        a[last + 1] = 0.5 * (a[last] + b);
        c[last + 1] = 0.5 * (a[last] - b);
        b = std::sqrt(a[last] * b);
        ++last;
    }
    double phase = std::ldexp(a[last] * u, static_cast<int>(last));
    for (std::size_t n = last; n > 0; --n) phase = 0.5 * (phase + std::asin(c[n] / a[n] * std::sin(phase)));
    return std::sin(phase);
}

}  // namespace

double pendulum_angle(double length, double gravity, double amplitude, double time) {
    const double k = std::sin(0.5 * amplitude);
    const double u = complete_elliptic_k(k) + std::sqrt(gravity / length) * time;
    return 2 * std::asin(k * jacobi_sn(u, k));
}

double hanging_link_tension(std::uint32_t links, std::uint32_t link, double mass, double gravity, bool half_end_mass) {
    return (links - link - (half_end_mass ? 0.5 : 0.0)) * mass * gravity;
}

double hanging_length(std::uint32_t links, double length, double stiffness, double mass, double gravity,
                      bool half_end_mass) {
    double total = length;
    for (std::uint32_t link = 0; link < links; ++link)
        total += hanging_link_tension(links, link, mass, gravity, half_end_mass) / stiffness;
    return total;
}

double stretch_law(std::uint32_t links, double gravity, double substep, std::uint32_t iterations, double length) {
    return double(links) * links * gravity * substep * substep / (2.0 * iterations * length);
}

std::uint32_t stretch_law_substeps(std::uint32_t links, double gravity, double fps, std::uint32_t iterations,
                                   double length, double strain, double factor) {
    const double at_one = factor * stretch_law(links, gravity, 1 / fps, iterations, length);
    const double substeps = std::ceil(std::sqrt(at_one / strain) * (1 - 1e-12));
    if (!(substeps < 4e9)) throw std::invalid_argument("stretch_law_substeps: more than 4e9 substeps");
    return std::max<std::uint32_t>(1, static_cast<std::uint32_t>(substeps));
}

double bessel_j0_zero(std::uint32_t n) {
    const double beta = (n - 0.25) * pi;  // McMahon's expansion, then Newton with J0' = -J1
    double x = beta + 1 / (8 * beta) - 124 / (3 * std::pow(8 * beta, 3));
    for (int k = 0; k < 6; ++k) x += std::cyl_bessel_j(0.0, x) / std::cyl_bessel_j(1.0, x);
    return x;
}

double hanging_chain_frequency(std::uint32_t n, double length, double gravity) {
    return 0.5 * bessel_j0_zero(n) * std::sqrt(gravity / length);
}

double hanging_chain_shape(std::uint32_t n, double length, double height) {
    return std::cyl_bessel_j(0.0, bessel_j0_zero(n) * std::sqrt(std::max(0.0, height) / length));
}

double taut_string_frequency(std::uint32_t n, std::uint32_t links, double tension, double mass, double link_length) {
    return 2 * std::sqrt(tension / (mass * link_length)) * std::sin(n * pi / (2.0 * links));
}

double string_frequency(std::uint32_t n, double length, double tension, double linear_density) {
    return n * pi / length * std::sqrt(tension / linear_density);
}

double membrane_frequency(std::uint32_t m, std::uint32_t n, double side, double tension, double areal_density) {
    return pi / side * std::sqrt(tension / areal_density) * std::hypot(double(m), double(n));
}

Catenary catenary(double span, double length) {
    if (!(span > 0 && span < length)) throw std::invalid_argument("catenary: need 0 < span < length");
    // Solves sinh(q)/q = length/span for q = span/(2 a); the left side increases with q.
    const double wanted = length / span;
    double high = 1;
    while (std::sinh(high) / high < wanted) high *= 2;
    const double q = bisect(0.0, high, [&](double x) { return (x > 0 ? std::sinh(x) / x : 1.0) - wanted; });
    const double a = span / (2 * q);
    const double rise = a * (std::cosh(q) - 1);
    return {a, rise, a + rise};
}

PlanePoint catenary_point(const Catenary& curve, double s) {
    return {curve.a * std::asinh(s / curve.a), s * s / (std::hypot(curve.a, s) + curve.a)};
}

PlanePoint elastic_catenary_point(const Catenary& curve, double elastic_length, double s) {
    const PlanePoint stiff = catenary_point(curve, s);
    return {stiff.x + curve.a * s / elastic_length, stiff.y + 0.5 * s * s / elastic_length};
}

Catenary elastic_catenary(double span, double length, double elastic_length) {
    if (!(span > 0 && length > 0 && elastic_length > 0))
        throw std::invalid_argument("elastic_catenary: need positive span, length and elastic length");
    // The half span 1/2 span = a asinh(l/2a) + a l/(2 e) grows with a.
    const auto excess = [&](double a) {
        return elastic_catenary_point({a, 0, 0}, elastic_length, 0.5 * length).x - 0.5 * span;
    };
    double high = span;
    while (excess(high) < 0) high *= 2;
    Catenary curve{bisect(std::numeric_limits<double>::min(), high, excess), 0, 0};
    curve.sag = elastic_catenary_point(curve, elastic_length, 0.5 * length).y;
    curve.tension = std::hypot(curve.a, 0.5 * length);
    return curve;
}

namespace {

/// The elastica seen from the tip: delta = pi/2 - theta over u = 1 - s obeys delta'' = gamma u sin(delta), a
/// growing solution, so the clamp's delta = pi/2 fixes the tip's delta well even where it is 1e-9.
struct ElasticaState {
    double delta, slope, drop, reach;  // drop = integral of cos(delta), reach = integral of sin(delta)
};

ElasticaState slope_of(const ElasticaState& s, double u, double gamma) {
    return {s.slope, gamma * u * std::sin(s.delta), std::cos(s.delta), std::sin(s.delta)};
}

ElasticaState moved(const ElasticaState& s, const ElasticaState& d, double h) {
    return {s.delta + h * d.delta, s.slope + h * d.slope, s.drop + h * d.drop, s.reach + h * d.reach};
}

/// Integrates from the tip to the clamp, nothing when delta passes pi/2 on the way. `visit` sees every node, tip too.
template <class Visit>
std::optional<ElasticaState> shoot(double gamma, double tip_delta, std::uint32_t segments, const Visit& visit) {
    ElasticaState s{tip_delta, 0, 0, 0};
    const double h = 1.0 / segments;
    visit(s);
    for (std::uint32_t k = 0; k < segments; ++k) {
        const double u = k * h;
        const ElasticaState k1 = slope_of(s, u, gamma);
        const ElasticaState k2 = slope_of(moved(s, k1, h / 2), u + h / 2, gamma);
        const ElasticaState k3 = slope_of(moved(s, k2, h / 2), u + h / 2, gamma);
        const ElasticaState k4 = slope_of(moved(s, k3, h), u + h, gamma);
        s = moved(moved(moved(moved(s, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
        if (s.delta > pi / 2 + 1e-6) return std::nullopt;
        visit(s);
    }
    return s;
}

}  // namespace

HeavyElastica heavy_elastica(double gamma, std::uint32_t segments) {
    if (!(gamma >= 0 && gamma <= 1e5) || segments == 0)
        throw std::invalid_argument("heavy_elastica: need 0 <= gamma <= 1e5 and a segment");
    const auto ignore = [](const ElasticaState&) {};
    const double logarithm = bisect(-600.0, std::log(pi / 2), [&](double x) {
        const std::optional<ElasticaState> end = shoot(gamma, std::exp(x), segments, ignore);
        return end ? end->delta - pi / 2 : 1.0;
    });
    const double tip_delta = gamma == 0 ? pi / 2 : std::exp(logarithm);
    std::vector<ElasticaState> nodes;
    shoot(gamma, tip_delta, segments, [&](const ElasticaState& s) { nodes.push_back(s); });
    const ElasticaState& clamp = nodes.back();
    HeavyElastica result{clamp.drop, clamp.reach, pi / 2 - tip_delta, {}};
    for (std::size_t k = nodes.size(); k-- > 0;)
        result.shape.push_back({clamp.reach - nodes[k].reach, clamp.drop - nodes[k].drop});
    return result;
}

double xpbd_oscillator_period(double compliance, double mass) { return 2 * pi * std::sqrt(compliance * mass); }

}  // namespace drape::closed_forms
