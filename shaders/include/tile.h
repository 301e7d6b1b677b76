// Which particle of a tile, and of the sheet, an invocation has. Tiles overlap by 2 * `halo`. The includer has
// `push.grid` and `tile_width`, the particles along a side.
bool within(ivec2 place, ivec2 size) { return place.x >= 0 && place.y >= 0 && place.x < size.x && place.y < size.y; }

ivec2 own_place() { return ivec2(gl_LocalInvocationID.xy); }

/// Returns the invocation's texel, which at a border may be outside the sheet.
ivec2 own_texel() { return ivec2(gl_WorkGroupID.xy) * (tile_width - 2 * halo) - halo + own_place(); }

/// Returns the texel that the invocation loads: outside the sheet, that of a particle on its border.
ivec2 loaded_texel() { return max(min(own_texel(), push.grid - 1), ivec2(0)); }

/// Returns whether this tile stores the particle; other tiles store this one's halo.
bool is_own() { return within(own_texel(), push.grid) && within(own_place() - halo, ivec2(tile_width - 2 * halo)); }
