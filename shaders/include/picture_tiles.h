// The picture is divided into square tiles, and a buffer says for each, row by row, whether anything may be drawn there
// (picture/picture_tiles.h). Only such tiles are cleared and processed.
#ifndef DRAPE_PICTURE_TILES_H
#define DRAPE_PICTURE_TILES_H

layout(constant_id = 21) const int picture_width = 1280;
layout(constant_id = 22) const int picture_height = 720;
layout(constant_id = 23) const int tile_shift = 5;  // a tile's side, pixels, is two to this power
const ivec2 tile_counts = ivec2(((picture_width - 1) >> tile_shift) + 1, ((picture_height - 1) >> tile_shift) + 1);

int tile_at(ivec2 tile) { return tile.y * tile_counts.x + tile.x; }

#endif
