// The frame's and the cloth's constants that fragments of lit surfaces read go with the triangle as flat inputs, which
// are one value each; the default device's compiler loads a buffer's constants, and pushed ones, lane by lane in
// fragments (docs/devices.md).
#ifndef DRAPE_LIT_CONSTANTS_H
#define DRAPE_LIT_CONSTANTS_H

#include "shared/raster_types.h"

/// The members are those of FrameConstants. With the surfaces' own inputs and ClothLook they take 21 of the device's
/// locations; Vulkan guarantees 16.
struct LitConstants {
    vec4 eye;
    vec4 ambient;
    vec4 ground;
    vec4 to_light[light_limit];
    vec4 light_radiance[light_limit];
    vec4 shadow_from_world[3];
};

/// Colours of a cloth's two sides, and of the pattern on both. front.w: side of the pattern's square, m; back.w: which
/// pattern.
struct ClothLook {
    vec4 front, back, second;
};

const int lit_location = 4;                                    // the first behind the surfaces' own
const int look_location = lit_location + 6 + 2 * light_limit;  // behind LitConstants

#endif
