// Contact of a cloth with itself: the passes that end a substep (shaders/include/self_contact.h).
#pragma once

#include "passes/pass_kit.h"

namespace drape {

/// Reads position and displacement; writes levels of the tree of boxes. The lowest also begins the sums anew.
void add_self_boxes(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);
/// Reads position, displacement, boxes, [cells]; writes the list of pairs, counts them in the record.
void add_self_pairs(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);
/// Reads position, displacement, pairs; adds to the corrections.
void add_self_contact(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);
/// Reads position and corrections; updates displacement, [displacement before, line control]; writes the limits.
void add_self_push(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);
/// Reads position, displacement, limits, pairs; lowers the shares, counts in the record what is not proved.
void add_self_room(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);
/// Reads position, limits, shares; updates displacement, [displacement before, line control], the record.
void add_self_move(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);

/// Copies the frame's record to the host.
void add_self_readback(graph::Graph& graph, const ClothState& state);
std::string self_readback_name(const ClothModel& cloth);

}  // namespace drape
