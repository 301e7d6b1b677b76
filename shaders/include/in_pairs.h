// Walks along a line. `statement`, a call, runs `count` times, twice in each round: on the default device all values
// that one round passes to the next are blended and moved. A statement that branches costs another such blend, so
// callers treat a line's ends before and after the walk. The loop, of at least one round, has its test at the bottom
// (include/every.h).
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
