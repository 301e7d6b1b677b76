// Shape of the streams of explicit micro-steps (explicit_stream.comp).
#ifndef DRAPE_STREAM_TYPES_H
#define DRAPE_STREAM_TYPES_H

#ifdef __cplusplus
namespace drape::glsl {
#endif

const int stream_lanes = 8;    // invocations of a subgroup, which is a strip of columns
const int stream_columns = 5;  // columns of an invocation
const int stream_width = 40;   // of a strip
const int stream_steps = 4;    // in flight

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
