// Passes around the attempts at a frame in a closed loop: keeping the state that the frame starts from, going back to
// it, giving it substeps of another length, remembering where a run with half the substeps ended, comparing with it.
#pragma once

#include "solver/cloth_layout.h"

namespace drape {

inline constexpr const char* attempt_name = "attempt";
/// Host output buffer with the differences of a state's cloths (ClothState::name, count), difference_count each.
std::string difference_readback_name(const std::string& state);
/// That of the squared distances of the bodies that lie with it.
std::string body_distance_name(const std::string& state);

/// Does what `step` does with the state for what contact between the cloths hands from frame to frame.
void add_contact_attempt(graph::Graph& graph, ContactHandles& contact, StateStep step);
/// `first_change`: place in `attempt` of the change of the state's first cloth; the others' follow.
void add_attempt(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SceneInputs& inputs,
                 const SimulationModel& run, StateStep step, std::size_t first_change);
/// Returns how far the slot's last comparison found each cloth from the coarse run, m.
std::vector<double> read_differences(const ClothLayout& layout, const graph::ResourcePool& pool, std::uint32_t slot);

}  // namespace drape
