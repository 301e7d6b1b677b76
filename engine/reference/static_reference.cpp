// Solves statics, the minimum of the potential energy.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reference/implicit_reference.h"
#include "reference/sparse_system.h"
#include "world/weather.h"

namespace drape {

namespace {

class EnergyMinimiser {
  public:
    EnergyMinimiser(const SpringNetwork& network, std::span<const Vec3> start, const StaticOptions& options)
        : network_(network), options_(options), system_(network, options.time) {
        if (start.size() != network.particle_count())
            throw std::invalid_argument("find_equilibrium: the start has another particle count");
        result_.position.assign(start.begin(), start.end());
        for (std::uint32_t p = 0; p < network.particle_count(); ++p)
            if (network.held(p, options.time)) result_.position[p] = network.pinned_position(p, options.time);
        // The smallest shift is small against one that resists a particle as gravity's pull does over the cloth's size.
        double extent = 1e-3;
        for (const Vec3& x : result_.position)
            for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, std::abs(x[k] - result_.position[0][k]));
        smallest_shift_ =
            1e-2 * std::max(std::hypot(network.gravity[0], network.gravity[1], network.gravity[2]), 1.0) / extent;
    }

    StaticResult run() {
        energy_ = network_.potential_energy(result_.position);
        gradient_ = system_.gather(network_.gradient(result_.position));
        while (!result_.converged && result_.iterations < options_.iteration_limit && system_.unknown_count() > 0) {
            ++result_.iterations;
            if (!iterate()) break;
        }
        if (system_.unknown_count() == 0) result_.converged = result_.minimum = true;
        result_.residual = largest_vector(gradient_);
        result_.energy = energy_;
        return result_;
    }

  private:
    /// Solves for a descent direction with the exact Hessian, else with the exact one and a shift (which leaves a
    /// saddle fast), else with the clamped one.
    void find_step(Eigen::VectorXd& step) {
        exact_ = system_.factorise(result_.position, HessianForm::exact, shift_);
        double added = 0;
        for (int tries = 0; !exact_ && tries < 6; ++tries) {
            added = std::max(smallest_shift_, 8 * added);
            if (system_.factorise(result_.position, HessianForm::exact, shift_ + added)) break;
            if (tries == 5) added = 0;
        }
        if (!exact_ && added == 0)
            while (!system_.factorise(result_.position, HessianForm::clamped, shift_))
                shift_ = std::max(smallest_shift_, 8 * shift_);
        step = system_.solve(-gradient_);
    }

    /// Makes one step; returns false when no step lowers the energy any more.
    bool iterate() {
        Eigen::VectorXd step;
        find_step(step);
        result_.last_step = largest_vector(step);
        const double slope = gradient_.dot(step);
        for (double fraction = 1; fraction > 1e-12; fraction *= 0.5) {
            std::vector<Vec3> tried = result_.position;
            system_.add_to(tried, step, fraction);
            const double energy = network_.potential_energy(tried);
            const Eigen::VectorXd gradient = system_.gather(network_.gradient(tried));
            // Where the energy cannot tell any more, the gradient's norm decides.
            const bool indistinct = std::abs(slope) <= 1e-11 * std::abs(energy_);
            const bool better =
                energy <= energy_ + 1e-4 * fraction * slope || (indistinct && gradient.norm() <= gradient_.norm());
            const bool done = shift_ == 0 && fraction == 1 && result_.last_step <= options_.position_tolerance;
            if (!better && !done) continue;
            result_.position = std::move(tried);
            energy_ = energy;
            gradient_ = gradient;
            result_.converged = done;
            result_.minimum = exact_;
            adapt_shift(fraction);
            return true;
        }
        const bool hopeless = shift_ > 1e12 * smallest_shift_;
        shift_ = std::max(smallest_shift_, 64 * shift_);
        return !hopeless;
    }

    /// Adapts the shift: short steps mean that the quadratic model reaches too far.
    void adapt_shift(double fraction) {
        if (fraction < 0.2)
            shift_ = std::max(smallest_shift_, 4 * shift_);
        else if (fraction == 1)
            shift_ = shift_ > smallest_shift_ ? shift_ / 8 : 0;
    }

    const SpringNetwork& network_;
    const StaticOptions& options_;
    SparseSystem system_;
    StaticResult result_;
    Eigen::VectorXd gradient_;
    double energy_ = 0, shift_ = 0, smallest_shift_ = 0;  ///< J, 1/s^2
    bool exact_ = false;                                  ///< the last step came from the exact Hessian (and shift_)
};

/// Share of the spring stiffness at which the weight stretches the cloth by about a tenth; at most 1.
double softest_share(const SpringNetwork& network) {
    double weight = 0, stiffness = 0, low[3] = {INFINITY, INFINITY, INFINITY}, extent = 0;
    const double gravity = std::hypot(network.gravity[0], network.gravity[1], network.gravity[2]);
    for (const double m : network.mass) weight += m * gravity;
    for (const NetworkSpring& spring : network.springs) stiffness = std::max(stiffness, spring.stiffness);
    for (std::size_t k = 0; k < 3; ++k) {
        for (const Vec3& x : network.rest_position) low[k] = std::min(low[k], x[k]);
        for (const Vec3& x : network.rest_position) extent = std::max(extent, x[k] - low[k]);
    }
    return weight > 0 && stiffness * extent > 0 ? std::min(1.0, 10 * weight / (stiffness * extent)) : 1.0;
}

}  // namespace

StaticResult find_equilibrium(const SpringNetwork& network, std::span<const Vec3> start, const StaticOptions& options) {
    constexpr double always = std::numeric_limits<double>::infinity();
    if (!is_steady(network.gravity_keys, -always, always))
        throw std::invalid_argument("static reference: where gravity changes, nothing comes to rest");
    if (!network.loads.empty()) throw std::invalid_argument("static reference: it knows no loads");
    if (!network.gas.empty()) throw std::invalid_argument("static reference: it knows no gas");
    std::vector<Vec3> from(start.begin(), start.end());
    std::uint32_t iterations = 0;
    if (options.soften_first)
        for (double share = softest_share(network); share < 0.5; share *= 10) {
            SpringNetwork soft = network;
            for (NetworkSpring& spring : soft.springs) spring.stiffness *= share;
            StaticOptions loose = options;
            loose.position_tolerance = std::max(options.position_tolerance, 1e-4);
            const StaticResult stage = EnergyMinimiser(soft, from, loose).run();
            iterations += stage.iterations;
            from = stage.position;
        }
    StaticResult result = EnergyMinimiser(network, from, options).run();
    result.iterations += iterations;
    return result;
}

StaticResult find_equilibrium(const SpringNetwork& network, const StaticOptions& options) {
    return find_equilibrium(network, network.rest_position, options);
}

}  // namespace drape
