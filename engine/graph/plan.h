// Turns declarations into a plan: culling, barriers, lifetimes, sizes. It is a pure function of the Graph.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "graph/graph.h"

namespace drape::graph {

/// The stages and accesses of one use, and the image layout that it needs.
struct AccessScope {
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 accesses;
    VkImageLayout layout;
};
/// Storage and copies use GENERAL, attachments their own layouts. The layout thus follows from the access alone, so a
/// pass knows it when it records (PassContext::layout).
AccessScope access_scope(Access access);
/// Returns the physical copies of a resource: one per frame slot for host inputs and outputs.
std::uint32_t copy_count(const Resource& resource);

struct Barrier {
    std::uint32_t resource;
    VkPipelineStageFlags2 source_stages, destination_stages;
    VkAccessFlags2 source_accesses, destination_accesses;
    VkImageLayout old_layout, new_layout;  ///< equal when the layout does not change (and for buffers)
    std::string reason;                    ///< "banner/displacement: write by force -> read by spring row even"
};

struct PlannedPass {
    std::uint32_t pass;             ///< index into Graph::passes()
    std::vector<Barrier> barriers;  ///< to be executed before the pass
};

struct Lifespan {
    std::uint32_t first = UINT32_MAX, last = 0;  ///< indices into Plan::passes; first > last: not used
    bool used() const { return first <= last; }
};

struct Plan {
    std::vector<PlannedPass> passes;      ///< in execution order = declaration order
    std::vector<Barrier> final_barriers;  ///< after the last pass: device writes to the host
    std::vector<Lifespan> lifespans;      ///< per resource of the graph
    std::vector<Remark> skipped;          ///< the remarks of the graph, then the passes that culling removed, and why
    std::uint64_t byte_count = 0;         ///< bytes of all used resources, copies per frame slot counted
};

/// Culls every pass whose written versions nobody wanted reads (wanted: the final versions of persistent and
/// host_output resources, transitively), then derives the barriers. A plan may follow any plan of the same resources,
/// so the first use of every persistent resource waits for all earlier work (also write-after-read), transients
/// included because their memory is reused; host inputs need none (a submit makes host writes visible); these entry
/// barriers all stand before the first pass. Images rest in GENERAL between plans; transients start UNDEFINED, but for
/// those with a buffer view: those never change their layout. A pass that declares host_read is always wanted. Throws
/// GraphError when a wanted pass reads a transient or host_output version nobody wrote.
Plan make_plan(const Graph& graph);

/// Returns what runs, and what was skipped and why. `format`: "text", "json" or "dot". Text folds repeated substeps.
std::string dump(const Graph& graph, const Plan& plan, const std::string& format);

}  // namespace drape::graph
