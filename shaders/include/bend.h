// Quadratic bending on the regular grid: three particles in a row or column, energy b/2 |x1 - 2 x2 + x3|^2, b = B w p/h^3
// with rigidity B, spacing h along the axis and p across it, w = 1/2 along a border (physics.md 2.10; Bergou et al. 2006
// for isometric surfaces). It is linear in the positions, so its elements are never singular.
#ifndef DRAPE_BEND_H
#define DRAPE_BEND_H

/// Second difference x1 - 2 x2 + x3 (m) from the two edges that leave the middle: small numbers from small numbers.
SHARED vec3 second_difference(vec3 edge_to_first, vec3 edge_to_third) {
    precise vec3 difference = edge_to_first + edge_to_third;
    return difference;
}

/// `sum` plus an element's pull: `factor` = 2 b on its middle, -b on its ends, times phi h^2/m_inner.
SHARED vec3 add_bend(vec3 sum, vec3 difference, float factor) {
    precise vec3 total = sum + difference * factor;
    return total;
}

/// Middle particle (column, row) of element `element` of one colour: every third along the axis, so that elements of a
/// colour share no particle.
SHARED ivec2 bend_middle(ivec2 element, ivec2 axis, int colour) {
    return ivec2(axis.x != 0 ? 3 * element.x + colour + 1 : element.x,
                 axis.y != 0 ? 3 * element.y + colour + 1 : element.y);
}

/// Share of an element whose two springs have the shares `first` and `second`: a missing spring bends no more.
SHARED float bend_share(float first, float second) { return first < second ? first : second; }

/// Inverse mass that an element feels.
SHARED float bend_weight(float weight_first, float weight_middle, float weight_third) {
    precise float weight = weight_first + 4.0f * weight_middle + weight_third;
    return weight;
}

/// Correction of one element, to be added to the ends times their w and to the middle times -2 w: one implicit step of
/// its energy, (w1 + 4 w2 + w3 + a/s) lambda = -difference (XPBD eq. 18 with the multiplier at zero, so once per
/// substep); a = `compliance` = m_inner/(b h^2), numerator and denominator times s = `share`. Stable for every a.
SHARED vec3 project_bend(vec3 difference, float weight_sum, float share, float compliance) {
    precise float denominator = share * weight_sum + compliance;
    precise vec3 correction = difference * (-share / denominator);
    return correction;
}

#endif
