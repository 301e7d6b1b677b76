// A walk along a line that takes two of its members a round: `place` goes from `first` by `step`, 1 or -1, until
// `goes_on` no longer holds for the next, and one further where their number is odd, where the body must store nothing;
// of no members it takes two all the same. On the default device all that one round hands to the next is blended and
// moved, a twelfth of a line pass where each takes one; the inner loop, whose bounds are constants, the driver unrolls
// (spirv-opt would lose what is precise). It ends at its bottom (include/every.h).
#define SOME_AT_A_TIME(place, first, step) \
    int place##_round = (first);           \
    do                                     \
        for (int place##_within = 0, place = place##_round; place##_within < 2; ++place##_within, place += (step))
#define WHILE_SOME_ARE_LEFT(place, step, goes_on) while ((place##_round += 2 * (step)) goes_on)
