// Finds where the particles of a cloth start.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "drape/scene.h"
#include "world/triangle_crossings.h"

namespace drape {

/// Returns how far, in m, a particle that no pin holds may start from its place along each axis: the scene's jitter.
/// Where all particles lie on a line or a point, every force acts along it and nothing separates them. Such a cloth
/// gets a jitter that single precision just resolves, 4 units in the last place of the farthest coordinate.
double start_jitter(const Cloth& cloth);

/// Returns by particle whether a pin holds it at the start.
std::vector<bool> held_at_start(const Cloth& cloth);

/// Returns by cell, row by row, whether a hole removes it.
std::vector<bool> missing_cells(const Cloth& cloth);
/// Returns by particle whether a cell is beside it. Other particles take part in nothing.
std::vector<bool> particles_of_cells(const Cloth& cloth);

/// Returns whether a load acts on any particle that has a cell.
bool is_loaded(const Cloth& cloth, const Load& load);

/// Returns whether the holes leave any cell.
bool leaves_a_cell(const Cloth& cloth);

/// Returns where a particle without jitter starts, m: as given, or flat as placed.
Vec3 start_place(const Cloth& cloth, std::uint32_t column, std::uint32_t row);

/// Returns the offset of a particle from its place at the start, m: up to `jitter` along each axis.
Vec3 start_offset(const Placement& placement, double jitter, std::uint32_t particle);

/// Returns the cloth's triangles, with its particles at these places.
TriangleCrossings::Mesh start_mesh(const Cloth& cloth, std::vector<Vec3> at);

/// The least box along the axes that holds a cloth without jitter, m.
struct StartBox {
    Vec3 low, high;
};
StartBox start_box(const Cloth& cloth);

/// Returns the velocity with which a particle that no pin holds starts, m/s.
Vec3 start_velocity(const Cloth& cloth, std::size_t particle);
/// Returns the largest start speed of the cloth's particles, m/s.
double start_speed(const Cloth& cloth);

/// Returns the height of the cloth's triangles without jitter, m; for a given shape, the height of its highest
/// triangle.
double start_height(const Cloth& cloth);

/// Returns where every particle starts, m, row by row; the jitter moves the particles that no pin holds. Where it would
/// make a cloth with self-contact start through itself, particles of triangles that cross get half of it, a quarter and
/// so on, until no triangles cross.
std::vector<Vec3> start_positions(const Cloth& cloth);

/// Returns the largest distance (m) by which this reduction changes where a particle starts; `untied` are the cloth's
/// start positions.
double start_untied(const Cloth& cloth, const std::vector<Vec3>& untied);

/// Returns the unit normal of the plane through three of the cloth's corners, or, for a given shape, the mean normal; 0
/// where there is none.
Vec3 start_normal(const Cloth& cloth);

/// Returns the largest absolute strain with which a spring along u or v starts.
double start_strain(const Cloth& cloth);

/// The ratios of the spring lengths along u and v at the start without jitter to those on the full grid at rest.
struct StartRatios {
    double mean = 1, largest = 1;
};
StartRatios start_ratios(const Cloth& cloth, std::size_t axis);

/// Returns by particle the rest lengths of the springs to its right, below it, and below it on the right and on the
/// left, divided by those of the full grid. They are 1 unless the cloth rests as it starts or has an outline, and where
/// the grid or a hole has no spring.
std::vector<std::array<double, 4>> rest_ratios(const Cloth& cloth);
/// Returns why a given shape cannot be a rest shape, as text to follow "expected". Empty: it can.
std::string rest_fault(const Cloth& cloth);

/// Returns what is wrong with a given shape, as text to follow "expected": the number of places is wrong, a place is
/// not a number, two particles coincide, or all triangles are too thin. Empty: nothing is wrong.
std::string start_fault(const Cloth& cloth);
/// Returns what is wrong with given velocities, likewise: their number is wrong, or one is not a number.
std::string velocities_fault(const Cloth& cloth);

}  // namespace drape
