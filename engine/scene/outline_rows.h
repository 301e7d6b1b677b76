// The rows of the scene format that are about outlines.
#pragma once

#include "scene/scene_rules.h"
#include "scene/shared_rows.h"

namespace drape::rows {

inline const Object<OutlineText> outline{
    "outline",
    "The outline of a cloth that is no rectangle, with holes: a path, or the shapes of a file. The grid fills its "
    "box. Cells of which half is inside are cloth, and particles on the rim lie on the outline; masses and springs "
    "are those of each cell's shape. The point [0, 0] of the path starts at the placement's origin, x grows along u "
    "and y along v.",
    {
        {"path", &OutlineText::path, without_default(text()),
         "Path data as in SVG: M L H V C S Q T A Z and their small letters. Every curve is closed; cloth is what an "
         "odd number of them goes around. Example, a disc: \"M -0.5 0 A 0.5 0.5 0 0 0 0.5 0 A 0.5 0.5 0 0 0 -0.5 0 "
         "Z\"."},
        {"file", &OutlineText::file, without_default(text()),
         "Instead of path: an SVG file, of which path, rect, circle, ellipse, polygon and polyline elements count, "
         "with their transforms. A relative name is looked for beside the scene file."},
        {"element", &OutlineText::element, without_default(text()),
         "The id of the one shape or group of the file that counts. Absent: all that are drawn."},
        {"scale", &OutlineText::scale, optional(number(positive)),
         "Metres of a unit of the path (absent: 1), or of the file's (absent: by its width and viewBox; a pixel is "
         "1/96 inch)."},
        {"spacing", &OutlineText::spacing, number(positive), "Metres between particles, about."},
    }};

/// Reads the outline; the rule of the cloth fits its grid.
inline bool read_outline(const SceneNode& node, Cloth&) {
    OutlineText ignored;
    return outline.read(node, ignored);
}

}  // namespace drape::rows
