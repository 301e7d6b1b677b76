// Shapes of the streams: of explicit micro-steps (explicit_stream.comp), of relaxation (spring_stream.comp), of the
// cells' twist (twist_stream.comp).
#ifndef DRAPE_STREAM_TYPES_H
#define DRAPE_STREAM_TYPES_H

#ifdef __cplusplus
namespace drape::glsl {
#endif

const int stream_lanes = 8;    // invocations of a subgroup, which is a strip of columns
const int stream_band = 128;   // rows of a strip at least that one takes, where there are so many (row_bands.h)
const int stream_columns = 5;  // columns of an invocation
const int stream_width = 40;   // of a strip
const int stream_steps = 4;    // in flight

const int spring_stream_columns = 6;  // of an invocation; even, so that which springs of a row are even is known ahead
const int spring_stream_width = 48;   // of a strip
const int spring_stream_halo =
    6;  // of its columns at either end are of no use: one per pass that leads along a row; even

const int twist_columns = 6;  // likewise
const int twist_width = 48;
const int twist_halo = 4;  // one per colour; even

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
