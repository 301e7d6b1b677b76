#include "cloth/stiffness_constants.h"

#include <cmath>

namespace drape {

StiffnessConstants stiffness_constants(const Stiffness& stiffness, const std::array<double, 2>& spacing) {
    const double dx = spacing[0], dy = spacing[1];
    const WarpWeft stretch = stiffness.rigid ? rigid_stiffness : stiffness.stretch;
    const double shear = stiffness.rigid ? rigid_stiffness : stiffness.shear;
    StiffnessConstants constants;
    for (std::size_t direction = 0; direction < spring_directions.size(); ++direction) {
        const SpringDirection& row = spring_directions[direction];
        constants.spring[direction] = row.family == SpringFamily::shear ? shear * (dx * dx + dy * dy) / (2 * dx * dy)
                                      : row.offset.y == 0               ? stretch.warp * dy / dx
                                                                        : stretch.weft * dx / dy;
        constants.rest_length[direction] = std::hypot(row.offset.x * dx, row.offset.y * dy);
    }
    const Rigidity& bend = stiffness.bend;
    constants.twist = 2 * bend.twist / (dx * dy);
    constants.bend = {bend.warp * dy / (dx * dx * dx), bend.weft * dx / (dy * dy * dy)};
    return constants;
}

}  // namespace drape
