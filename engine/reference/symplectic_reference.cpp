#include "reference/symplectic_reference.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fmt/format.h"
#include "reference/closed_forms.h"
#include "reference/network_kernel.h"
#include "reference/reference_cache.h"

namespace drape {

namespace {

/// Runs interval by interval, between releases, while the same particles are held; moving ones follow their pins.
class SymplecticRun {
  public:
    explicit SymplecticRun(const SpringNetwork& network) : network_(network), kernel_(network) {
        const NetworkState start = network.start();
        position_ = to_planes(start.position);
        velocity_ = to_planes(start.velocity);
        free_.resize(network.particle_count());
        begin_interval();
    }

    /// Integrates to `end` in even steps of at most `step`; `tell` hears the time now and then.
    void advance(double end, double step, const std::function<void(double)>& tell) {
        const double span = end - time_;
        if (span <= 0) return;
        const double count = std::max(1.0, std::ceil(span / step * (1 - 1e-12)));
        if (!(count < 1e15)) throw std::invalid_argument("symplectic reference: too many steps");
        const auto steps = static_cast<std::uint64_t>(count);
        set_step(span / count);
        const double begin = time_;
        for (std::uint64_t n = 1; n <= steps; ++n) {
            time_ = n == steps ? end : begin + span * (static_cast<double>(n) / count);
            make_step();
            if (n % 64 == 0) tell(time_);
        }
        check_finite();
        begin_interval();  // a release may lie here
    }

    NetworkState state() const { return {from_planes(position_), from_planes(velocity_)}; }

  private:
    void begin_interval() {
        moved_.clear();
        for (std::uint32_t p = 0; p < network_.particle_count(); ++p) {
            const bool held = network_.held(p, time_);
            free_[p] = held ? 0.0 : 1.0;
            if (held && network_.mass[p] > 0 && network_.has_moving_pins()) moved_.push_back(p);
        }
        find_acceleration(velocity_);
    }

    void set_step(double h) {
        using namespace closed_forms;
        const double z = network_.damping * h, phi = damping_mean(z), psi = damping_lag(z);
        drift_velocity_ = phi * h;
        drift_acceleration_ = psi * h * h;
        kick_displacement_ = std::exp(-z) / (phi * h);
        kick_acceleration_ = (phi - psi) / phi * h;
        decay_ = std::exp(-z);
    }

    void make_step() {
        const std::size_t count = free_.size();
        const bool driven = network_.has_outer_forces();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double *x = position_[axis].data(), *v = velocity_[axis].data();
            const double* a = acceleration_[axis].data();
            moved_by_[axis].resize(count);
            double* u = moved_by_[axis].data();
            for (std::size_t p = 0; p < count; ++p) {
                u[p] = drift_velocity_ * v[p] + drift_acceleration_ * a[p];
                x[p] += u[p];
            }
            if (driven)
                for (std::size_t p = 0; p < count; ++p) v[p] = decay_ * v[p] + drift_velocity_ * a[p];
        }
        follow_pins();
        find_acceleration(velocity_);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double* v = velocity_[axis].data();
            const double *a = acceleration_[axis].data(), *u = moved_by_[axis].data();
            for (std::size_t p = 0; p < count; ++p)
                v[p] = free_[p] * (kick_displacement_ * u[p] + kick_acceleration_ * a[p]);
        }
        for (const std::uint32_t p : moved_) set_velocity(p, network_.pinned_velocity(p, time_));
    }

    void follow_pins() {
        for (const std::uint32_t p : moved_) {
            const Vec3 at = network_.pinned_position(p, time_);
            for (std::size_t axis = 0; axis < 3; ++axis) position_[axis][p] = at[axis];
            set_velocity(p, network_.pinned_velocity(p, time_));
        }
    }

    void set_velocity(std::uint32_t p, const Vec3& velocity) {
        for (std::size_t axis = 0; axis < 3; ++axis) velocity_[axis][p] = velocity[axis];
    }

    void find_acceleration(const Planes& velocity) {
        kernel_.accelerations(position_, acceleration_);
        if (network_.has_outer_forces()) {
            std::vector<Vec3> force(free_.size(), Vec3{});
            network_.add_outer_forces(from_planes(position_), from_planes(velocity), time_, force);
            for (std::size_t p = 0; p < free_.size(); ++p)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    if (network_.mass[p] > 0) acceleration_[axis][p] += force[p][axis] / network_.mass[p];
        }
        const Vec3 more = network_.more_gravity(time_);
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t p = 0; p < free_.size(); ++p)
                acceleration_[axis][p] = (acceleration_[axis][p] + more[axis]) * free_[p];
    }

    void check_finite() const {
        for (const std::vector<double>& plane : position_)
            for (const double x : plane)
                if (!std::isfinite(x))
                    throw std::runtime_error(fmt::format("symplectic reference diverged before {} s", time_));
    }

    const SpringNetwork& network_;
    NetworkKernel kernel_;
    double time_ = 0;
    Planes position_, velocity_, acceleration_, moved_by_;
    std::vector<double> free_;          ///< 1 or 0
    std::vector<std::uint32_t> moved_;  ///< held by pins that move
    double drift_velocity_ = 0, drift_acceleration_ = 0, kick_displacement_ = 0, kick_acceleration_ = 0, decay_ = 1;
};

}  // namespace

double symplectic_step(const SpringNetwork& network, const SymplecticOptions& options) {
    if (!(options.cfl > 0 && options.cfl <= 0.24))
        throw std::invalid_argument("symplectic reference: cfl must be above 0 and at most 0.24");
    const double frequency = network.highest_frequency_bound();
    return frequency > 0 ? options.cfl * 2 / frequency : 1e-3;
}

std::vector<NetworkState> symplectic_states(const SpringNetwork& network, std::span<const double> times, double step,
                                            const ReferenceProgress& progress) {
    check_times(times);
    SymplecticRun run(network);
    std::vector<NetworkState> states;
    const auto tell = [&](double time) {
        if (progress && times.back() > 0) progress(time / times.back());
    };
    for (const TimeSpanEnd& end : span_ends(network, times)) {
        run.advance(end.time, step, tell);
        if (end.wanted) states.push_back(run.state());
        tell(end.time);
    }
    return states;
}

ReferenceRun run_symplectic(const SpringNetwork& network, std::span<const double> times,
                            const SymplecticOptions& options) {
    const auto states_at = [&](double step, const ReferenceProgress& progress) {
        return symplectic_states(network, times, step, progress);
    };
    return refine("symplectic Verlet", symplectic_step(network, options), times, states_at, options.progress);
}

std::string symplectic_key(const SpringNetwork& network, std::span<const double> times,
                           const SymplecticOptions& options) {
    return reference_key("symplectic 1", network, times, {{"cfl", options.cfl}});
}

}  // namespace drape
