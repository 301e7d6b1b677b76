// Converts places of a grid, counted row by row.
#ifndef DRAPE_PLACES_H
#define DRAPE_PLACES_H

/// Divides `place` by `columns`. The default device divides integers lane by lane, so floats estimate the row, one off
/// at most where it is below 2^21.
ivec2 texel_of(int place, int columns) {
    precise float estimate = float(place) * (1.0f / float(columns));
    int row = int(estimate);
    int column = place - row * columns;
    int fewer = column < 0 ? 1 : 0, more = column >= columns ? 1 : 0;
    return ivec2(column + (fewer - more) * columns, row - fewer + more);
}

#endif
