// The tests of the double-precision reference share these networks and small linear algebra on positions.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "reference/spring_network.h"
#include "support/sheets.h"

namespace drape::test {

using model_scenes::swing;

/// A chain of `links` equal springs in a line along `direction` (unit) from the origin. Its first particle is pinned,
/// inner particles have mass density/links and end particles half that, as at the border of a cloth.
inline SpringNetwork chain(std::uint32_t links, double length, double density, double axial_stiffness,
                           const Vec3& direction) {
    SpringNetwork network;
    network.pins.emplace_back();
    for (std::uint32_t p = 0; p <= links; ++p) {
        const double at = length * p / links;
        network.rest_position.push_back({at * direction[0], at * direction[1], at * direction[2]});
        network.mass.push_back(density * length / links * (p == 0 || p == links ? 0.5 : 1.0));
        network.pin_of.push_back(p == 0 ? 0 : -1);
        if (p > 0)
            network.springs.push_back(
                {p - 1, p, axial_stiffness * links / length, length / links, SpringFamily::stretch});
    }
    return network;
}

/// Positions with every coordinate moved by at most `size`, from a seed.
inline std::vector<Vec3> shaken(std::vector<Vec3> positions, double size, unsigned seed) {
    std::mt19937 random(seed);
    for (Vec3& x : positions)
        for (double& c : x) c += size * (2 * (static_cast<double>(random()) / 4294967295.0) - 1);
    return positions;
}

/// Returns the least slope of log(error) over log(size) between neighbours.
inline double least_order(const std::vector<double>& sizes, const std::vector<double>& errors) {
    double least = INFINITY;
    for (std::size_t k = 1; k < sizes.size(); ++k)
        least = std::min(least, std::log(errors[k] / errors[k - 1]) / std::log(sizes[k] / sizes[k - 1]));
    return least;
}

}  // namespace drape::test
