// The state of a cloth is a table with a row per field (cloth/state_row.h). Loops over these rows declare and upload
// the fields, carry them over a cut, make the C++ twin's arrays and compare the two. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "cloth/cut_topology.h"
#include "cloth/simulation_model.h"
#include "cloth/state_row.h"

namespace drape {

enum class Field : std::uint8_t {
    position,                ///< xyz: position at the start of the substep, m; at a frame's end the state itself.
                             ///< w: relative inverse mass; written by the set-up and by `pin release` alone
    displacement,            ///< xyz: motion within the substep, m (X + d is where the particle is now).
                             ///< w: share that drag took, or the mark of a release (shaders/include/verlet.h)
    position_remainder,      ///< rounding that the sum of positions lost, m (compensated sum)
    displacement_remainder,  ///< w: 1 where a collider touched the particle in the last substep
    position_spare,          ///< next state of a method that gathers; image and spare image then change roles
    displacement_spare,      ///< joined steps write it, too
    position_remainder_spare,
    displacement_remainder_spare,
    line_scratch,              ///< within a pass: two texels by particle of a line (shaders/line.comp)
    nested_rows,               ///< within a pass: a texel by a spring's first particle (shaders/nested.comp)
    nested_boxes,              ///< MethodScheme::nested_table
    displacement_before,       ///< displacement of the substep before the last, m: second order, and at a frame's end;
                               ///< of what a collider touched in the last, that of the last
    velocity_excess,           ///< of the same substep: h times the velocity at its end - displacement, m
    end_excess,                ///< at a frame's end: h times the velocity there - displacement, m (end_velocity.h)
    statistics_reference,      ///< xyz: point that positions are summed relative to, m; w: thickness, m
    line_control,              ///< LineControl (shaders/include/bdf2.h), an integer per texel
    line_control_spare,        ///< that of every other substep
    torques,                   ///< within a substep: TorqueSum of each workgroup (shaders/torque.comp)
    paid,                      ///< what a substep of contact pays in advance (shared/rotation_types.h)
    angular_error,             ///< xyz: angular momentum that the frame's substeps took back (Rotation::taken)
    wind_force,                ///< N
    loads,                     ///< ClothGeometry::loads
    gas,                       ///< GasState of what the cloth closes in, the same in all that do (gas_types.h)
    gas_shares,                ///< ClothGas::shares
    impulses,                  ///< what changes the momentum in the frame (shared/impulse_types.h)
    contact_impulses,          ///< xyz: of these what contact gave to each particle, masses of an inner particle x m
    bodies,                    ///< of a member's first cloth: its bodies (shared/body_types.h), of which
    body_constants,            ///< these are the constants; and by body, of the sums of impulses on a cloth,
    struck,                    ///< what the body got the opposite of in this frame so far
    body_meetings,             ///< within a pass: where bodies may touch (shaders/body_meet.comp)
    met_bodies,                ///< within it: where they are and how they move
    hull_points,               ///< cloth/bodies.h
    pin_numbers,               ///< by particle, 1 and the number of the pin that holds it at the start, or 0
    lifted_once,               ///< displacement after the first round of boxes' edges, m; w above 0 where they touched
    lifted,                    ///< displacement after the second round of boxes' edges, m; w as before
    support,                   ///< Support::plane of the surface that the particle lies on (contact_law.h)
    support_grip,              ///< Support::grip of the same
    normal,                    ///< unit normal of the front
    whole_spring_share,        ///< spring shares before the factor of a stiffness that changes
    spring_share,              ///< share of the springs that a particle is the first of, by direction
    rest_shape,                ///< positions at rest of cloth that rests bent, m
    bend_targets,              ///< what its bending elements are at rest, in the substep, m (bend_target.h)
    mass_share,                ///< mass over an inner particle's
    cells,                     ///< one texel per cell: bits 1 and 2 are set for the triangles that exist
    air,                       ///< by particle, what the wind acts on (cloth/air.h)
    tear_limits,               ///< what springs along row and column bear (cloth/tear.h)
    tension_row,               ///< per direction (tension_of), by first particle, m: extension that would balance the
    tension_column,            ///< tension applied in the substep; carried to the next one (line) or the next iteration
    tension_shear_down_right,  ///< (relax), and of stretch springs where the stretch error is wanted
    tension_shear_down_left,
    tension_row_spare,  ///< tension that a step of all springs writes for the next, which reads it (tension_spare_of)
    tension_column_spare,
    tension_shear_down_right_spare,
    tension_shear_down_left_spare,
    residuals,         ///< stretch error by workgroup
    iterations,        ///< sizes of the next iteration's dispatches, and iterations run (residual_types.h)
    iteration_sizes,   ///< sizes of an iteration's dispatches where it runs
    triangles,         ///< index buffer
    cut_vertices,      ///< vertices on cut springs
    tethers,           ///< tethers of every particle
    skin,              ///< ClothGeometry::skin, of cloth that meets colliders
    pinned_particles,  ///< particles of pins that move or let go
    pin_motions,       ///< motion of every such pin in every substep
    sewn_particles,    ///< ClothGeometry::sewn
    sewn_leads,        ///< by entry of that list, m: by how much a particle between two places moves before this one
    seam_loads,        ///< of particles at seams that rip, xyz: what it bears there (seam_types.h), N; w: 1 = it ripped
};
inline constexpr std::size_t field_count = static_cast<std::size_t>(Field::seam_loads) + 1;

/// What a frame does beside simulating, since some fields exist for it alone.
struct FrameNeeds {
    bool drawing = false;     ///< needs triangles and normals
    bool statistics = false;  ///< needs the tension of the stretch springs
    bool inspection = false;  ///< keeps what passes hand each other, so that each can run alone
};

/// The argument of the functions of a row.
struct FieldContext {
    const SimulationModel& model;
    const ClothModel& cloth;
    const CutTopology& topology;
    FrameNeeds needs{};
};

/// The resource of a field is called "<cloth>/<name>".
using FieldRow = StateRow<Field, FieldContext>;
/// Returns whether cloths that are simulated together (cloth/together.h) share one image for this field.
inline bool lies_together(const FieldRow& row) { return row.is_image(); }

/// Returns the table, in the order of Field.
std::span<const FieldRow> cloth_fields();
inline const FieldRow& row_of(Field field) { return cloth_fields()[static_cast<std::size_t>(field)]; }
/// Returns the field with this name in shaders, if there is one.
std::optional<Field> field_called(std::string_view variable);
/// Returns the field with the tension of the springs of one direction (engine/cloth/directions.h).
Field tension_of(std::size_t direction);
Field tension_spare_of(std::size_t direction);

/// Returns the capacity of a draw list for `count` elements. It is a power of two, so that few cuts need new buffers.
std::size_t draw_list_capacity(std::size_t count);
/// Returns the size of an image with two texels for each particle of the lines of any direction, filled up to whole
/// workgroups of lines.
FieldExtent line_scratch_extent(const Grid& grid);
/// Returns the number of workgroups that sum torques, each of which leaves a record.
std::uint32_t torque_count(const Grid& grid);
/// Returns the number of workgroups of the residual pass, each of which leaves a record.
std::uint32_t residual_count(const Grid& grid);
/// Returns the number of rows of invocations of the residual pass.
std::uint32_t residual_strip_count(const Grid& grid);

}  // namespace drape
