// The table of cases that `drape bench speed` measures, made of a few lists of numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drape/scene.h"
#include "drape/simulation.h"

namespace drape::bench {

enum class SpeedKind { solve, picture, skip, start, kernels, ensemble };

struct SpeedCase {
    std::string name{};  ///< "line/256": what --filter is matched with
    SpeedKind kind = SpeedKind::solve;
    std::string group{};         ///< cases that a line of a plot joins: "line", "line, cloths"
    std::uint32_t variable = 0;  ///< what the group's cases differ in: particles along a side, cloths, colliders
    SolverMethod method = SolverMethod::line;
    std::uint32_t size = 64;                               ///< particles along both sides of each cloth
    std::uint32_t cloths = 1, colliders = 0, samples = 4;  ///< cloths: of an ensemble, its members
    bool draw = false;

    /// Per frame. Explicit micro-steps are taken in flights of four between a frame's first and last, which stay alone;
    /// frames have hundreds of them, so that these two must not weigh.
    std::uint32_t substeps() const {
        if (method == SolverMethod::explicit_steps) return size < 1024 ? 66 : 18;
        return size < 1024 ? 8 : 2;
    }
    double particles() const { return double(size) * size * cloths; }
};

/// Returns the cases in order of importance. `is_short`: those of small cloths alone.
std::vector<SpeedCase> speed_cases(bool is_short);

/// Returns the cases of --tune: "kernels/METHOD/N", "kernels/METHOD/32/COUNT cloths".
std::vector<SpeedCase> kernel_cases(bool is_short);

/// Sheets of 1 m held by an edge, swinging from level; spheres above them, which they do not touch.
SceneDescription scene_of(const SpeedCase& speed_case);

/// An exact or adaptive skip (--no-skip): a shipped scene with and without it.
struct SkipCase {
    std::string name, scene;  ///< "skip/pictures"; "flag.json"
    std::string saved;        ///< what is skipped
    void (*set)(SceneDescription& scene, SimulationOptions& options, std::uint32_t& every);  ///< with the skip
    void (*undo)(SceneDescription& scene, SimulationOptions& options, std::uint32_t& every);
    std::uint32_t warm_up = 3;  ///< frames before any is measured: shaders are compiled at their first dispatch
};

const std::vector<SkipCase>& skip_cases();

}  // namespace drape::bench
