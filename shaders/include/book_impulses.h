// Adds to a cloth's sums of impulses (include/impulses.h). The includer defines IMPULSES_SLOT, the binding.
#include "include/impulses.h"
layout(constant_id = 32) const int impulse_rows = 0;  // of a cloth
layout(set = 0, binding = IMPULSES_SLOT, r32ui) uniform uimage2D impulses;

ivec2 impulse_place(int row, int number) { return ivec2(2 * number, int(cloth_place()) * impulse_rows + row); }

/// Returns the units to a metre of an inner particle's motion in a substep.
float impulse_units() { return uintBitsToFloat(imageLoad(impulses, impulse_place(impulse_head, 0)).x); }

void book(int row, int number, ImpulseWords words) {
    if ((words.low | words.high) == 0u) return;
    ivec2 place = impulse_place(row, number);
    uint before = imageAtomicAdd(impulses, place, words.low);
    uint carry = before + words.low < before ? 1u : 0u;
    imageAtomicAdd(impulses, place + ivec2(1, 0), words.high + carry);
}

/// Adds to three numbers of a row, from the `first` on.
void book(int row, int first, ImpulseSum sum) {
    book(row, first, words_of(sum.x));
    book(row, first + 1, words_of(sum.y));
    book(row, first + 2, words_of(sum.z));
}
