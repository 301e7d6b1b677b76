// What self-contact does to a particle that it moves. HISTORY: it is at once as fast as it is left, and the cloth goes
// on in backward Euler substeps (include/bdf2.h). Needs `push.grid`; the includer has bindings 0 and 1.
#include "include/state_store.h"
VECTOR_OUT(2, DisplacementOut, displacement_out);
#ifdef HISTORY
VECTOR_KEPT(3, DisplacementBefore, displacement_before);
layout(set = 0, binding = 4, r32ui) uniform uimage2D control;
#endif

/// `moved`: its displacement so far, with what is beside it.
void touch(ivec2 texel, vec4 moved, vec3 displacement) {
    STORE_VECTOR(displacement_out, texel, vec4(displacement, moved.w));
#ifdef HISTORY
    STORE_VECTOR(displacement_before, texel, vec4(displacement, 0.0f));
    // Most that come here find it done.
    if (imageLoad(control, ivec2(control_hold, 0)).x < line_hold_contact)
        imageAtomicMax(control, ivec2(control_hold, 0), line_hold_contact);
#endif
}
