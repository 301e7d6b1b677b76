// Functions that the three dump formats share; `dump` in plan.h chooses among them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "graph/fold.h"
#include "graph/plan.h"

namespace drape::graph {

/// Folds passes with the same declarations, label and stage.
Folding fold_passes(const Graph& graph, const Plan& plan);

/// Skipped passes of one label and one reason are counted together, in order of first appearance.
struct SkippedGroup {
    std::string what, reason;
    std::uint32_t count = 0;
};
std::vector<SkippedGroup> group_skipped(const Graph& graph, const Plan& plan);

std::size_t barrier_count(const Plan& plan);
std::string format_name(VkFormat format);    ///< "rgba32f", or "VkFormat 37" for a format without a name in Drape
std::string size_text(std::uint64_t bytes);  ///< "1.5 MiB"

std::string dump_text(const Graph& graph, const Plan& plan);
std::string dump_json(const Graph& graph, const Plan& plan);
std::string dump_dot(const Graph& graph, const Plan& plan);

}  // namespace drape::graph
