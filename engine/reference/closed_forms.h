// Closed forms that a cloth solver can be measured against, for every row of the accuracy benchmark that has one: plain
// functions of SI values in double precision, exact to a few roundings unless a docstring says otherwise.
#pragma once

#include <cstdint>
#include <vector>

namespace drape::closed_forms {

/// phi(z) = (1 - e^(-z))/z: the mean of e^(-z s) over s in 0..1. phi(0) = 1.
double damping_mean(double z);
/// psi(z) = (1 - phi(z))/z: displacement of a damped start from rest, in units of a t^2. psi(0) = 1/2.
double damping_lag(double z);

// --- Flight -----------------------------------------------------------------------------------------------------

/// Displacement (m) after `time` (s) from velocity v0 (m/s) under constant acceleration a (m/s^2) and damping c
/// (1/s): v0 t phi(c t) + a t^2 psi(c t). c = 0 is ballistic flight.
double flight_displacement(double v0, double acceleration, double damping, double time);
/// Velocity (m/s) of that flight after `time`: v0 e^(-c t) + a t phi(c t).
double flight_velocity(double v0, double acceleration, double damping, double time);
/// x(0) - x(-h): the displacement of the substep before the start that makes every later substep of
/// d' = e^(-c h) d + phi h^2 a exact.
double flight_start_displacement(double v0, double acceleration, double damping, double h);
/// Position after n steps of x' = x + k (x - x_before) + a with a factor k per step (the 2004 slides):
/// x0 + v0 k (1 - k^n)/(1 - k) + a/(1 - k) [n - k (1 - k^n)/(1 - k)], v0 = x_0 - x_(-1) and a in metres per step.
double factor_damped_fall(double x0, double step_velocity, double step_acceleration, double factor, std::uint64_t n);

/// Distance (m) slid from rest down an incline of `angle` (rad) with Coulomb friction mu: g t^2 (sin - mu cos)/2,
/// 0 when mu >= tan(angle).
double incline_distance(double gravity, double angle, double friction, double time);
/// Polar angle (rad from the top) where a particle sliding without friction leaves a sphere of `radius`, started at
/// start_angle with speed v0: cos = 2/3 cos(start) + v0^2/(3 g R). Returns start_angle when it leaves at once.
double sphere_leave_angle(double start_angle, double v0, double gravity, double radius);

// --- Pendulum ---------------------------------------------------------------------------------------------------

/// Complete elliptic integral of the first kind of modulus k (0 <= k < 1), by the arithmetic-geometric mean.
double complete_elliptic_k(double k);
/// Period (s) of a pendulum released from rest at `amplitude` (rad, below pi): 4 K(sin(amplitude/2)) sqrt(L/g), which
/// is 1.180340599 times 2 pi sqrt(L/g) at 90 degrees.
double pendulum_period(double length, double gravity, double amplitude);
/// Angle (rad) of that pendulum at `time` (s): sin(angle/2) = k sn(K + sqrt(g/L) t, k).
double pendulum_angle(double length, double gravity, double amplitude, double time);

// --- Hanging cloth and chains -----------------------------------------------------------------------------------

/// Tension (N) of link `link` (0 = top) of a hanging column of `links` links whose particles have mass m (kg), on which
/// everything below hangs: (links - link) m g; with half_end_mass (Drape's borders) half a particle less.
double hanging_link_tension(std::uint32_t links, std::uint32_t link, double mass, double gravity, bool half_end_mass);
/// Static length (m) of that column of springs of `stiffness` (N/m) and total rest length `length`.
double hanging_length(std::uint32_t links, double length, double stiffness, double mass, double gravity,
                      bool half_end_mass);

/// Measured factors on `stretch_law`, which itself is the mean of a sheet with stretch springs only.
inline constexpr double law_all_passes_mean = 0.65, law_all_passes_rms = 0.83, law_chain_rms = 1.6,
                        law_chain_worst = 3.9;
/// Mean strain of a hanging sheet of rigid stretch springs that parity-split passes leave: N^2 g h^2/(2 K L), with N
/// links over height L (m), K iterations per substep of h (s). Measured sheets keep to it within 0.4 % for N = 32..128.
double stretch_law(std::uint32_t links, double gravity, double substep, std::uint32_t iterations, double length);
/// Substeps per frame of 1/fps seconds at which `stretch_law` times `factor` is at most `strain`.
std::uint32_t stretch_law_substeps(std::uint32_t links, double gravity, double fps, std::uint32_t iterations,
                                   double length, double strain, double factor = 1.0);

/// n-th positive zero of the Bessel function J0, n from 1.
double bessel_j0_zero(std::uint32_t n);
/// Angular frequency (rad/s) of small mode n (from 1) of a uniform hanging chain: (j_(0,n)/2) sqrt(g/L).
double hanging_chain_frequency(std::uint32_t n, double length, double gravity);
/// Shape of small mode n of a hanging chain at height z above the free end, 1 there: J0(j_(0,n) sqrt(z/L)).
double hanging_chain_shape(std::uint32_t n, double length, double height);

/// Mode n (from 1) of a taut string of `links` links of length l (m), particle mass m (kg), tension T (N), rad/s:
/// 2 sqrt(T/(m l)) sin(n pi/(2 links)). Exact for the discrete string.
double taut_string_frequency(std::uint32_t n, std::uint32_t links, double tension, double mass, double link_length);
/// Mode n of the continuous string of length L (m) and linear density (kg/m), rad/s: (n pi/L) sqrt(T/rho).
double string_frequency(std::uint32_t n, double length, double tension, double linear_density);
/// Mode (m, n) of a square membrane with side a (m), tension T (N/m), areal density rho (kg/m^2), rad/s:
/// (pi/a) sqrt(T/rho) sqrt(m^2 + n^2).
double membrane_frequency(std::uint32_t m, std::uint32_t n, double side, double tension, double areal_density);

// --- Catenary ---------------------------------------------------------------------------------------------------

/// A chain hanging between two supports at equal height. `a` is horizontal tension / weight per length (m).
struct Catenary {
    double a;        ///< m
    double sag;      ///< m below the supports
    double tension;  ///< at the supports, per weight per unit length: m
};
/// Inextensible chain of `length` over `span`. Throws std::invalid_argument unless 0 < span < length.
Catenary catenary(double span, double length);

struct PlanePoint {
    double x, y;  ///< m
};
/// Point of the catenary at signed arc length s (m) from its lowest point, which is (0, 0).
PlanePoint catenary_point(const Catenary& curve, double s);

/// Elastic chain of rest length `length` and axial stiffness EA given as `elastic_length` = EA / (weight per rest
/// length), m; `a` and `tension` are per weight per *rest* length. elastic_length -> infinity gives `catenary`.
Catenary elastic_catenary(double span, double length, double elastic_length);
/// Point of the elastic catenary at signed rest arc length s (m) from its lowest point, which is (0, 0).
PlanePoint elastic_catenary_point(const Catenary& curve, double elastic_length, double s);

// --- Cantilever -------------------------------------------------------------------------------------------------

/// The heavy elastica: a strip clamped horizontally at one end, bending under its own weight, in units of its
/// length. gamma = w L^3/B: weight per length times cubed length over bending rigidity.
struct HeavyElastica {
    double drop;                    ///< H/L: tip below the clamp
    double reach;                   ///< W/L: tip away from the clamp
    double tip_angle;               ///< rad below the horizontal
    std::vector<PlanePoint> shape;  ///< from the clamp (0, 0) to the tip, equally spaced in arc length, y downward
    double ratio() const { return drop / reach; }
};
/// Solves theta'' = -gamma (1 - s) cos(theta), theta(0) = 0, theta'(1) = 0 by shooting from the tip with `segments`
/// fourth-order Runge-Kutta steps. 0 <= gamma <= 1e5; with 4096 segments H/W is right to 1e-9 relative up to gamma =
/// 1000.
HeavyElastica heavy_elastica(double gamma, std::uint32_t segments = 4096);

// --- XPBD -------------------------------------------------------------------------------------------------------

/// Period (s) of a mass (kg) on a spring of compliance (m/N): 2 pi sqrt(compliance mass).
double xpbd_oscillator_period(double compliance, double mass);

}  // namespace drape::closed_forms
