#include "cloth/stiffness_constants.h"

#include <cmath>

namespace drape {

StiffnessConstants stiffness_constants(const Stiffness& stiffness, const std::array<double, 2>& spacing) {
    const double dx = spacing[0], dy = spacing[1];
    const double stretch = stiffness.rigid ? rigid_stiffness : stiffness.stretch;
    const double shear = stiffness.rigid ? rigid_stiffness : stiffness.shear;
    StiffnessConstants constants;
    for (std::size_t direction = 0; direction < spring_directions.size(); ++direction) {
        const SpringDirection& row = spring_directions[direction];
        const bool along_columns = row.offset.y == 0;
        constants.spring[direction] = row.family == SpringFamily::shear ? shear * (dx * dx + dy * dy) / (2 * dx * dy)
                                      : along_columns                   ? stretch * dy / dx
                                                                        : stretch * dx / dy;
        constants.rest_length[direction] = std::hypot(row.offset.x * dx, row.offset.y * dy);
    }
    constants.twist = 2 * stiffness.bend / (dx * dy);
    constants.bend = {stiffness.bend * dy / (dx * dx * dx), stiffness.bend * dx / (dy * dy * dy)};
    return constants;
}

}  // namespace drape
