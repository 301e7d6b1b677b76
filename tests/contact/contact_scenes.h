// Scenes, as texts of scene files, in which cloths are pressed, wound, piled and thrown onto themselves and each other.
#pragma once

#include <cstdint>
#include <string>

namespace drape::test {

/// A weightless strip 1.8 m long and 0.2 m wide, of 8 n + 1 by n + 1 particles, is wound between two bars that turn
/// against each other 8 times in all.
std::string twisted_strip(std::uint32_t n, std::uint32_t frames, std::uint32_t substeps);

/// A strip 1 m long of 25 by 9 particles, with weight, is wound to and fro by 1.25 turns.
std::string wrung_strip(std::uint32_t frames);

/// A sheet of n x n particles falls on its lower edge, so that it folds to and fro on the ground.
std::string folding_sheet(std::uint32_t n, std::uint32_t frames, std::uint32_t substeps);

/// The same sheet, which a blade cuts in two after 0.7 s, while it folds.
std::string cut_folds(std::uint32_t n, std::uint32_t frames, std::uint32_t substeps);

/// Sheets of n x n particles, so far apart, each turned against the one below, fall onto a ball and each other.
std::string falling_stack(std::uint32_t count, std::uint32_t n, std::uint32_t frames, std::uint32_t substeps,
                          std::uint32_t apart_mm);

/// An upright sheet of n x n particles, 1 m high, stands on the ground below a plate that comes down to 6 cm in 6 s.
std::string crumpled_sheet(std::uint32_t n, std::uint32_t frames, std::uint32_t substeps);

/// A strip 0.72 m long, of n links, falls on its lower edge; how high it lies in the end does not depend on n.
std::string collapsing_strip(std::uint32_t n, std::uint32_t frames, std::uint32_t substeps);

/// A sheet starts 30 mm deep in the ground, which leads it out at 0.1 m/s. 8 mm above it another one, aslant, is held.
std::string led_sheet();

/// Scene number `index` of a seed is the same on every machine: one to three cloths of 5 x 5 to 15 x 15 particles and
/// all that a scene may hold, mostly thrown at each other, some so wildly that the proof is lost.
std::string random_contact_scene(std::uint64_t seed, std::uint32_t index);

}  // namespace drape::test
