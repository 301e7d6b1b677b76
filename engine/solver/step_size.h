// The sizes of the steps' dispatches.
#pragma once

#include "solver/step_row.h"

namespace drape {

/// Rounds of loops that a particle may take at most in a step: what bounds the particles of an invocation.
std::size_t step_rounds(const StepPlace& place);
/// Workgroup width of nested boxes: one subgroup where cores are few, since others would only take turns with it at
/// every barrier; more where the default device would break off.
std::uint32_t nested_group(const StepPlace& place);

using vulkan::ComputePipeline;
DispatchSize one_invocation(const StepPlace& place, const ComputePipeline&);
DispatchSize one_workgroup(const StepPlace& place, const ComputePipeline&);
DispatchSize over_bodies(const StepPlace& place, const ComputePipeline&);
DispatchSize one_workgroup_of_bodies(const StepPlace& place, const ComputePipeline&);
DispatchSize over_particles(const StepPlace& place, const ComputePipeline&);
DispatchSize over_strips(const StepPlace& place, const ComputePipeline&);
DispatchSize over_columns(const StepPlace& place, const ComputePipeline&);       ///< strip_rows(step_rounds) each
DispatchSize over_wide_columns(const StepPlace& place, const ComputePipeline&);  ///< and strip_columns() of them
DispatchSize over_pins(const StepPlace& place, const ComputePipeline&);
DispatchSize over_sewn_particles(const StepPlace& place, const ComputePipeline&);
DispatchSize over_springs(const StepPlace& place, const ComputePipeline&);
DispatchSize over_bends(const StepPlace& place, const ComputePipeline&);
DispatchSize over_twists(const StepPlace& place, const ComputePipeline&);
DispatchSize over_lines(const StepPlace& place, const ComputePipeline&);
DispatchSize over_line_particles(const StepPlace& place, const ComputePipeline&);
DispatchSize over_line_parts(const StepPlace& place, const ComputePipeline& pipeline);
DispatchSize over_nested_pins(const StepPlace& place, const ComputePipeline& pipeline);
DispatchSize over_gas_sums(const StepPlace& place, const ComputePipeline&);
DispatchSize over_torque_sums(const StepPlace& place, const ComputePipeline&);
DispatchSize over_explicit_stream(const StepPlace& place, const ComputePipeline&);
DispatchSize over_spring_stream(const StepPlace& place, const ComputePipeline&);
DispatchSize over_twist_stream(const StepPlace& place, const ComputePipeline&);
/// Tiles of the step's kind, one invocation per particle of a tile.
DispatchSize over_tiles(const StepPlace& place, const ComputePipeline&);
DispatchSize over_residual_strips(const StepPlace& place, const ComputePipeline&);

}  // namespace drape
