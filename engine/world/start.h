// Finds where the particles of a cloth start.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "drape/scene.h"
#include "world/triangle_crossings.h"

namespace drape {

/// Returns how far in m a particle that no pin holds starts at most from its place along each axis: the scene's jitter.
/// Where all particles would be on a line or a point, every force acts along it and nothing parts them; they are then
/// moved by what single precision just resolves, 4 units in the last place of the farthest coordinate.
double start_jitter(const Cloth& cloth);

/// Returns by particle whether a pin holds it at the start.
std::vector<bool> held_at_start(const Cloth& cloth);

/// Returns by cell, row by row, whether a hole takes it away.
std::vector<bool> missing_cells(const Cloth& cloth);
/// Returns whether each particle has a cell beside it. Others take part in nothing.
std::vector<bool> particles_of_cells(const Cloth& cloth);

/// Returns whether the holes leave any cell.
bool leaves_a_cell(const Cloth& cloth);

/// Returns where a particle without jitter starts, m: as given, or flat as placed.
Vec3 start_place(const Cloth& cloth, std::uint32_t column, std::uint32_t row);

/// Returns how far from its place a particle starts, m: up to `jitter` along each axis.
Vec3 start_offset(const Placement& placement, double jitter, std::uint32_t particle);

/// Returns the cloth's triangles with its particles at these places.
TriangleCrossings::Mesh start_mesh(const Cloth& cloth, std::vector<Vec3> at);

/// The least box along the axes that holds a cloth without jitter, m.
struct StartBox {
    Vec3 low, high;
};
StartBox start_box(const Cloth& cloth);

/// Returns the velocity with which a particle that no pin holds starts, m/s.
Vec3 start_velocity(const Cloth& cloth, std::size_t particle);
/// Returns the largest of them, m/s.
double start_speed(const Cloth& cloth);

/// Returns the height of the cloth's triangles without jitter, m; of a given shape that of the highest.
double start_height(const Cloth& cloth);

/// Returns where every particle starts, m, row by row; the jitter moves those without a pin. Where it would have a
/// cloth that meets itself start through itself, particles of triangles that cross are moved by half, a quarter and so
/// on of it, until none do.
std::vector<Vec3> start_positions(const Cloth& cloth);

/// Returns how far (m) that leaves a particle, at most, from where all of its jitter would move it.
double start_untied(const Cloth& cloth);

/// Returns the unit normal of the plane through three of the cloth's corners, or of a given shape on average; 0 where
/// there is none.
Vec3 start_normal(const Cloth& cloth);

/// Returns the most that a spring along u or v starts too long or too short by, over its length.
double start_strain(const Cloth& cloth);

/// Returns how long the springs of a given shape along u and v are over their lengths at rest.
struct StartRatios {
    double mean = 1, largest = 1;
};
StartRatios start_ratios(const Cloth& cloth, std::size_t axis);

/// Returns by particle the lengths that the springs to its right, below it, and below it on the right and the left have
/// at rest over those of flat cloth: 1 unless the cloth rests as it starts, and where the grid or a hole has no spring.
std::vector<std::array<double, 4>> rest_ratios(const Cloth& cloth);
/// Returns what is wrong with a given shape as one of rest, to follow "expected". Empty: nothing.
std::string rest_fault(const Cloth& cloth);

/// Returns what is wrong with a given shape, to follow "expected": not a place for every particle, one that is no
/// number, two particles in one place, triangles that are all too thin. Empty: nothing.
std::string start_fault(const Cloth& cloth);
/// Returns what is wrong with given velocities, likewise: not one for every particle, or one that is no number.
std::string velocities_fault(const Cloth& cloth);

}  // namespace drape
