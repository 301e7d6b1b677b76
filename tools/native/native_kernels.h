// The arithmetic of the simulation passes in native C++: the yardstick of `drape bench speed`.
// Every number of a particle has an array of its own, so that compilers vectorise the loops over a row. They are the
// shaders' own functions in the twin's order: the same bits (tests/native). One uniform, uncut cloth without wind and
// bending; no other case needs a yardstick.
//
// This header and the kernels know no containers: they are built for the processor at hand (-march=native), and what
// other files share with them inline would be too.
#pragma once

#include <cstddef>

#include "shared/line_types.h"
#include "shared/simulation_types.h"

namespace drape::native {

/// One vector per particle, at row * pitch + column; of a row, at its column.
struct Vectors {
    float *x, *y, *z;
    Vectors from(std::ptrdiff_t place) const { return {x + place, y + place, z + place}; }
};

/// A cloth's state; names as in cloth/cloth_state.cpp. There is room for 16 floats before the first row and behind
/// each.
struct SheetView {
    int columns, rows;
    std::ptrdiff_t pitch;
    Vectors position, displacement, position_remainder, displacement_remainder, displacement_before, velocity_excess;
    float* weight;      ///< relative inverse mass
    float* tension[4];  ///< by direction; null but for lines
    std::ptrdiff_t place(int column, int row) const { return row * pitch + column; }
    int whole_vectors() const { return (columns + 15) / 16 * 16; }
};

/// Rows first ... last - 1 of one worker, who leaves the others alone.
struct Rows {
    int first, last;
};

/// A worker's memory for explicit steps: pulls of the springs that end in a row (of the row above: down, down-right,
/// down-left) and that start in it, and the row below as it was before its own worker changed it. Rows of whole
/// vectors with 16 floats before and behind.
struct ExplicitScratch {
    Vectors above[3], along, below[3];
    Vectors next_position, next_displacement;
    float* stiffness[4];  ///< along a row, along a border row, to the next row, on diagonals; by column
};

inline constexpr int line_lanes = 16;  ///< lines solved at a time

/// One particle of 16 lines and the spring after it: 1 KiB, so that lines of several hundred stay in a core's cache.
struct alignas(64) LineParticles {
    struct Spring {
        float normal[3][line_lanes], excess[line_lanes];
    };
    union {
        float start[3][line_lanes];
        float spring_eliminated[2][line_lanes];  ///< later
    };
    union {
        float eliminated[4][line_lanes];
        Spring spring;  ///< later
    };
    float displacement[3][line_lanes], delta[3][line_lanes];
    float weight[line_lanes], share[line_lanes], tension[line_lanes];
};
static_assert(sizeof(LineParticles) == 1024);

/// The kernels as a compiler made them, with vectors or without.
struct Kernels {
    /// Before an explicit step, while no worker writes; what explicit_rows needs of other workers' rows.
    void (*prepare_explicit)(const SheetView& sheet, const glsl::ExplicitPush& push, bool advance, Rows rows,
                             const ExplicitScratch& scratch);
    /// Twin::explicit_step of these rows, in place.
    void (*explicit_rows)(const SheetView& sheet, const glsl::ExplicitPush& push, bool advance, Rows rows,
                          const ExplicitScratch& scratch);
    /// Twin::force.
    void (*force_rows)(const SheetView& sheet, const glsl::ForcePush& push, bool advance, Rows rows);
    /// Twin::predict.
    void (*predict_rows)(const SheetView& sheet, const glsl::PredictPush& push, bool advance, bool is_bdf2, Rows rows);
    /// Twin::advance.
    void (*advance_rows)(const SheetView& sheet, Rows rows);
    /// Twin::spring of these rows of pairs; no tension is carried to a next iteration.
    void (*spring_rows)(const SheetView& sheet, const glsl::SpringPush& push, Rows rows);
    /// Twin::line of lines first ... last - 1. `scratch`: one per particle of a line and one more. Returns how
    /// many are wrong (line_is_wrong).
    std::uint32_t (*solve_lines)(const SheetView& sheet, const glsl::LinePush& push, bool first_iteration, bool is_bdf2,
                                 int first, int last, LineParticles* scratch);
};

/// -O3 for the processor at hand; the same without vectors.
const Kernels& vector_kernels();
const Kernels& scalar_kernels();

}  // namespace drape::native
