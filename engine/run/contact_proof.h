// Says what a run proved of contact, of which triangles, which ones the wind left out, and what a user can do where it
// did not.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drape/simulation.h"
#include "output/manifest.h"

namespace drape {

/// Returns per cloth the triangles that the cuts of a run to the frame `last` split, in the order of their first
/// frames. A cut acts from the next frame on, so one that the last frame found split nothing that was seen.
std::vector<Manifest::SplitTriangles> split_triangles(std::span<const Manifest::Cut> cuts, std::int64_t last);

/// Tells the manifest what was proved of contact between cloths, and what contact and wind leave out.
void describe_contact(Manifest& manifest, const Simulation& simulation, std::span<const Manifest::Cut> cuts);

/// Returns what to tell of triangles that contact or the wind leaves out, as the manifest says; nothing where there are
/// none. It is no warning, as a cut has to go through the cells somewhere.
std::optional<std::string> left_out_triangles(const Manifest& manifest);

/// Returns what to tell a run whose cloths met and may have crossed; those that started so were told of before.
std::optional<std::string> lost_proof(const Simulation& simulation);

/// Returns what to tell a run in which truncation held cloth back too far.
std::optional<std::string> held_back(const Simulation& simulation);

/// Returns what to tell a run whose cloths started through each other and did not come apart.
std::optional<std::string> still_crossed(const Simulation& simulation);

}  // namespace drape
