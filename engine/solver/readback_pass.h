// Images of the state to the host, for exports and checks; never on the simulation's way.
#pragma once

#include "solver/cloth_layout.h"

namespace drape {

/// What is read back of the state of bodies (ClothSolver::add_body_readback).
inline constexpr const char* bodies_readback = "body";

/// What is read back of forces (ClothSolver::add_field_readback).
inline constexpr const char* contact_readback = "contact impulse";
inline constexpr const char* tension_readbacks[] = {"row tension", "column tension", "down-right tension",
                                                    "down-left tension"};

/// Name of the host_output buffer that `add_readback` fills for a state (ClothState::name, count): 16 bytes, or 4
/// of one float, for each particle, cloth by cloth.
std::string readback_name(const std::string& state, std::string_view what);

/// Copies an image of one or four floats per particle, the cloths' `what`, into a host_output buffer.
void add_readback(graph::Graph& graph, const ClothState& state, graph::Handle image, std::string_view what);

/// Copies a whole image into a host_output buffer called `host_name`, row by row.
void add_image_readback(graph::Graph& graph, const graph::PassName& name, graph::Handle image,
                        const std::string& host_name);

/// Returns what the slot's last frame read back of each cloth, particle by particle.
std::vector<std::span<const float>> read_back(const ClothLayout& layout, const graph::ResourcePool& pool,
                                              std::uint32_t slot, std::string_view what);

/// Returns what the statistics take for the velocity (end_velocity.h), m/s: x y z and 0 per particle, of displacement
/// and excess displacement that were read back, m per substep.
void write_velocities(std::span<const float> moved, std::span<const float> excess, double substeps_per_second,
                      std::span<float> velocities);

/// Copies `byte_count` bytes of a buffer from `offset` on into a host_output buffer called `host_name`.
void add_buffer_readback(graph::Graph& graph, const graph::PassName& name, graph::Handle buffer, std::uint64_t offset,
                         std::uint64_t byte_count, const std::string& host_name);

}  // namespace drape
