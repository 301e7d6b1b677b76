// The rest length of a spring. Where a cloth rests in the shape in which it starts (own_rest), the image of spring
// shares is twice as wide as the grid: to the right of a row's shares are the rest lengths of its particles' springs,
// divided by those of flat cloth. The includer has `push.grid` and `spring_shares`.
layout(constant_id = 29) const bool own_rest = false;

/// `on_flat`: the spring's rest length on flat cloth, m; `owner`: its first particle.
float length_at_rest(float on_flat, ivec2 owner, int channel) {
    precise float rest = on_flat;
    if (own_rest) rest = on_flat * LOAD(spring_shares, owner + ivec2(push.grid.x, 0))[channel];
    return rest;
}
