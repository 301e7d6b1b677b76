// What stands above the floor, seen from above as a map of square columns: of each the lowest and the highest point, in
// units of a column's side, as bits of floats, which are in order as integers because none is negative. Nothing is in a
// column whose lowest point is `no_height`. Three coarser maps follow, each with half as many columns a side, which
// hold the extremes of four.
#ifndef DRAPE_GROUND_COLUMNS_H
#define DRAPE_GROUND_COLUMNS_H

const uint no_height = 0xffffffffu;
const int ground_levels = 4;

/// Returns the number of the first column of a map, 0 being the finest.
int ground_level(int level) {
    return (4 * ground_side * ground_side - ((4 * ground_side * ground_side) >> (2 * level))) / 3;
}

#endif
