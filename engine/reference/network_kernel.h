// Computes the accelerations of a spring network fast: values lie in planes (all x, all y, all z), and springs in runs
// of neighbours, so that the compiler makes vector code.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "reference/spring_network.h"

namespace drape {

/// One value per particle and axis, axis by axis.
using Planes = std::array<std::vector<double>, 3>;

Planes to_planes(std::span<const Vec3> vectors);
std::vector<Vec3> from_planes(const Planes& planes);

class NetworkKernel {
  public:
    /// Copies the parts of `network` that it needs.
    explicit NetworkKernel(const SpringNetwork& network);

    /// Accelerations (m/s^2) of gravity, springs and bending at positions (m); particles without mass get 0.
    void accelerations(const Planes& position, Planes& acceleration) const;

  private:
    /// Springs first + i to second + i, i < count; their constants start at `constant`.
    struct Run {
        std::size_t first, second, count, constant;
    };
    void add_run(const Run& run, const Planes& position, Planes& force) const;

    std::vector<Run> runs_;
    std::vector<double> stiffness_, stiffness_times_rest_, compression_, inverse_mass_;
    std::vector<BendingElement> bending_;
    Vec3 gravity_;
};

}  // namespace drape
