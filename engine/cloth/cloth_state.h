// The state of a cloth, one row per field: what it is called, what it holds, how large it is, how long it lives, when a
// model or a frame needs it and what it starts with. Declaring, uploading, carrying over a cut, the C++ twin's arrays
// and the comparison of the two are loops over these rows. Pure.
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
    position,            ///< xyz: position at the start of the substep, m; at a frame's end the state itself.
                         ///< w: relative inverse mass; written by the set-up and by `pin release` alone
    displacement,        ///< xyz: motion within the substep, m (X + d is where the particle is now); w 0
    position_remainder,  ///< what rounding lost of the two (compensated sums)
    displacement_remainder,
    position_spare,      ///< where a method that gathers writes the next state, which then is the state
    displacement_spare,  ///< where sweeps of springs do, too
    position_remainder_spare,
    displacement_remainder_spare,
    line_scratch,              ///< within a pass: two texels by particle of a line (shaders/line.comp)
    nested_rows,               ///< likewise by first particle (shaders/nested.comp)
    nested_boxes,              ///< MethodPlan::nested_table
    displacement_before,       ///< displacement of the substep before the last, m: second order, and at a frame's end
    velocity_excess,           ///< of that substep, h times its end's velocity - displacement, m
    end_excess,                ///< at a frame's end: h times the velocity there - displacement, m (end_velocity.h)
    statistics_reference,      ///< what the statistics measure from
    line_control,              ///< LineControl (shaders/include/bdf2.h), an integer per texel
    wind_force,                ///< N
    lifted_once,               ///< displacement after the first round of boxes' edges, m; w above 0 where they touched
    lifted,                    ///< likewise after the second
    normal,                    ///< unit normal of the front
    spring_share,              ///< share per direction, by first particle
    mass_share,                ///< 1 = an inner particle's
    cells,                     ///< triangles that exist, bits 1 and 2, one texel per cell
    tension_row,               ///< per direction (tension_of), by first particle, m: extension that would balance the
    tension_column,            ///< tension applied in the substep; carried to the next one (line) or the next iteration
    tension_shear_down_right,  ///< (relax), and of stretch springs where the stretch error is wanted
    tension_shear_down_left,
    tension_row_spare,  ///< where a sweep of springs writes it for the next, which reads it (tension_spare_of)
    tension_column_spare,
    tension_shear_down_right_spare,
    tension_shear_down_left_spare,
    residuals,         ///< stretch error by workgroup
    iterations,        ///< sizes of the next iteration's dispatches, and iterations run (residual_types.h)
    iteration_sizes,   ///< the sizes to choose from
    triangles,         ///< index buffer
    cut_vertices,      ///< vertices on cut springs
    tethers,           ///< of every particle
    pinned_particles,  ///< particles of pins that move or let go
    pin_motions,       ///< of every substep
};
inline constexpr std::size_t field_count = static_cast<std::size_t>(Field::pin_motions) + 1;

/// What a frame is for, beside simulating.
struct FrameNeeds {
    bool drawing = false;     ///< triangles and normals
    bool statistics = false;  ///< the tension of the stretch springs
};

/// What a row's functions look at.
struct FieldContext {
    const SimulationModel& model;
    const ClothModel& cloth;
    const CutTopology& topology;
    FrameNeeds needs{};
};

/// The resource of a field is called "<cloth>/<name>".
using FieldRow = StateRow<Field, FieldContext>;
/// Whether cloths that are simulated together (cloth/together.h) have the field in one image.
inline bool lies_together(const FieldRow& row) { return row.is_image(); }

/// By Field.
std::span<const FieldRow> cloth_fields();
inline const FieldRow& row_of(Field field) { return cloth_fields()[static_cast<std::size_t>(field)]; }
/// The field that shaders call by this name, if there is one.
std::optional<Field> field_called(std::string_view variable);
/// The tension of the springs of one direction (engine/cloth/directions.h).
Field tension_of(std::size_t direction);
Field tension_spare_of(std::size_t direction);

/// Elements that a draw list of `count` elements has room for: it grows in powers of two, so that few cuts need
/// new buffers.
std::size_t draw_list_capacity(std::size_t count);
/// Of an image with a texel for each particle of the lines of any direction, filled up to whole workgroups of lines.
FieldExtent line_scratch_extent(const Grid& grid);
/// Workgroups of the residual pass, each of which leaves a record.
std::uint32_t residual_count(const Grid& grid);
/// Rows of its invocations.
std::uint32_t residual_strip_count(const Grid& grid);

}  // namespace drape
