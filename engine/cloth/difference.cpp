#include "cloth/difference.h"

#include <algorithm>
#include <cmath>

namespace drape {

std::uint32_t difference_count(const Grid& grid) {
    constexpr auto width = static_cast<std::uint32_t>(glsl::workgroup_width);
    constexpr auto rows = static_cast<std::uint32_t>(glsl::difference_rows);
    return (grid.columns() + width - 1) / width * ((grid.rows() + rows - 1) / rows);
}

double difference_of(std::span<const glsl::DifferenceRecord> partials) {
    double moved = 0, mass = 0;
    for (const glsl::DifferenceRecord& record : partials) {
        moved += record.moved;
        mass += record.mass;
    }
    return mass > 0 ? std::sqrt(moved / mass) : 0.0;
}

double difference_with_bodies(double of_cloth, std::span<const float> squares) {
    double largest = of_cloth;
    // A NaN stays one.
    for (const float square : squares) largest = square <= largest * largest ? largest : std::sqrt(double{square});
    return largest;
}

float disturbance(const ClothModel& cloth) {
    const double side =
        std::max(cloth.spacing[0] * (cloth.grid.columns() - 1), cloth.spacing[1] * (cloth.grid.rows() - 1));
    return 1e-6f * static_cast<float>(side);
}

}  // namespace drape
