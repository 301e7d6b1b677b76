#include "cloth/spring_tension.h"

#include <cmath>
#include <limits>

#include "base/vectors.h"
#include "cloth/directions.h"
#include "cloth/texels.h"
#include "world/weather.h"

namespace drape {

namespace {

/// Calls `take` with each particle, each direction, the particle at the other end of the spring there, and the share
/// that the cells give to its stiffness, where that is above 0.
template <class Take>
void for_each_spring(const CutTopology& topology, const Take& take) {
    const Grid& grid = topology.cloth().grid;
    for (std::uint32_t row = 0; row < grid.rows(); ++row)
        for (std::uint32_t column = 0; column < grid.columns(); ++column) {
            const std::size_t here = grid.particle(column, row);
            glsl::vec4 shares = topology.masked() ? topology.whole_spring_shares()[here]
                                                  : topology.cloth().grid.spring_shares(column, row);
            for (std::size_t direction = 0; direction < spring_directions.size(); ++direction) {
                const float share = component(shares, direction);
                if (!(share > 0)) continue;
                const glsl::ivec2 offset = spring_directions[direction].offset;
                const int x = static_cast<int>(column) + offset.x, y = static_cast<int>(row) + offset.y;
                if (x < 0 || x >= grid.size().x || y >= grid.size().y) continue;
                take(here, direction, grid.particle(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)),
                     double{share});
            }
        }
}

Vec3 place(std::span<const float> positions, std::size_t particle) {
    const float* const at = &positions[4 * particle];
    return {double{at[0]}, double{at[1]}, double{at[2]}};
}

/// Returns what balances a spring between two particles, as an extension of its whole stiffness, m.
double law(const ClothModel& cloth, std::span<const float> positions, std::size_t first, std::size_t second,
           std::size_t direction) {
    const auto flat = static_cast<float>(cloth.stiffness_constant.rest_length[direction]);
    const double excess = length(minus(place(positions, second), place(positions, first))) -
                          double{cloth.rest_length(flat, first, direction)};
    return excess < 0 ? excess * double{cloth.compression} : excess;
}

/// Returns the share of a spring's force that damping leaves in a substep: relaxation solves springs after it, as
/// contact is solved; the others count it in their compliance and in their stiffness.
double left_by_damping(const ClothModel& cloth) {
    const bool is_damped_before = !cloth.scheme.spare_state && !cloth.scheme.second_order;
    return is_damped_before ? damping_mean(cloth.damping, cloth.substep_length) : 1.0;
}

}  // namespace

bool keeps_tension(const ClothModel& cloth, std::size_t direction) {
    const MethodScheme& scheme = cloth.scheme;
    const double stiffness = scheme.used_stiffness[direction];
    const bool is_solved = !scheme.spare_state && stiffness > 0 && std::isfinite(stiffness);
    return is_solved && (scheme.carries_tension[direction] || direction < stretch_direction_count);
}

std::vector<float> spring_tensions(const SimulationModel& model, std::size_t index, const CutTopology& topology,
                                   std::uint32_t frame, std::span<const float> positions,
                                   const PerDirection<std::span<const float>>& kept) {
    const ClothModel& cloth = model.cloths[index];
    const double factor = cloth.stiffens ? stiffness_factor(model.scene, model.scene.cloths[index], frame) : 1.0;
    const double left = left_by_damping(cloth);
    std::vector<float> tensions(spring_directions.size() * cloth.grid.particle_count());
    for_each_spring(topology, [&](std::size_t first, std::size_t direction, std::size_t second, double share) {
        const double stiffness = factor * share * cloth.scheme.used_stiffness[direction] / left;
        float& tension = tensions[spring_directions.size() * first + direction];
        if (stiffness == 0) return;
        if (!std::isfinite(stiffness)) {
            tension = std::numeric_limits<float>::quiet_NaN();
            return;
        }
        const double extension =
            kept[direction].empty() ? law(cloth, positions, first, second, direction) : double{kept[direction][first]};
        tension = static_cast<float>(stiffness * extension);
    });
    return tensions;
}

std::vector<float> contact_forces(const SimulationModel& model, std::size_t index, std::span<const float> impulses) {
    const ClothModel& cloth = model.cloths[index];
    std::vector<float> forces(4 * cloth.grid.particle_count());
    // As of the sums of impulses, damping leaves a share of the force in a substep (cloth/forces.cpp).
    const double unit = cloth.inner_mass / cloth.substep_length * model.scene.time.fps /
                        damping_mean(cloth.damping, cloth.substep_length);
    for (std::size_t k = 0; k < impulses.size(); ++k)
        if (k % 4 != 3) forces[k] = static_cast<float>(unit * double{impulses[k]});
    return forces;
}

std::vector<std::uint8_t> spring_bits(const CutTopology& topology) {
    std::vector<std::uint8_t> bits(topology.cloth().grid.particle_count());
    for_each_spring(topology, [&](std::size_t first, std::size_t direction, std::size_t, double) {
        bits[first] = static_cast<std::uint8_t>(bits[first] | 1u << direction);
    });
    return bits;
}

}  // namespace drape
