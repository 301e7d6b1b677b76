// Which particle of a tile, and of the sheet, an invocation has: tiles overlap by 2 * `halo`. Needs `push.grid`.
bool within(ivec2 place, ivec2 size) { return place.x >= 0 && place.y >= 0 && place.x < size.x && place.y < size.y; }

ivec2 own_place() { return ivec2(gl_LocalInvocationID.xy); }

/// Of tiles at a border maybe outside the sheet.
ivec2 own_texel() { return ivec2(gl_WorkGroupID.xy) * (tile_width - 2 * halo) - halo + own_place(); }

/// `own_texel`; outside the sheet a particle of its border.
ivec2 loaded_texel() { return max(min(own_texel(), push.grid - 1), ivec2(0)); }

/// Whether the particle is this tile's to store: the halo is other tiles'.
bool is_own() { return within(own_texel(), push.grid) && within(own_place() - halo, ivec2(tile_width - 2 * halo)); }
