// Shapes of the tiles of explicit micro-steps (explicit_tile.comp), of relaxation (spring_tile.comp) and of twist
// (twist_tile.comp).
#ifndef DRAPE_TILE_TYPES_H
#define DRAPE_TILE_TYPES_H

#ifdef __cplusplus
namespace drape::glsl {
#endif

// Particles a side, an invocation each. Explicit steps were measured to be faster in small tiles, of few steps at once
// (docs/devices.md); relaxation and twist need a wide halo, which leaves less of a small tile.
const int explicit_tile_width = 16, sweep_tile_width = 32;
// Particles at every side of a tile that are of no use, none where a tile holds the whole cloth: one per micro-step or
// colour of twist, in relaxation one per pass that leads along the side's normal.
const int explicit_tile_halo = 2, spring_tile_halo = 6, twist_tile_halo = 4;
const int tile_most_steps = 64;  // most micro-steps of a cloth that one tile holds

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
