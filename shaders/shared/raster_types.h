// Structs that the raster shaders and the C++ side share, in std430; every member's offset is compared with the SPIR-V
// when a pass is recorded. Colours are linear, lengths in metres.
#ifndef DRAPE_RASTER_TYPES_H
#define DRAPE_RASTER_TYPES_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

const int light_limit = 4;

/// Texels of the square shadow map's side.
const int shadow_map_size = 512;

/// The shadow map's depth, 0 to 1, spans eight radii of the scene; a texel is two radii over the number of texels.
const float shadow_texels_per_depth = 4.0f * float(shadow_map_size);

/// Columns along a side of the map of what stands above the floor (include/ground_columns.h), a multiple of 8, and
/// texels along a side of the map of its shade.
const int ground_side = 96;
const int ground_shade_side = 2 * ground_side;

/// The floor (include/floor.h) in its own coordinates, in which y is its normal and a place on it is (x, 0, z).
struct FloorConstants {
    vec4 ray[3];     // xyz: direction of sight at a pixel's place (x, y): [0] + x [1] + y [2], of any length
    vec4 eye;        // xyz: camera position; w: distance of the grid's lines, m
    vec4 shadow[3];  // xyz: texel x, y and depth in the shadow map, as dot(xyz, (x, z, 1))
    vec4 fade;       // xyz: centre of its fade into the backdrop; w: radius, m
    vec4 steady;     // xyz: radiance without the first light's; w: depth in the map from texel to texel along x
    vec4 first;      // xyz: radiance by the first light, where it arrives; w: depth from texel to texel along y
    vec4 shade;      // x, y: place of (0, 0, 0) in the map of its shade; z: texels of that per metre; w unused
};

/// Constants that all draws of a frame share.
struct FrameConstants {
    vec4 clip_from_world[4];    // rows
    vec4 shadow_from_world[3];  // rows: x, y in texels, z 0 (near the light) .. 1
    vec4 eye;                   // xyz: camera position; w: 0
    vec4 ambient;               // xyz: of the sky, linear; w: size of a shadow texel, m
    vec4 ground;                // xyz: ambient of the ground, linear; w: 1 where z is up in the world, 0 where y is
    vec4 background;            // xyz: radiance; w: height of the picture, pixels
    vec4 fade;                  // xyz: centre of the ground's fade; w: radius, m
    vec4 to_light[4];           // xyz: unit, towards the light
    vec4 light_radiance[4];     // xyz: linear colour times intensity
    vec4 above_floor;           // height above the floor: dot(xyz, place) + w, m; (0, 0, 0, 1): there is none
    FloorConstants floor;
};

// Values of `ClothPush::grid.z`.
const int pattern_plain = 0;
const int pattern_checker = 1;
const int pattern_stripes = 2;

/// Share of a texture's light that the back of a cloth shows, about that of the back's colour where nothing says it.
const float texture_back = 0.7f;

struct ClothPush {
    uvec4 grid;  // columns, rows, pattern, particles from one to those that a fold may lift above it
    vec4 size;   // x, y: metres along columns, rows; z: side of a pattern's square, m; w: thickness, m
    vec4 front;  // colour of the side the normals point to
    vec4 back;
    vec4 second;    // the pattern's other colour, on both sides; w: sheen
    vec4 fabric;    // x: spread (include/shading.h); y: metres from thread to thread, 0: none; z: width of the hem, m;
                    // w: its first particle in the list of places on panels, below 0: its particles are on the grid
    uvec4 texture;  // x: its first texel; y, z: width and height, powers of two, 0: none; w: 1 where the back shows it
};

struct ClothTilesPush {
    uvec4 grid;  // columns, rows, triangles; w unused
};

struct GroundColumnsPush {
    uvec4 grid;    // columns, rows, triangles; parts that an edge of a triangle is divided into
    vec4 rows[3];  // from a place in the world: column x, y of the map, and height above the floor, in columns' sides
};

/// Number of colours of a heat map, at even places from its low end to its high end.
const int heat_color_count = 256;

// Springs that a heat map looks at.
const int strain_of_both = 0;  // the most stretched
const int strain_of_warp = 1;  // along columns; strain of either sign counts
const int strain_of_weft = 2;  // along rows

struct StrainPush {
    uvec4 grid;    // columns, rows; z: its id in layers; w unused
    vec4 springs;  // x, y: rest lengths along columns, rows, m, 0: no such springs; z unused; w: thickness, m
    vec4 place;  // x s + y: place on the heat map; s: strain, or where z > 0 w log(1 + z strain), of the strain's sign
};

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
