// Passes write the images of a cloth's state by these macros, where BUFFERED through their buffer views, storage
// buffers of the same memory; on the default device image stores take longer (docs/devices.md). Loads go through the
// images either way. VECTOR_KEPT declares an image whose texels are not all written; TRIPLE_OUT and STORE_TRIPLE one
// that is updated in place where the value `beside` xyz stays, which a buffer need not be told. The includer has
// `push.grid`. STORE_IN_COLUMNS and LOAD_IN_COLUMNS are for images of other columns, as the sheet of contact; the
// latter loads what VECTOR_KEPT declared.
#include "include/together.h"
#ifdef BUFFERED
/// Texels from one row of a buffer view to the next; rows begin at multiples of state_row_alignment bytes.
int vector_pitch(int columns) { return (columns + state_row_alignment / 16 - 1) & ~(state_row_alignment / 16 - 1); }
int vector_pitch() { return vector_pitch(push.grid.x); }
int scalar_pitch() { return (push.grid.x + state_row_alignment / 4 - 1) & ~(state_row_alignment / 4 - 1); }
#define VECTOR_OUT(slot, block, name) \
    layout(set = 0, binding = slot, std430) writeonly buffer block { vec4 name[]; }
struct StateTriple {
    vec3 xyz;
    float beside;
};
#define TRIPLE_OUT(slot, block, name) \
    layout(set = 0, binding = slot, std430) writeonly buffer block { StateTriple name[]; }
#define SCALAR_OUT(slot, block, name) \
    layout(set = 0, binding = slot, std430) writeonly buffer block { float name[]; }
#define VECTOR_KEPT(slot, block, name) \
    layout(set = 0, binding = slot, std430) buffer block { vec4 name[]; }
#define LOAD_IN_COLUMNS(name, texel, columns) name[(texel).y * vector_pitch(columns) + (texel).x]
#define STORE_VECTOR(name, texel, value) name[placed(texel).y * vector_pitch() + (texel).x] = value
#define STORE_IN_COLUMNS(name, texel, columns, value) name[(texel).y * vector_pitch(columns) + (texel).x] = value
#define STORE_TRIPLE(name, texel, value, beside) name[placed(texel).y * vector_pitch() + (texel).x].xyz = value
#define STORE_SCALAR(name, texel, value) name[placed(texel).y * scalar_pitch() + (texel).x] = value
#else
#define VECTOR_OUT(slot, block, name) layout(set = 0, binding = slot, rgba32f) uniform writeonly image2D name
#define TRIPLE_OUT VECTOR_OUT
#define SCALAR_OUT(slot, block, name) layout(set = 0, binding = slot, r32f) uniform writeonly image2D name
#define VECTOR_KEPT(slot, block, name) layout(set = 0, binding = slot, rgba32f) uniform image2D name
#define LOAD_IN_COLUMNS(name, texel, columns) imageLoad(name, texel)
#define STORE_VECTOR(name, texel, value) imageStore(name, placed(texel), value)
#define STORE_IN_COLUMNS(name, texel, columns, value) imageStore(name, texel, value)
#define STORE_TRIPLE(name, texel, value, beside) imageStore(name, placed(texel), vec4(value, beside))
#define STORE_SCALAR(name, texel, value) imageStore(name, placed(texel), vec4(value, 0.0f, 0.0f, 0.0f))
#endif
