// The cloths and colliders of a run in three dimensions, as a page's own data and the script that shows them.
#pragma once

#include <string>

#include "report/run_folder.h"

namespace drape::report {

/// Returns what the script of a page shows of a run in 3-D: a view, its controls, and the run's positions as JSON
/// (below); where the run exported no positions.npz, or `megabytes` is 0, a paragraph that says so. The positions take
/// `megabytes` of the page at most: frames are left out first, evenly, down to 60, then rows and columns of particles.
/// Throws OutputError when an archive cannot be read.
///
/// The JSON has `frames` and `times` (s) of the kept frames, the `camera`, `colors` of strains (0xRRGGBB, evenly
/// spread), a list of `cloths`, each with
///
/// - `name`, `rows` and `columns` (of the kept particles), `stride` (one of so many rows and columns is kept, and the
/// last),
///   colours `front` and `back` (sRGB, 0 to 1);
/// - `positions`, uint16 [frame, row, column, 3]: `low` + value / 65535 (`high` - `low`) in metres, by axis;
/// - `strain`, uint8 [frame, row, column]: the largest strain of the springs along rows and columns at a particle of
/// the
///   whole grid, value / 255 * `strain_range`; the largest strains, one in a hundred, may be beyond that;
/// - `triangles`, uint32 [triangle, 3], places in a frame's positions; `changes`, from which `frame` on which of them
/// are
///   there (`alive`, a bit each, the lowest first);
///
/// and lists of `colliders` (`kind` as the scene's list, `size` as shape_geometry gives it, `color`, `poses`; of a mesh
/// `positions`, of its vertices as of a cloth's particles, in every frame where it deforms and that fits, else one, and
/// `triangles`, uint32 [triangle, 3]) and of `cutters` (`corners` about the pose's centre, `active` from and to, s,
/// `poses`). Poses are float32 [frame, 12], or of one frame where nothing moves: rotation, row major, then centre.
/// Arrays are little-endian, in base64.
std::string space_view(const RunFolder& run, std::size_t id, double megabytes);

/// Returns the libraries and the script that show every such view of a page, ready to stand between CDATA marks. The
/// libraries are missing where the program was built without them.
std::string space_script();

}  // namespace drape::report
