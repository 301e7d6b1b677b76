// Computes where the samples of the field of a mesh that deforms are stored.
#ifndef DRAPE_FORM_SAMPLE_H
#define DRAPE_FORM_SAMPLE_H

#include "shared/form_types.h"

/// Returns the number of the sample that is `up` along y and `far` along z from this one in a texel; beyond the last
/// samples, this one's own.
SHARED int sample_beside(FormPush push, int x, int y, int z, int up, int far) {
    int above = y + up < push.size.y ? y + up : y, beyond = z + far < push.size.z ? z + far : z;
    return (beyond * push.size.y + above) * push.size.x + x;
}

#endif
