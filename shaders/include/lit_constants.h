// What fragments of lit surfaces read of the frame's constants. It goes with the triangle as flat inputs, which are one
// value each; the default device's compiler loads a buffer's constants lane by lane in fragments (docs/devices.md).
#ifndef DRAPE_LIT_CONSTANTS_H
#define DRAPE_LIT_CONSTANTS_H

#include "shared/raster_types.h"

/// Members as those of FrameConstants. With the surfaces' own inputs 18 places of four components, which
/// passes/raster.cpp asks the device for.
struct LitConstants {
    vec4 eye;
    vec4 ambient;
    vec4 ground;
    vec4 to_light[light_limit];
    vec4 light_radiance[light_limit];
    vec4 shadow_from_world[3];
};

const int lit_location = 4;  // the first behind the surfaces' own

#endif
