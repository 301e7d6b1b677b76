// Walks along a line. `statement`, a call, is run `count` times, two of them a round: on the default device all that
// one round hands to the next is blended and moved. A statement that branches costs another such blend, so callers
// treat a line's ends before and after the walk. The loop, of one round at least, ends at its bottom (include/every.h).
#define IN_PAIRS(count, statement)     \
    {                                  \
        int rounds_left = (count) / 2; \
        if (rounds_left > 0) {         \
            do {                       \
                statement;             \
                statement;             \
                --rounds_left;         \
            } while (rounds_left > 0); \
        }                              \
        if (((count)&1) != 0) {        \
            statement;                 \
        }                              \
    }
