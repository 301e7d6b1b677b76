// Says what a run proved about contact, for which triangles, and what a user can do where the proof failed.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drape/simulation.h"
#include "output/manifest.h"

namespace drape {

/// Returns, by cloth, the triangles that the cuts up to the frame `last` split, in the order of their frames. A cut
/// takes effect in the next frame, so one that the last frame found split nothing that was seen.
std::vector<Manifest::SplitTriangles> split_triangles(std::span<const Manifest::Cut> cuts, std::int64_t last);

/// Writes into the manifest what was proved about contact between cloths, and what contact leaves out.
void describe_contact(Manifest& manifest, const Simulation& simulation, std::span<const Manifest::Cut> cuts);

/// Returns the note about triangles that contact leaves out, as the manifest says; nothing where there are none. It is
/// no warning, since a cut has to go through the cells somewhere.
std::optional<std::string> left_out_triangles(const Manifest& manifest);

/// Returns the warning for a run whose cloths touched and may have crossed. Those that started crossed were reported
/// before.
std::optional<std::string> lost_proof(const Simulation& simulation);

/// Returns the warning for a run in which truncation held cloth back too far.
std::optional<std::string> held_back(const Simulation& simulation);

/// Returns the warning for a run whose cloths started through each other and did not come apart.
std::optional<std::string> still_crossed(const Simulation& simulation);

}  // namespace drape
