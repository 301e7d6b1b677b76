// How long a spring is at rest. Where a cloth rests in the shape that it starts in (own_rest), the image of spring
// shares is twice as wide as the grid: right of the shares of a row are the lengths that its particles' springs have at
// rest over those on flat cloth. The includer has `push.grid` and `spring_shares`.
layout(constant_id = 29) const bool own_rest = false;

/// `on_flat`: the spring's length at rest on flat cloth, m; `owner`: its first particle.
float length_at_rest(float on_flat, ivec2 owner, int channel) {
    precise float rest = on_flat;
    if (own_rest) rest = on_flat * LOAD(spring_shares, owner + ivec2(push.grid.x, 0))[channel];
    return rest;
}
