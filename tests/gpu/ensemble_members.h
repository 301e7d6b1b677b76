// Members of ensembles that tests draw, and what they are held against: each scene alone.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "drape/ensemble.h"

namespace drape::test {

/// Returns a sheet that hangs from a moving corner and another that lets go, in wind, over a ball and a floor.
SceneDescription scene_of(const std::vector<std::string>& overrides = {});
inline const std::vector<std::string> every_method{"line", "explicit", "relax", "auto"};
/// The scene by a method; `auto` chooses its substeps.
SceneDescription scene_by(const std::string& method);
/// Draws every number that members may have of their own.
std::vector<SceneDescription> drawn(const SceneDescription& scene, std::size_t count, std::uint32_t seed);

std::vector<float> of_member(const MemberArray& array, std::size_t member);
bool same_bytes(std::span<const float> one, std::span<const float> other);

/// Has lists of what an only member is told, of which `actions` is a view.
struct ToldLists {
    std::vector<double> wind, gravity, pins, colliders, hands, loads;
    std::vector<std::uint8_t> holds;
    std::vector<std::int32_t> grasps;

    EnsembleActions actions() const {
        return {.wind = wind,
                .pins = pins,
                .colliders = colliders,
                .holds = holds,
                .gravity = gravity,
                .hands = hands,
                .grasps = grasps,
                .loads = loads};
    }
};

/// Steps an ensemble and every member's scene alone, to the same bits. `together`: members share dispatches.
void expect_each_as_alone(const std::vector<SceneDescription>& scenes, std::uint32_t frames, bool together);
/// Resets members 1 and 4, and restores member 3, of at least five.
void expect_reset_and_restored(const std::vector<SceneDescription>& members);

}  // namespace drape::test
