// Converts the index of a place on a grid, counted row by row, to its column and row.
#ifndef DRAPE_PLACES_H
#define DRAPE_PLACES_H

/// Returns the texel at `place`, in rows of `columns`. The default device divides integers lane by lane, so floats
/// estimate the row, which below 2^21 is at most one off.
ivec2 texel_of(int place, int columns) {
    precise float estimate = float(place) * (1.0f / float(columns));
    int row = int(estimate);
    int column = place - row * columns;
    int fewer = column < 0 ? 1 : 0, more = column >= columns ? 1 : 0;
    return ivec2(column + (fewer - more) * columns, row - fewer + more);
}

#endif
