// Where TOGETHER is defined, cloths lie below each other in the images of their state, and a workgroup's z selects the
// cloth (include/present.h); texels are counted within a cloth. The includer has `push.grid`.
#include "include/present.h"
#ifdef TOGETHER
ivec2 placed(ivec2 texel) { return ivec2(texel.x, texel.y + int(cloth_place()) * push.grid.y); }
/// A cloth has one row of cells less than of particles.
ivec2 placed_cell(ivec2 cell) { return ivec2(cell.x, cell.y + int(cloth_place()) * (push.grid.y - 1)); }
#else
#define placed(texel) (texel)
#endif
#define LOAD(name, texel) imageLoad(name, placed(texel))
