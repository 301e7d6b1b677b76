// The share that a particle makes of its motion: its own, or that of its cloth where this goes on as a whole. The
// includer has `cloth_shares`.
float share_made(float own, int owner, int round) {
    uint least = cloth_shares[owner * self_cloth_words + 1 + round];
    return cloth_shares[owner * self_cloth_words] != 0u ? uintBitsToFloat(least) : own;
}
