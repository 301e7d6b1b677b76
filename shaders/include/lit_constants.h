// The frame's and the cloth's constants that fragments of lit surfaces read. On a CPU they go with the triangle as flat
// inputs, which are one value each: its compiler loads a buffer's constants, and pushed ones, lane by lane in
// fragments. On a GPU, which takes every input lane by lane, they are read where they are (docs/devices.md).
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

ClothLook cloth_look(ClothPush push) {
    return ClothLook(vec4(push.front.xyz, push.size.z), vec4(push.back.xyz, float(push.grid.z)), push.second);
}

const int lit_location = 4;                                    // the first behind the surfaces' own
const int look_location = lit_location + 6 + 2 * light_limit;  // behind LitConstants

#endif
