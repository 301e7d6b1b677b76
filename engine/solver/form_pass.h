// The passes that make the fields of meshes that deform, at the begin of a frame (shared/form_types.h).
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Declares what the host tells those passes of a frame; does nothing where no mesh deforms.
void declare_forms(graph::Graph& graph, const SimulationModel& model, SceneInputs& inputs);
/// Adds the passes for frames with the model's substeps.
void add_forms(graph::Graph& graph, Pipelines& pipelines, const SimulationModel& model, SceneInputs& inputs);
/// Writes it to a slot.
void write_forms(const graph::ResourcePool& pool, std::uint32_t slot, const FormLists& lists);

}  // namespace drape
