// Where the particles of a cloth start.
#pragma once

#include <vector>

#include "drape/scene.h"

namespace drape {

/// Metres that a particle which no pin holds starts from its place along each axis, at most: the scene's jitter. Where
/// all particles would be on a line or a point every force acts along it and nothing parts them; they are then moved by
/// what single precision just resolves, 4 units in the last place of the farthest coordinate.
double start_jitter(const Cloth& cloth);

/// By particle: whether a pin holds it at the start.
std::vector<bool> held_at_start(const Cloth& cloth);

/// By cell, row by row: whether a hole takes it away.
std::vector<bool> missing_cells(const Cloth& cloth);

/// Whether any is left.
bool leaves_a_cell(const Cloth& cloth);

/// m, of a particle without jitter.
Vec3 start_place(const Cloth& cloth, std::uint32_t column, std::uint32_t row);

/// m, of a particle that starts up to `jitter` from its place.
Vec3 start_offset(const Placement& placement, double jitter, std::uint32_t particle);

/// m, of every particle, row by row: its place, and without a pin what the jitter moves it by.
std::vector<Vec3> start_positions(const Cloth& cloth);

/// Unit normal of the plane through three of its corners; 0 where they are on a line.
Vec3 start_normal(const Cloth& cloth);

/// The most that a spring along u or v starts too long or too short by, over its length.
double start_strain(const Cloth& cloth);

}  // namespace drape
