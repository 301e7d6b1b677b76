// Simulates a scene on the device, and measures what its oracles judge: masses, velocities and strains in double
// precision, from the position arrays alone.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "cloth/frame_steps.h"
#include "simulation/frame_server.h"

namespace drape::verify {

/// The state of a cloth after a cut (or, at frame 0, before any).
struct CutRecord {
    std::size_t frame, cloth;
    std::size_t springs;               ///< cut in this frame
    std::size_t pieces;                ///< parts that springs hold together, of at least 1 % of the particles
    std::size_t crumbs;                ///< smaller parts: for instance particles that a blade passed on all sides
    double drawn_area;                 ///< m^2 at rest
    std::vector<std::uint32_t> whole;  ///< particles of the triangles that no cut has split, three for each
};

/// The positions of every frame from 0 on. `scene` is the scene as it was read: the run is judged by what the file
/// says, whatever was changed in the model that was simulated.
struct SceneRun {
    SceneDescription scene;
    std::vector<std::vector<std::vector<glsl::vec4>>> frames;  ///< [frame][cloth][particle]

    std::vector<CutRecord> cuts;  ///< in order; if the scene has cutters, one for each cloth at frame 0
    std::vector<std::vector<BodyState>> bodies = {};  ///< [frame]: those that cloth moves; none where no scene has any
    std::vector<std::vector<std::vector<ForceOnCloth>>> forces = {};  ///< [frame][cloth]: where the scene wants them

    std::size_t last_frame() const { return frames.size() - 1; }
    double time(std::size_t frame) const { return static_cast<double>(frame) / scene.time.fps; }  ///< s
    Vec3 at(std::size_t frame, std::size_t cloth, std::size_t particle) const;                    ///< m
    /// Returns the mean velocity between a frame and the next one, m/s.
    Vec3 velocity_after(std::size_t frame, std::size_t cloth, std::size_t particle) const;
    /// Returns the part of the run up to the frame `last`.
    SceneRun until(std::size_t last) const;
};

struct RunOptions {
    std::uint32_t last = 0;                                ///< the last frame; the first is 0
    bool positions = true;                                 ///< false: SceneRun::frames stays empty
    std::function<void(const FinishedFrame&)> frame = {};  ///< receives every frame, with its statistics
    std::function<bool()> stop = {};                       ///< asked before each frame
};

/// Simulates a scene with a frame server, without pictures; frames that fail are kept. `model` is made from the scene,
/// perhaps with changes. Throws VulkanError.
SceneRun run_frames(const vulkan::Device& device, const SceneDescription& scene, const SimulationModel& model,
                    const RunOptions& options);

/// Numbers about a cloth that oracles need, computed from the scene independently of the simulation.
struct ClothMeasure {
    ClothMeasure(const SceneDescription& scene, std::size_t cloth);
    Grid grid;
    std::array<double, 2> spacing;                   ///< m
    std::vector<double> mass;                        ///< kg; 0 for a particle without cells
    std::vector<std::array<double, 4>> rest_ratios;  ///< by particle and direction (world/start.h)
};

/// Returns the strains of the existing springs along columns (`down`) or along rows.
std::vector<double> spring_strains(const SceneRun& run, std::size_t frame, std::size_t cloth, bool down);
double mean(const std::vector<double>& values);
double root_mean_square(const std::vector<double>& values);

/// Returns the mean strain that the relaxation leaves in a hanging sheet with the cloth's N rows and height L, from
/// stretch springs alone: N^2 g h^2 / (2 K L) (docs/physics.md 2).
double stretch_law(const SceneDescription& scene, std::size_t cloth);

}  // namespace drape::verify
