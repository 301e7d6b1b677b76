// The table of all bounds: the largest value that a result may have, why, and what a user can do about a larger one. A
// new bound is a row of bounds.cpp; watch.cpp, passage_watch.cpp and impossible_scene.cpp evaluate the rows.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "control/causes.h"
#include "drape/statistics.h"

namespace drape {

/// Lasting stretch is judged over this number of frames, a tenth of a second at 60 frames a second: the stretch of a
/// single frame may be a snap, which springs end within a few frames.
inline constexpr std::size_t frames_in_a_row = 6;
/// Springs follow fabric up to this strain: weaves break between 0.07 (cotton) and 0.5 (nylon).
inline constexpr double springs_mean = 0.5;

/// The words of a row. Names in braces in `sentence` stand for the members of a Finding.
struct Words {
    const char* name;          ///< what is bounded, with its unit
    const char* sentence;      ///< the sentence that reports a finding beyond the bound
    const char* remedy;        ///< what a user can do
    const char* why;           ///< how the bound is derived, for docs/bounds.md
    const char* joint = "; ";  ///< between sentence and remedy
};

/// A finding is what a row measured, and what its sentence names.
struct Finding {
    double value = 0, bound = 0;
    std::string cloth, place, collider, other;
    std::uint32_t first = 0, frame = 0, count = 0;  ///< the first and the worst frame; the number of particles
};
/// Returns the sentence about a finding: `sentence` without the remedy, `told` with it.
std::string sentence(const Words& words, const Finding& found);
std::string told(const Words& words, const Finding& found);

/// A cloth at the end of a frame, with what is known of its scene and of earlier frames.
struct Seen {
    const Causes& causes;
    std::uint32_t frame;
    std::size_t cloth;
    std::span<const ClothStatistics> all;
    double start_depth = 0;  ///< m, the cloth's penetration in frame 0
    /// The smallest and the largest value, over the last six frames, of the largest stretch error of a spring. 0: fewer
    /// frames were seen.
    double lasting = 0, recent = 0;
    bool in_order = true;  ///< all earlier frames were seen, too
    const ClothStatistics& now() const { return all[cloth]; }
    const Causes::Start& start() const { return causes.starts()[cloth]; }
    const SceneDescription& scene() const { return causes.model().scene; }
};

/// What happens when the value of a row is beyond its bound.
enum class Beyond : std::uint8_t {
    again,      ///< a closed loop does the frame again; a frame that is kept nevertheless is no result
    no_result,  ///< the frame is no result; a closed loop has limits of its own
    warning,    ///< the run warns about it once
    unsettled   ///< the run warns about it if its last frame is beyond the bound
};

struct ClothBound {
    Words words;
    Beyond beyond;
    std::optional<std::uint32_t> ClothStatistics::*place =
        nullptr;                   ///< the particle that the message names; null: none
    double (*value)(const Seen&);  ///< 0: there is nothing to judge
    double (*bound)(const Seen&);
    /// Returns what the scene itself adds to the bound by how it holds the cloth. Its computation takes long, so it is
    /// called only when the value is beyond the bound.
    double (*own)(const Seen&) = nullptr;
    /// Returns the cloth that the message names, where all cloths are judged as one; null: each cloth is judged by
    /// itself.
    std::size_t (*whose)(const Seen&) = nullptr;
};
std::span<const ClothBound> cloth_bounds();
/// Returns the energy, J, that the cloth, or all cloths that meet together, may still gain.
double spare_energy(const Seen& seen);

/// A collider near a cloth: how far each of them moves at most in a substep of a frame, and how wide they are; m.
struct Passing {
    double cloth_way;           ///< how far the fastest particle moves
    double half, thickness;     ///< half of the collider's smallest diameter; the least thickness of the cloth
    double hole, largest_hole;  ///< radius of a triangle, and of a triangle whose springs are stretched by springs_mean
    double way = 0, turn = 0;   ///< how far the collider moves, and how far it turns, radians
    bool by_edges = false;   ///< the collider's edges meet the cloth's edges, as those of a box do that the thickness
                             ///< does not keep off
    bool turns_far = false;  ///< it turns so far that the paths of its points are not known
};

/// Beyond this bound contact cannot guarantee that the collider did not pass between the cloth's particles.
struct PassageBound {
    Words words;
    bool substeps_help;
    double (*value)(const Passing&);
    double (*bound)(const Passing&);
};
std::span<const PassageBound> passage_bounds();

/// Beyond this bound no number of substeps keeps the limits; the message of a refusal says so.
struct SceneBound {
    Words words;
    /// Returns what exceeds the bound for a cloth at the end of a frame.
    std::optional<Finding> (*find)(const SimulationModel&, std::size_t cloth, std::uint32_t frame);
};
std::span<const SceneBound> scene_bounds();

}  // namespace drape
