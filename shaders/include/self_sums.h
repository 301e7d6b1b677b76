// Sums of impulses by place (include/self_impulse.h). Where `wide`, a 64-bit atomic adds both parts of a component,
// which halves the atomics. The includer defines SUMS_SLOT, the binding, and where it reads sums SUMS_IN_SLOT. Where it
// adds to them it has include/self_sewn.h.
layout(constant_id = 25) const bool wide = false;

#ifndef SUMS_SHEET
#define SUMS_SHEET push.grid  // columns, rows of the sheet
#endif

#ifdef SUMS_SLOT
/// Returns the index of the first of the two vectors of a place's sum.
int sum_at(int which, int place) { return 2 * (which * SUMS_SHEET.x * SUMS_SHEET.y + place); }
layout(set = 0, binding = SUMS_SLOT, std430) buffer WideSums { u64vec2 sums_out[]; }
wide_sums;
layout(set = 0, binding = SUMS_SLOT, std430) buffer Sums { uvec4 sums_out[]; }
sums;
uint64_t whole(ivec2 parts) { return uint64_t(int64_t(parts.x) + int64_t(parts.y) * 1048576l); }
void add_parts(int which, uint corner, SelfParts parts) {
    int at = sum_at(which, leader_of(place_of(self_texel(corner))));
    if (wide) {
        atomicAdd(wide_sums.sums_out[at].x, whole(parts.x));
        atomicAdd(wide_sums.sums_out[at].y, whole(parts.y));
        atomicAdd(wide_sums.sums_out[at + 1].x, whole(parts.z));
        return;
    }
    atomicAdd(sums.sums_out[at].x, uint(parts.x.x));
    atomicAdd(sums.sums_out[at].y, uint(parts.x.y));
    atomicAdd(sums.sums_out[at].z, uint(parts.y.x));
    atomicAdd(sums.sums_out[at].w, uint(parts.y.y));
    atomicAdd(sums.sums_out[at + 1].x, uint(parts.z.x));
    atomicAdd(sums.sums_out[at + 1].y, uint(parts.z.y));
}
/// Adds the weight with which a pair holds a corner, and counts the pair.
void add_weight(uint corner, uint weight) {
    int at = sum_at(0, leader_of(place_of(self_texel(corner)))) + 1;
    if (wide) {
        atomicAdd(wide_sums.sums_out[at].y, uint64_t(weight) + 0x100000000ul);
        return;
    }
    atomicAdd(sums.sums_out[at].z, weight);
    atomicAdd(sums.sums_out[at].w, 1u);
}

/// Adds what a contact gives to each corner to a sum. `largest`: the largest thickness of its scene.
void add_impulse(int which, bool edges, uvec4 corners, vec4 weights, vec3 impulse, float largest) {
    SelfShares shares = self_shares(edges, weights, impulse, self_units_per_impulse(largest));
    add_parts(which, corners.x, shares.a);
    add_parts(which, corners.y, shares.b);
    add_parts(which, corners.z, shares.c);
    add_parts(which, corners.w, shares.d);
}

/// Adds half of a pair's couple to each of its two sides.
void add_couple(uvec4 corners, vec3 half_couple, float largest) {
    SelfParts parts = self_parts_of(half_couple, 1.0f, self_units_per_impulse(largest));
    add_parts(self_sum_of_couples, corners.x, parts);
    add_parts(self_sum_of_couples, corners.w, parts);
}
#endif
#ifdef SUMS_IN_SLOT
layout(set = 0, binding = SUMS_IN_SLOT, rgba32f) uniform readonly imageBuffer sums_in;  // integers, as bits

SelfSum sum_of(int which, int place) {
    int texel = 2 * (which * SUMS_SHEET.x * SUMS_SHEET.y + place);
    return SelfSum(floatBitsToUint(imageLoad(sums_in, texel)), floatBitsToUint(imageLoad(sums_in, texel + 1)));
}

float sum_value(uint first, uint second) {
    if (wide) return self_number(uvec2(first, second));
    return self_number(self_words(first, second));
}

/// Returns an impulse, in masses of the first cloth's particle times m. `largest`: the largest thickness of its scene.
vec3 impulse_of(SelfSum sum, float largest) {
    vec3 units =
        vec3(sum_value(sum.xy.x, sum.xy.y), sum_value(sum.xy.z, sum.xy.w), sum_value(sum.z_weight.x, sum.z_weight.y));
    return self_impulse_of(units, largest);
}
#endif
