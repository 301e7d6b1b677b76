// Contact of a cloth with itself: the passes that end a substep (shaders/include/self_contact.h).
#pragma once

#include "passes/pass_kit.h"

namespace drape {

/// Reads displacement; begins the record anew.
void add_self_common(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);
/// Reads position, displacement, record; writes levels of the tree of boxes. The lowest also begins the sums and shares
/// anew; the root's says in the record whether candidates are searched.
void add_self_boxes(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);
/// Reads boxes; writes the list of cells, for now with blocks of them, where the record says so, counts them in it.
void add_self_blocks(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);
/// Reads boxes and that list; writes the candidates where the record says so, counts them in it.
void add_self_cells(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);
/// Reads position, displacement, boxes, candidates; writes the list of cells, counts them in the record.
void add_self_near(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);
/// Reads position, displacement, cells, [existing triangles]; writes the list of pairs, counts them in the record.
void add_self_pairs(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);
/// Reads position, displacement, pairs; adds to the corrections.
void add_self_contact(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);
/// Reads position; takes the corrections; updates displacement, [displacement before, line control]; the first one
/// writes what it was before.
void add_self_push(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);
/// Reads position, displacement, displacement before contact, pairs; lowers the round's shares, notes in the record
/// that it did.
void add_self_room(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);
/// Reads position, displacement before contact, shares; updates displacement, [displacement before, line control], the
/// record.
void add_self_move(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step);

/// Copies the frame's record to the host.
void add_self_readback(graph::Graph& graph, const ClothState& state);
std::string self_readback_name(const ClothModel& cloth);

}  // namespace drape
