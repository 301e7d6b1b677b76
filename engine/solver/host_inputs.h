// What the host writes into a slot before it submits a frame, into whatever of it the pool holds.
#pragma once

#include "shared/closed_loop_types.h"
#include "solver/cloth_layout.h"

namespace drape {

/// Writes the host inputs for simulating a run to `frame` (1 ..).
void write_inputs(const ClothLayout& layout, const graph::ResourcePool& pool, std::uint32_t slot, std::uint32_t frame,
                  const SimulationModel& run);
/// Writes these, but for the constants of cloths together.
void write_inputs(const ClothLayout& layout, const graph::ResourcePool& pool, std::uint32_t slot,
                  const FrameInputs& inputs, std::uint32_t substeps);
/// Writes the constants that each of the cloths together has its own of, which frames leave as they are.
void write_constants(const ClothLayout& layout, const graph::ResourcePool& pool, std::uint32_t slot,
                     std::uint32_t substeps);
/// Writes for which cloths the passes of the next submit are taken.
void write_present(const ClothLayout& layout, const graph::ResourcePool& pool, std::uint32_t slot,
                   const std::vector<bool>& cloths);
/// Writes how an attempt changes the length of each cloth's substeps.
void write_changes(const ClothLayout& layout, const graph::ResourcePool& pool, std::uint32_t slot,
                   const std::vector<glsl::SubstepChange>& changes);
/// Writes the cutters of the frame that spans the two times (s).
void write_cutters(const SceneDescription& scene, const graph::ResourcePool& pool, std::uint32_t slot,
                   double frame_start, double frame_end);

/// Names of host inputs of cloths together: which take a step, and sizes of dispatches over those.
std::string present_name(const std::string& state);
std::string present_sizes_name(const std::string& state);

}  // namespace drape
