// Shapes of the tiles of explicit micro-steps (explicit_tile.comp), of relaxation (spring_tile.comp) and of twist
// (twist_tile.comp).
#ifndef DRAPE_TILE_TYPES_H
#define DRAPE_TILE_TYPES_H

#ifdef __cplusplus
namespace drape::glsl {
#endif

const int tile_width = 32;  // particles a side, an invocation each
// Particles at every side of a tile that are of no use, none where a tile holds the whole cloth: one per micro-step or
// colour of twist, in relaxation one per pass that leads along the side's normal.
const int tile_halo = 4, spring_tile_halo = 6;
const int tile_most_steps = 64;  // most micro-steps of a cloth that one tile holds

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
