// The table of all bounds: what a result may be at most, why, and what a user can do beyond. A new bound is a row of
// bounds.cpp; the loops that ask the rows are in watch.cpp, passage_watch.cpp and impossible_scene.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "control/causes.h"
#include "drape/statistics.h"

namespace drape {

/// Stretch that lasts is judged over so many frames, a tenth of a second in 60 a second: a single one may be a snap,
/// which springs end within a few frames.
inline constexpr std::size_t frames_in_a_row = 6;
/// Springs follow fabric up to this strain: weaves break between 0.07 (cotton) and 0.5 (nylon).
inline constexpr double springs_mean = 0.5;

/// The words of a row. `sentence` has names in braces, which stand for the members of a Finding.
struct Words {
    const char* name;          ///< what is bounded, with its unit
    const char* sentence;      ///< how a finding beyond the bound is told
    const char* remedy;        ///< what a user can do
    const char* why;           ///< what the bound is made of, for docs/bounds.md
    const char* joint = "; ";  ///< between sentence and remedy
};

/// A finding is what a row measured, and what its sentence names.
struct Finding {
    double value = 0, bound = 0;
    std::string cloth, place, collider, other;
    std::uint32_t first = 0, frame = 0, count = 0;  ///< frames, and how many there are of something
};
/// Returns the sentence about a finding, without the remedy; and with it.
std::string sentence(const Words& words, const Finding& found);
std::string told(const Words& words, const Finding& found);

/// A cloth at the end of a frame, with what is known of its scene and of earlier frames.
struct Seen {
    const Causes& causes;
    std::uint32_t frame;
    std::size_t cloth;
    std::span<const ClothStatistics> all;
    double start_depth = 0;  ///< m, the cloth's penetration in frame 0
    /// The least and the largest of the last six frames' largest stretch errors of a spring; 0: there were fewer.
    double lasting = 0, recent = 0;
    bool in_order = true;  ///< all frames before were seen, too
    const ClothStatistics& now() const { return all[cloth]; }
    const Causes::Start& start() const { return causes.starts()[cloth]; }
    const SceneDescription& scene() const { return causes.model().scene; }
};

/// A row says what follows where its value is beyond its bound.
enum class Beyond : std::uint8_t {
    again,      ///< a closed loop does the frame again; one that is kept is no result
    no_result,  ///< the frame is no result; a closed loop has limits of its own
    warning,    ///< the run tells of it once
    unsettled   ///< the run tells of it where its last frame is beyond the bound
};

struct ClothBound {
    Words words;
    Beyond beyond;
    std::optional<std::uint32_t> ClothStatistics::*place = nullptr;  ///< the particle that is named; null: none
    double (*value)(const Seen&);                                    ///< 0: there is nothing to judge
    double (*bound)(const Seen&);
    /// Returns what the scene itself adds to the bound by how it holds the cloth: it takes long, and is asked only
    /// beyond.
    double (*own)(const Seen&) = nullptr;
    /// Returns the cloth that is named, where all cloths are judged as one; null: each is judged by itself.
    std::size_t (*whose)(const Seen&) = nullptr;
};
std::span<const ClothBound> cloth_bounds();
/// Returns the energy, J, that the cloth, or all that meet, may still gain.
double spare_energy(const Seen& seen);

/// A collider near a cloth: how far they get in a substep of a frame, at most, and how wide they are; m.
struct Passing {
    double cloth_way;           ///< the fastest particle's
    double half, thickness;     ///< half of what the collider measures at its thinnest; the cloth's least
    double hole, largest_hole;  ///< radius of a triangle, and of one whose springs are stretched by springs_mean
    double way = 0, turn = 0;   ///< the collider's; radians
    bool by_edges = false;      ///< edges meet edges, as those of boxes do that the thickness does not keep off
    bool turns_far = false;     ///< it turns so far that no way is known of its points
};

/// Beyond it contact is not sure that the collider did not pass between the cloth's particles.
struct PassageBound {
    Words words;
    bool substeps_help;
    double (*value)(const Passing&);
    double (*bound)(const Passing&);
};
std::span<const PassageBound> passage_bounds();

/// Beyond it no substep keeps the limits, which a refusal tells.
struct SceneBound {
    Words words;
    /// Returns what is beyond the bound for a cloth at the end of a frame.
    std::optional<Finding> (*find)(const SimulationModel&, std::size_t cloth, std::uint32_t frame);
};
std::span<const SceneBound> scene_bounds();

}  // namespace drape
