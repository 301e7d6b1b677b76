#include "reference/implicit_reference.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "fmt/format.h"
#include "reference/reference_cache.h"
#include "reference/sparse_system.h"

namespace drape {

namespace {

/// Implicit midpoint: the unknown is the middle position q = x + h v_m/2, with v_m = v + h/2 (a(q) - c v_m). It solves
///   (4/h^2)(1 + c h/2) M (q - x) - (2/h) M v + grad E(q) - F_outer(q, v_m) - M g'(t) = 0,
/// with g' what gravity is more than at the start.
class MidpointRun {
  public:
    MidpointRun(const SpringNetwork& network, const ImplicitOptions& options)
        : network_(network), options_(options), state_(network.start()) {
        begin_interval();
    }

    void advance(double end, double step) {
        const double span = end - time_;
        if (span <= 0) return;
        const double count = std::max(1.0, std::ceil(span / step * (1 - 1e-12)));
        if (!(count < 1e12)) throw std::invalid_argument("implicit reference: too many steps");
        if (span / count != step_) factorised_ = false;
        step_ = span / count;
        const double begin = time_;
        for (std::uint64_t n = 1; n <= static_cast<std::uint64_t>(count); ++n)
            make_step(begin + span * (static_cast<double>(n) / count));
        time_ = end;
        begin_interval();
    }

    const NetworkState& state() const { return state_; }

  private:
    void begin_interval() {
        auto system = std::make_unique<SparseSystem>(network_, time_);
        if (system_ && system->free_particles() == system_->free_particles()) return;
        system_ = std::move(system);
        factorised_ = false;
    }

    double inertia() const { return 4 / (step_ * step_) * (1 + 0.5 * network_.damping * step_); }

    Eigen::VectorXd residual(const std::vector<Vec3>& middle, double middle_time) const {
        std::vector<Vec3> sum = network_.gradient(middle);
        std::vector<Vec3> outer(sum.size(), Vec3{});
        if (network_.has_outer_forces()) {
            std::vector<Vec3> velocity = state_.velocity;
            for (const std::uint32_t p : system_->free_particles())
                for (std::size_t k = 0; k < 3; ++k) velocity[p][k] = 2 / step_ * (middle[p][k] - state_.position[p][k]);
            for (const std::uint32_t p : moved_) velocity[p] = network_.pinned_velocity(p, middle_time);
            network_.add_outer_forces(middle, velocity, middle_time, outer);
        }
        const Vec3 more = network_.more_gravity(middle_time);
        for (const std::uint32_t p : system_->free_particles())
            for (std::size_t k = 0; k < 3; ++k)
                sum[p][k] += network_.mass[p] * (inertia() * (middle[p][k] - state_.position[p][k]) -
                                                 2 / step_ * state_.velocity[p][k] - more[k]) -
                             outer[p][k];
        return system_->gather(sum);
    }

    void factorise(const std::vector<Vec3>& middle) {
        if (!system_->factorise(middle, HessianForm::exact, inertia()) &&
            !system_->factorise(middle, HessianForm::clamped, inertia()))
            throw std::runtime_error("implicit reference: no factorisation");
        factorised_ = true;
    }

    void solve(std::vector<Vec3>& middle, double middle_time) {
        if (!factorised_) factorise(middle);
        double before = INFINITY;
        for (int iteration = 0; iteration < 200; ++iteration) {
            const Eigen::VectorXd step = system_->solve(-residual(middle, middle_time));
            const double moved = largest_vector(step);
            if (!std::isfinite(moved)) break;
            system_->add_to(middle, step, 1);
            if (moved <= options_.position_tolerance) return;
            // At the floor of rounding corrections stop shrinking, and no better solution can be had.
            if (iteration > 2 && moved > 0.9 * before && moved <= 100 * options_.position_tolerance) return;
            if (moved > 0.2 * before) factorise(middle);
            before = moved;
        }
        throw std::runtime_error(fmt::format("implicit reference: no convergence at {} s; take a smaller step", time_));
    }

    void make_step(double end) {
        const double middle_time = 0.5 * (time_ + end);
        moved_.clear();
        std::vector<Vec3> middle = state_.position;
        for (std::uint32_t p = 0; p < network_.particle_count(); ++p)
            if (network_.mass[p] > 0 && network_.pin_of[p] >= 0 && network_.held(p, time_)) {
                moved_.push_back(p);
                middle[p] = network_.pinned_position(p, middle_time);
            }
        for (const std::uint32_t p : system_->free_particles())
            for (std::size_t k = 0; k < 3; ++k) middle[p][k] += 0.5 * step_ * state_.velocity[p][k];
        solve(middle, middle_time);
        for (const std::uint32_t p : system_->free_particles())
            for (std::size_t k = 0; k < 3; ++k) {
                const double half = middle[p][k] - state_.position[p][k];
                state_.position[p][k] += 2 * half;
                state_.velocity[p][k] = 4 / step_ * half - state_.velocity[p][k];
            }
        for (const std::uint32_t p : moved_) {
            state_.position[p] = network_.pinned_position(p, end);
            state_.velocity[p] = network_.pinned_velocity(p, end);
        }
        time_ = end;
    }

    const SpringNetwork& network_;
    const ImplicitOptions& options_;
    NetworkState state_;
    std::unique_ptr<SparseSystem> system_;
    std::vector<std::uint32_t> moved_;  ///< held in this step
    double time_ = 0, step_ = 0;
    bool factorised_ = false;
};

}  // namespace

std::vector<NetworkState> implicit_states(const SpringNetwork& network, std::span<const double> times, double step,
                                          const ImplicitOptions& options) {
    check_times(times);
    if (!(step > 0)) throw std::invalid_argument("implicit reference: the step must be positive");
    MidpointRun run(network, options);
    std::vector<NetworkState> states;
    for (const TimeSpanEnd& end : span_ends(network, times)) {
        run.advance(end.time, step);
        if (end.wanted) states.push_back(run.state());
        if (options.progress && times.back() > 0) options.progress(end.time / times.back());
    }
    return states;
}

ReferenceRun run_implicit(const SpringNetwork& network, std::span<const double> times, const ImplicitOptions& options) {
    const auto states_at = [&](double step, const ReferenceProgress& progress) {
        ImplicitOptions with_progress = options;
        with_progress.progress = progress;
        return implicit_states(network, times, step, with_progress);
    };
    return refine("implicit midpoint", options.step, times, states_at, options.progress);
}

std::string implicit_key(const SpringNetwork& network, std::span<const double> times, const ImplicitOptions& options) {
    return reference_key("implicit midpoint 1", network, times,
                         {{"step", options.step}, {"tolerance", options.position_tolerance}});
}

}  // namespace drape
