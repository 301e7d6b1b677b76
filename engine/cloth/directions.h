// The tables of spring directions, bending axes and twisting cells, and the parity passes that relax them
// (docs/physics.md 2: the constraints are coloured, not the particles). engine/README.md, "How to add", says what else
// a new direction requires.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "shared/glsl_types.h"

namespace drape {

enum class SpringFamily { stretch, shear };

struct SpringDirection {
    std::string_view name;
    glsl::ivec2 offset;  ///< from a spring's first particle to its second: columns, rows
    int parity_axis;     ///< 0: springs alternate even/odd along columns, 1: along rows
    SpringFamily family;
};

/// The row index is the channel of the spring shares.
inline constexpr std::array<SpringDirection, 4> spring_directions{{
    {"row", {1, 0}, 0, SpringFamily::stretch},
    {"column", {0, 1}, 1, SpringFamily::stretch},
    {"shear down-right", {1, 1}, 1, SpringFamily::shear},
    {"shear down-left", {-1, 1}, 1, SpringFamily::shear},
}};

template <class T>
using PerDirection = std::array<T, spring_directions.size()>;

/// The first rows are the stretch springs.
inline constexpr std::size_t stretch_direction_count = 2;

/// One dispatch relaxes every second spring of one direction.
struct SpringPass {
    int direction;           ///< row of spring_directions = channel
    int parity;              ///< 0 even, 1 odd
    glsl::ivec2 pair_count;  ///< springs along columns, rows; either may be 0
    bool empty() const { return pair_count.x == 0 || pair_count.y == 0; }
};

SpringPass spring_pass(int direction, int parity, glsl::ivec2 grid);

/// Returns the eight passes in the order of relaxation: rows, columns, diagonals; even before odd. Empty ones (an odd
/// pass of a two-column grid) are included.
std::vector<SpringPass> spring_passes(glsl::ivec2 grid);

/// Three neighbouring particles along such an axis form a bending element. The row index is the channel of the spring
/// shares of the two springs on which the element lies.
struct BendAxis {
    std::string_view name;
    glsl::ivec2 offset;  ///< from an element's middle to its third particle
};
inline constexpr std::array<BendAxis, 2> bend_axes{{{"row", {1, 0}}, {"column", {0, 1}}}};
inline constexpr int bend_colour_count = 3;

/// One dispatch relaxes every third bending element of one axis.
struct BendPass {
    int axis;                   ///< row of bend_axes
    int colour;                 ///< 0 .. 2
    glsl::ivec2 element_count;  ///< elements along columns, rows; either may be 0
    bool empty() const { return element_count.x <= 0 || element_count.y <= 0; }
};

BendPass bend_pass(int axis, int colour, glsl::ivec2 grid);

/// Returns the six passes in the order of relaxation, empty ones included.
std::vector<BendPass> bend_passes(glsl::ivec2 grid);

/// One dispatch relaxes the twist of every second cell along both axes.
struct TwistPass {
    glsl::ivec2 first;          ///< its first cell: 0 or 1 along columns, rows
    glsl::ivec2 element_count;  ///< cells along columns, rows; either may be 0
    bool empty() const { return element_count.x == 0 || element_count.y == 0; }
};

/// Returns the four passes in the order of relaxation, empty ones included.
std::vector<TwistPass> twist_passes(glsl::ivec2 grid);

}  // namespace drape
