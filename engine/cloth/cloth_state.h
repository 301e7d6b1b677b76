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
#include "shared/struct_layout.h"

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
    nested_sweeps,             ///< MethodPlan::nested_table
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
    residuals,           ///< stretch error by workgroup
    iterations,          ///< sizes of the next iteration's dispatches, and iterations run (residual_types.h)
    iteration_sizes,     ///< the sizes to choose from
    triangles,           ///< index buffer
    cut_vertices,        ///< vertices on cut springs
    tethers,             ///< of every particle
    self_owners,         ///< of contact, kept with the first cloth for all: by place on the sheet its cloth, or -1
    self_cloths,         ///< where the cloths lie on the sheet (shared/self_contact_types.h)
    self_meetings,       ///< by cloth and cloth: self_meets and those beside it
    self_crossed,        ///< pairs of cloths that started through each other
    self_crossings,      ///< what the substep found of them
    self_led,            ///< by cloth: what it is led by to come apart from others, m
    self_positions,      ///< by place on the sheet: position at the start of the substep, m; w: relative inverse mass
    self_displacements,  ///< likewise: motion within it, m; w: bits of the triangles and edges that it owns
    self_boxes,          ///< by place, what its cell is in in this substep (shaders/include/self_contact.h)
    self_kept,           ///< tree of boxes in which cells were looked for, the lowest level first
    self_candidates,     ///< pairs of cells that may come near each other until the next search
    self_cells,          ///< those that are in this substep
    self_near,           ///< pairs of primitives whose boxes are near each other
    self_pairs,          ///< corners of those that may meet
    self_corrections,    ///< sums of integers, by place
    self_before,       ///< displacement before contact, m; w: 1 where contact moved the particle since it was gathered
    self_shares,       ///< bits of the share of its motion that a particle may make, by round
    self_record,       ///< what self-contact was in the frame
    self_sizes,        ///< of the dispatches that go through lists
    pinned_particles,  ///< particles of pins that move or let go
    pin_motions,       ///< of every substep
};
inline constexpr std::size_t field_count = static_cast<std::size_t>(Field::pin_motions) + 1;

enum class FieldLife : std::uint8_t {
    state,     ///< what the next frame starts from: carried over a cut, and the twin's to the bit
    frame,     ///< written before it is read in every frame
    device,    ///< kept on the device, of no meaning to anybody else
    constant,  ///< the host's, from the start on or since a cut
    input,     ///< the host's, of every frame
};

/// How shaders may see a field.
enum class FieldView : std::uint8_t { image, buffer, texel_buffer, image_and_buffer };

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
    std::optional<SelfRoom> room{};  ///< of contact's lists; nothing: what they begin with
};

struct FieldExtent {
    std::uint64_t width, height = 1;  ///< texels; elements of a buffer
    std::uint64_t count() const { return width * height; }
};

struct FieldRow {
    Field field;
    std::string_view name;  ///< the resource is "<cloth>/<name>"
    FieldView view;
    const glsl::StructLayout& element;  ///< of images vec4 (rgba32f), float (r32f) or uint (r32ui)
    FieldLife life;
    bool (*needed)(const FieldContext&);
    FieldExtent (*extent)(const FieldContext&);
    /// Bytes at the start, or since the last cut, at most as many as the extent holds; null: zeros.
    std::vector<std::byte> (*start)(const FieldContext&) = nullptr;
    bool is_image() const { return view == FieldView::image || view == FieldView::image_and_buffer; }
    /// Of contact between cloths: kept with the first cloth, for all.
    bool is_shared() const { return field >= Field::self_owners && field <= Field::self_sizes; }
    /// Cloths that are simulated together (cloth/together.h) have it in one image.
    bool lies_together() const { return is_image() && !is_shared(); }
};

/// By Field.
std::span<const FieldRow> cloth_fields();
inline const FieldRow& row_of(Field field) { return cloth_fields()[static_cast<std::size_t>(field)]; }
/// The tension of the springs of one direction (engine/cloth/directions.h).
Field tension_of(std::size_t direction);
Field tension_spare_of(std::size_t direction);

/// As far as a buffer of so many bytes has room for each of contact's lists.
SelfRoom limited(const SelfRoom& room, std::uint64_t most_bytes);
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
