// A walk along a line that takes two of its members a round: `place` goes from `first` to `last` by `step`, 1 or -1,
// and one further where their number is odd, where the body must store nothing. On the default device all that one
// round hands to the next is blended and moved, a twelfth of a line pass where each takes one; the inner loop, whose
// bounds are constants, the driver unrolls (spirv-opt would lose what is precise).
#define FOR_SOME_AT_A_TIME(place, first, last, step)                                                  \
    for (int place##_round = (first); (step) > 0 ? place##_round <= (last) : place##_round >= (last); \
         place##_round += 2 * (step))                                                                 \
        for (int place##_within = 0, place = place##_round; place##_within < 2; ++place##_within, place += (step))
