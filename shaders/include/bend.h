// Quadratic bending on the regular grid. Three particles in a row or column have energy b/2 |x1 - 2 x2 + x3|^2, with b
// = B w p/h^3, rigidity B, spacing h along the axis and p across it, w = 1/2 along a border (docs/physics.md 4; Bergou
// et al. 2006 for isometric surfaces); the corners of a cell t/2 |x00 - x10 - x01 + x11|^2, t = 2 B/(dx dy). The sum
// tends to B/2 times the integral of kxx^2 + kyy^2 + 2 kxy^2, the isotropic plate of Poisson's ratio 0: as stiff in
// every direction. Its forces are linear in the positions, so its elements are never singular.
#ifndef DRAPE_BEND_H
#define DRAPE_BEND_H

/// Returns the second difference x1 - 2 x2 + x3 (m). It is computed from the two edges that leave the middle particle,
/// which are small numbers.
SHARED vec3 second_difference(vec3 edge_to_first, vec3 edge_to_third) {
    precise vec3 difference = edge_to_first + edge_to_third;
    return difference;
}

/// Returns a difference minus the difference at rest, m.
SHARED vec3 beyond_rest(vec3 difference, vec3 target) {
    precise vec3 beyond = difference - target;
    return beyond;
}

/// Returns `sum` plus the pull of an element. `factor` is 2 b for the element's middle and -b for its ends, or, for a
/// twist, -t for the corners 00 and 11 and t for 10 and 01; each multiplied by phi h^2/m_inner.
SHARED vec3 add_bend(vec3 sum, vec3 difference, float factor) {
    precise vec3 total = sum + difference * factor;
    return total;
}

/// Returns the middle particle (column, row) of element `element` of one colour. A colour contains every third element
/// along the axis, so that its elements share no particle.
SHARED ivec2 bend_middle(ivec2 element, ivec2 axis, int colour) {
    return ivec2(axis.x != 0 ? 3 * element.x + colour + 1 : element.x,
                 axis.y != 0 ? 3 * element.y + colour + 1 : element.y);
}

/// Returns the share of an element whose two springs have the shares `first` and `second`; an element with a missing
/// spring does not bend.
SHARED float bend_share(float first, float second) { return first < second ? first : second; }

/// Returns the twist x00 - x10 - x01 + x11 (m) of a cell from its upper edge x10 - x00 and its lower one x11 - x01.
SHARED vec3 twist_difference(vec3 upper_edge, vec3 lower_edge) {
    precise vec3 difference = lower_edge - upper_edge;
    return difference;
}

/// Returns the upper left corner of cell `element` of one colour. A colour contains every second cell along both axes,
/// so that its cells share no particle. `first`: the colour's first cell, 0 or 1 along each axis.
SHARED ivec2 twist_corner(ivec2 element, ivec2 first) {
    return ivec2(2 * element.x + first.x, 2 * element.y + first.y);
}

/// Returns the factor of the cell's stiffness if the cell is whole, otherwise 0: a missing or cut cell has no twist.
/// The arguments are the spring shares of three of its corners, which own its four sides (x: rows, y: columns) and its
/// two diagonals (z, w). The diagonals reveal a hole of one cell, whose sides all belong to neighbours too.
SHARED float twist_share(vec4 upper_left, vec4 upper_right, vec4 lower_left) {
    bool sides = upper_left.x > 0.0f && upper_left.y > 0.0f && upper_right.y > 0.0f && lower_left.x > 0.0f;
    return sides && upper_left.z > 0.0f && upper_right.w > 0.0f ? upper_left.z : 0.0f;
}

/// Returns the inverse mass that a cell's twist acts on.
SHARED float twist_weight(float upper_left, float upper_right, float lower_left, float lower_right) {
    precise float weight = (upper_left + upper_right) + (lower_left + lower_right);
    return weight;
}

/// Returns the inverse mass that an element acts on.
SHARED float bend_weight(float weight_first, float weight_middle, float weight_third) {
    precise float weight = weight_first + 4.0f * weight_middle + weight_third;
    return weight;
}

/// Returns the correction of one element. The caller adds it to each particle times its w and its coefficient (1 -2 1,
/// or, for a twist, 1 on the corners 00 and 11, -1 on 10 and 01). It is one implicit step of the element's energy,
/// (`weight_sum` + a/s) lambda = -difference (XPBD eq. 18 with the multiplier at zero, so once per substep), a =
/// `compliance` = m_inner/(b h^2), with numerator and denominator times s = `share`. It is stable for every a.
SHARED vec3 project_bend(vec3 difference, float weight_sum, float share, float compliance) {
    precise float denominator = share * weight_sum + compliance;
    precise vec3 correction = difference * (-share / denominator);
    return correction;
}

#endif
