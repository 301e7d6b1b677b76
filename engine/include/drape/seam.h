// What sews the cloths of a scene together.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "drape/spelling.h"

namespace drape {

/// A border of a cloth's grid: left is column 0, top is row 0.
enum class SeamEdge { left, right, top, bottom };
inline constexpr Spelling<SeamEdge> seam_edge_spellings[] = {
    {"left", SeamEdge::left}, {"right", SeamEdge::right}, {"top", SeamEdge::top}, {"bottom", SeamEdge::bottom}};

/// The way round a rim that a piece of it takes between its ends.
enum class SeamWay { shorter, longer };
inline constexpr Spelling<SeamWay> seam_way_spellings[] = {{"shorter", SeamWay::shorter}, {"longer", SeamWay::longer}};

/// One side of a seam: a border, or a piece of the rim of a cloth's outline, holes or grid.
struct SeamSide {
    std::string cloth;                                  ///< its name
    std::optional<SeamEdge> edge{};                     ///< a border; nothing: the piece between two points
    std::optional<std::array<double, 2>> from{}, to{};  ///< m along u and v
    SeamWay way = SeamWay::shorter;
    std::array<double, 2> corner{};  ///< m: where from and to have the corner of the panel's box
    bool operator==(const SeamSide&) const = default;
};

/// Two sides that are one (engine/docs/physics.md 12), from the start on or when they are closed. Where they have
/// unlike numbers of particles, those of the finer side lie between those of the coarser one (world/seams.h).
struct Seam {
    SeamSide a, b;
    double close = 0;             ///< s: they are drawn together from the start until then; 0: they start together
    std::optional<double> rip{};  ///< N/m: the load at which places of it come apart; nothing: none does
    bool operator==(const Seam&) const = default;
};

}  // namespace drape
