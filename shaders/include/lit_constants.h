// The constants of the frame and of the cloth that fragments of lit surfaces read. On a CPU they are flat inputs of the
// triangle, one value each, since its compiler loads constants of a buffer, and push constants, lane by lane in
// fragments. A GPU passes every input lane by lane, so there fragments read the constants directly (docs/devices.md).
#ifndef DRAPE_LIT_CONSTANTS_H
#define DRAPE_LIT_CONSTANTS_H

#include "shared/raster_types.h"

/// The members are those of FrameConstants. Together with the surfaces' own inputs and ClothLook they take 22
/// locations; Vulkan guarantees 16.
struct LitConstants {
    vec4 eye;
    vec4 ambient;
    vec4 ground;
    vec4 to_light[light_limit];
    vec4 light_radiance[light_limit];
    vec4 shadow_from_world[3];
};

/// Colours of a cloth's two sides, and of the pattern on both. front.w: side of the pattern's squares, m; back.w: the
/// number of the pattern; second.w: sheen; fabric: ClothPush::fabric.
struct ClothLook {
    vec4 front, back, second, fabric;
};

ClothLook cloth_look(ClothPush push) {
    return ClothLook(vec4(push.front.xyz, push.size.z), vec4(push.back.xyz, float(push.grid.z)), push.second,
                     push.fabric);
}

const int lit_location = 4;                                    // the first after the surfaces' own
const int look_location = lit_location + 6 + 2 * light_limit;  // after LitConstants

#endif
