// The particles on the sheet, as the passes of contact read them.
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D positions;  // w: inverse mass
layout(set = 0, binding = 1,
       rgba32f) uniform readonly image2D displacements;  // w: bits of what exists (self_gather.comp)
#include "include/self_cloths.h"
