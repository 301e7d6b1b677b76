// Where a cloth is in the images of its state. TOGETHER: cloths lie below each other there, and a workgroup's z says
// whose it is (engine/cloth/together.h); texels are told within a cloth. Needs `push.grid`.
#ifdef TOGETHER
ivec2 placed(ivec2 texel) { return ivec2(texel.x, texel.y + int(gl_WorkGroupID.z) * push.grid.y); }
/// Of a cell: there is one row less of them.
ivec2 placed_cell(ivec2 cell) { return ivec2(cell.x, cell.y + int(gl_WorkGroupID.z) * (push.grid.y - 1)); }
#else
#define placed(texel) (texel)
#endif
#define LOAD(name, texel) imageLoad(name, placed(texel))
