// Macros by which passes write the images of a cloth's state. Where `buffered`, they write through the images' buffer
// views, storage buffers in the same memory; on the default device image stores take longer (docs/devices.md). Loads
// use the images in either case. VECTOR_KEPT declares an image of which only some texels are written. TRIPLE_OUT and
// STORE_TRIPLE declare and update one in which the value beside xyz stays; a buffer needs no read for that. Images of
// COHERENT_... are read again by other invocations of the pass. The includer has `push.grid`. STORE_IN_COLUMNS and
// LOAD_IN_COLUMNS are for images with another number of columns, as the sheet of contact; the latter loads what
// VECTOR_KEPT declared.
#include "include/together.h"

layout(constant_id = 27) const bool buffered = false;

/// Returns the texels from one row of a buffer view to the next; rows begin at multiples of state_row_alignment bytes.
int vector_pitch(int columns) { return (columns + state_row_alignment / 16 - 1) & ~(state_row_alignment / 16 - 1); }
int vector_pitch() { return vector_pitch(push.grid.x); }
int scalar_pitch() { return (push.grid.x + state_row_alignment / 4 - 1) & ~(state_row_alignment / 4 - 1); }

struct StateTriple {
    vec3 xyz;
    float beside;
};

// An image and its view share a binding and a name; a pipeline uses only one of them.
#define VIEW(access, slot, type, name, view)                                                     \
    layout(set = 0, binding = slot, std430) access buffer name##_##view##_block { type name[]; } \
    name##_##view
#define IMAGE(access, slot, format, name) layout(set = 0, binding = slot, format) uniform access image2D name
#define VECTOR_OF(access, slot, name)   \
    IMAGE(access, slot, rgba32f, name); \
    VIEW(access, slot, vec4, name, vectors)
#define TRIPLE_OF(access, slot, name)   \
    IMAGE(access, slot, rgba32f, name); \
    VIEW(access, slot, StateTriple, name, triples)
#define SCALAR_OF(access, slot, name) \
    IMAGE(access, slot, r32f, name);  \
    VIEW(access, slot, float, name, scalars)
#define VECTOR_OUT(slot, name) VECTOR_OF(writeonly, slot, name)
#define VECTOR_KEPT(slot, name) VECTOR_OF(, slot, name)
#define TRIPLE_OUT(slot, name) TRIPLE_OF(writeonly, slot, name)
#define SCALAR_OUT(slot, name) SCALAR_OF(writeonly, slot, name)
#define COHERENT_TRIPLE_OUT(slot, name) TRIPLE_OF(coherent writeonly, slot, name)
#define COHERENT_SCALAR_OUT(slot, name) SCALAR_OF(coherent writeonly, slot, name)

#define STORE_BY(view_store, image_store) \
    {                                     \
        if (buffered)                     \
            view_store;                   \
        else                              \
            image_store;                  \
    }
#define STORE_VECTOR(name, texel, value)                                                \
    STORE_BY(name##_vectors.name[placed(texel).y * vector_pitch() + (texel).x] = value, \
             imageStore(name, placed(texel), value))
#define STORE_TRIPLE(name, texel, value, beside)                                            \
    STORE_BY(name##_triples.name[placed(texel).y * vector_pitch() + (texel).x].xyz = value, \
             imageStore(name, placed(texel), vec4(value, beside)))
#define STORE_SCALAR(name, texel, value)                                                \
    STORE_BY(name##_scalars.name[placed(texel).y * scalar_pitch() + (texel).x] = value, \
             imageStore(name, placed(texel), vec4(value, 0.0f, 0.0f, 0.0f)))
#define STORE_IN_COLUMNS(name, texel, columns, value) \
    STORE_BY(name##_vectors.name[(texel).y * vector_pitch(columns) + (texel).x] = value, imageStore(name, texel, value))
#define LOAD_VECTOR(result, name, texel)                                                 \
    STORE_BY(result = name##_vectors.name[placed(texel).y * vector_pitch() + (texel).x], \
             result = imageLoad(name, placed(texel)))
#define LOAD_IN_COLUMNS(result, name, texel, columns)                                     \
    STORE_BY(result = name##_vectors.name[(texel).y * vector_pitch(columns) + (texel).x], \
             result = imageLoad(name, texel))
