// Impulses are summed as integers, each particle's part rounded by itself, so that the order in which a device adds
// them changes no bit.
#ifndef DRAPE_IMPULSES_H
#define DRAPE_IMPULSES_H

#include "include/spring.h"
#include "shared/impulse_types.h"

/// A 64-bit integer.
struct ImpulseWords {
    uint low, high;
};

/// The sum of a number's parts on the particles of an invocation, 64 at most: high * 2^24 + low.
struct ImpulseNumber {
    int high, low;
};

/// A vector of them.
struct ImpulseSum {
    ImpulseNumber x, y, z;
};

SHARED ImpulseWords words_sum(ImpulseWords a, ImpulseWords b) {
    uint low = a.low + b.low;
    return ImpulseWords(low, a.high + b.high + (low < a.low ? 1u : 0u));
}

SHARED ImpulseWords words_difference(ImpulseWords a, ImpulseWords b) {
    return words_sum(a, ImpulseWords(~b.low + 1u, ~b.high + (b.low == 0u ? 1u : 0u)));
}

/// Returns an integer as a number. The halves of words are exact, whatever a device makes of the others.
SHARED float words_number(ImpulseWords words) {
    bool negative = (words.high & 0x80000000u) != 0u;
    ImpulseWords size = words;
    if (negative) size = words_difference(ImpulseWords(0u, 0u), words);
    precise float low = float(size.low >> 16u) * 65536.0f + float(size.low & 0xffffu);
    precise float high = float(size.high >> 16u) * 65536.0f + float(size.high & 0xffffu);
    precise float number = high * 4294967296.0f + low;
    return negative ? -number : number;
}

SHARED float squared_impulse(ImpulseWords x, ImpulseWords y, ImpulseWords z) {
    vec3 numbers = vec3(words_number(x), words_number(y), words_number(z));
    return ordered_dot(numbers, numbers);
}

SHARED ImpulseSum no_impulse() {
    ImpulseNumber none = ImpulseNumber(0, 0);
    return ImpulseSum(none, none, none);
}

SHARED ImpulseWords words_of(ImpulseNumber sum) {
    return words_sum(ImpulseWords(uint(sum.high) << 24u, uint(sum.high >> 8)),
                     ImpulseWords(uint(sum.low), sum.low < 0 ? ~0u : 0u));
}

/// Returns the sum with the integer nearest to a part; what is 2^49 or more counts as nothing. Processors convert
/// signed numbers several times as fast as unsigned ones.
SHARED ImpulseNumber with_part(ImpulseNumber sum, float part) {
    precise float counted = abs(part) < 562949953421312.0f ? part : 0.0f;
    precise float in_high = counted * 5.9604644775390625e-8f;  // 2^-24
    int high = int(in_high);
    precise float rest = counted - float(high) * 16777216.0f;
    precise float low = rest + (rest < 0.0f ? -0.5f : 0.5f);
    return ImpulseNumber(sum.high + high, sum.low + int(low));
}

/// Returns a particle's momentum, its mass in units of an inner particle's times h, m. `excess`: of end_velocity.h.
SHARED vec3 momentum_of(vec3 displacement, vec3 excess, float mass) {
    precise vec3 momentum = (displacement + excess) * mass;
    return momentum;
}

SHARED vec3 moment_of_mass(vec3 position, float mass) {
    precise vec3 moment = position * mass;
    return moment;
}

/// Returns the sum with a particle's part, of which each unit of `units` counts.
SHARED ImpulseSum with_impulse(ImpulseSum sum, vec3 part, float units) {
    precise vec3 scaled = part * units;
    return ImpulseSum(with_part(sum.x, scaled.x), with_part(sum.y, scaled.y), with_part(sum.z, scaled.z));
}

/// Returns the sum of what a pin gives to a cloth with what holds one spring of its particle, from which `edge` leads.
/// `tension`: its extension of its whole stiffness, m; `pull`: of MomentumPush, for this spring.
SHARED vec3 with_held_spring(vec3 sum, vec3 edge, float tension, float pull) {
    precise float squared = ordered_dot(edge, edge);
    if (!(squared > 0.0f)) return sum;
    precise vec3 held = sum - edge * (tension * pull / sqrt(squared));
    return held;
}

/// Returns the tension that balances a spring, m.
SHARED float tension_of_edge(vec3 edge, float rest_length, float compression) {
    precise float excess = sqrt(ordered_dot(edge, edge)) - rest_length;
    return balancing_tension(excess, compression);
}

/// Returns the units to a newton that acts for a substep.
SHARED float units_per_newton(float units, float inverse_step, float inner_mass) {
    precise float per_newton = units / (inverse_step * inverse_step * inner_mass);
    return per_newton;
}

/// Returns what a collider gives to a particle's motion in a substep, without what leads it out of an overlap, m.
SHARED vec3 given_by_collider(vec3 after, vec3 led, vec3 before) {
    precise vec3 given = (after - led) - before;
    return given;
}

/// Returns the moment of what is given to a particle's motion about a point, m^2.
SHARED vec3 moment_about(vec3 start, vec3 displacement, vec3 about, vec3 given) {
    precise vec3 arm = (start - about) + displacement;
    return ordered_cross(arm, given);
}

/// Returns what contact between cloths gives to a particle's motion in a substep, m.
SHARED vec3 given_by_contact(vec3 after, vec3 before) {
    precise vec3 given = after - before;
    return given;
}

/// Returns the sum of impulses with one more.
SHARED vec3 more_impulse(vec3 sum, vec3 impulse) {
    precise vec3 more = sum + impulse;
    return more;
}

SHARED vec3 impulse_of_motion(vec3 given, float mass) {
    precise vec3 impulse = given * mass;
    return impulse;
}

#endif
