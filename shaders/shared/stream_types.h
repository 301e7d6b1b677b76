// Shapes of the streams: explicit micro-steps (explicit_stream.comp), relaxation (spring_stream.comp), the cells' twist
// (twist_stream.comp).
#ifndef DRAPE_STREAM_TYPES_H
#define DRAPE_STREAM_TYPES_H

#ifdef __cplusplus
namespace drape::glsl {
#endif

const int stream_lanes = 8;    // invocations of a subgroup, which is a strip of columns
const int stream_band = 128;   // least rows of a strip that one takes, where there are so many (row_bands.h)
const int stream_columns = 5;  // columns of an invocation
const int stream_width = 40;   // columns of a strip
const int stream_steps = 4;    // steps in flight

const int spring_stream_columns =
    6;  // columns of an invocation; even, so that which springs of a row are even is known ahead
const int spring_stream_width = 48;  // columns of a strip
const int spring_stream_halo =
    6;  // useless columns at either end of a strip: one per pass that leads along a row; even

const int twist_columns = 6;  // columns of an invocation; even, so that which cells of a row are even is known ahead
const int twist_width = 48;
const int twist_halo = 4;  // useless columns at either end of a strip: one per colour; even

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
