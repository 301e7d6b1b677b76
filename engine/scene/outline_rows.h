// The rows of the scene format that are about outlines.
#pragma once

#include "scene/scene_rules.h"
#include "scene/shared_rows.h"

namespace drape::rows {

inline const Object<OutlineText> outline{
    "outline",
    "The outline of a cloth that is no rectangle, with holes. The grid fills its box. Cells of which half is inside "
    "are "
    "cloth, and particles on the rim lie on the outline; masses and springs are those of each cell's shape. The point "
    "[0, 0] of the path starts at the placement's origin, x grows along u and y along v.",
    {
        {"path", &OutlineText::path, without_default(text()),
         "Path data as in SVG: M L H V C S Q T A Z and their small letters. Every curve is closed; cloth is what an "
         "odd "
         "number of them goes around. Example, a disc: \"M -0.5 0 A 0.5 0.5 0 0 0 0.5 0 A 0.5 0.5 0 0 0 -0.5 0 Z\".",
         "path data"},
        {"scale", &OutlineText::scale, number(positive), "Metres of a unit of the path."},
        {"spacing", &OutlineText::spacing, number(positive), "Metres between particles, about."},
    }};

/// Reads the outline; the rule of the cloth fits its grid.
inline bool read_outline(const SceneNode& node, Cloth&) {
    OutlineText ignored;
    return outline.read(node, ignored);
}

}  // namespace drape::rows
