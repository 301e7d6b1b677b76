// A sweep says what bounds its time.
#include "sweep/bound.h"

#include <gtest/gtest.h>

namespace drape::sweep {
namespace {

TEST(Bound, IsTheProcessorsWhereTheyHaveNoTimeLeft) {
    EXPECT_EQ(bound_text(19, 10, 2), "2 cores were 95 % busy: the processors bounded the time");
    EXPECT_EQ(bound_text(8, 10, 1), "the core was 80 % busy: the processors bounded the time");
    EXPECT_EQ(bound_text(3, 10, 16), "16 cores were 2 % busy: the device, other programs or the disk bounded the time");
}

TEST(Bound, IsNotToldOfAMoment) { EXPECT_EQ(Occupancy(1).text(), ""); }

}  // namespace
}  // namespace drape::sweep
