// The search for springs and triangles of a cloth that the cutters cross, at the end of a frame.
#pragma once

#include "cloth/cut_topology.h"
#include "solver/pass_kit.h"

namespace drape {

/// Names of what the pass leaves for the host. `cut_count_name`: one uint, springs crossed, per frame slot.
std::string cut_count_name(const ClothModel& cloth);
std::string cut_flags_name(const ClothModel& cloth);
std::string cut_fractions_name(const ClothModel& cloth);
inline constexpr const char* cutters_name = "cutters";

/// Declares the cutters' host input: cutter_triangle_count triangles per cutter.
graph::Handle declare_cutters(graph::Graph& graph, std::size_t cutter_count);

/// Adds a pass that clears a count, one uint per frame slot, which a later pass adds to. Returns the count.
graph::Handle add_cleared_count(graph::Graph& graph, const graph::PassName& pass, const std::string& name);

/// Reads position (and stiffness and cells of a cloth that has them) and the cutters; writes flags, fractions and
/// the count.
void add_cut(graph::Graph& graph, Pipelines& pipelines, ClothState& state, graph::Handle cutters,
             std::size_t cutter_count);

/// Fetches flags and fractions of a cloth that was hit: a submit and a wait.
CutFindings read_findings(const graph::ResourcePool& pool, const ClothModel& cloth);

}  // namespace drape
