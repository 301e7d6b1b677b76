// The scenes that `auto` is judged by are the same every time, hold all that a scene may hold, and nothing impossible.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "bench/random_scenes.h"
#include "bench/trial.h"
#include "cloth/simulation_model.h"

namespace drape::bench {
namespace {

constexpr std::uint32_t scene_count = 1500;

double length(const Vec3& v) { return std::hypot(v[0], v[1], v[2]); }

TEST(WildScenesTest, ASeedAndAnIndexAreAScene) {
    for (auto* scene : {full_random_scene, wild_scene})
        for (const std::uint32_t index : {0u, 1u, 77u}) {
            EXPECT_EQ(scene(3, index), scene(3, index)) << index;
            EXPECT_NE(scene(3, index), scene(3, index + 1)) << index;
            EXPECT_NE(scene(3, index), scene(4, index)) << index;
        }
}

TEST(WildScenesTest, HoldAllThatASceneMayHold) {
    std::map<std::string, std::size_t> tags;
    std::set<int> collider_kinds, moving_kinds;
    std::set<std::uint32_t> sides;
    std::set<std::size_t> cloth_counts;
    double strongest_wind = 0, stiffest_bend = 0, lightest = 1, heaviest = 0;
    for (std::uint32_t index = 0; index < scene_count; ++index) {
        const SceneDescription scene = wild_scene(5, index);
        for (const std::string& tag : tags_of(scene)) ++tags[tag];
        for (const Collider& collider : scene.colliders)
            (collider.path.moves() ? moving_kinds : collider_kinds).insert(collider.kind());
        for (const Cloth& cloth : scene.cloths) {
            sides.insert(cloth.grid.begin(), cloth.grid.end());
            stiffest_bend = std::max(stiffest_bend, cloth.stiffness.bend);
            lightest = std::min(lightest, cloth.areal_density);
            heaviest = std::max(heaviest, cloth.areal_density);
        }
        strongest_wind = std::max(strongest_wind, length(scene.wind.velocity));
        cloth_counts.insert(scene.cloths.size());
        EXPECT_GE(scene.time.frame_count, 30u);
        EXPECT_LE(scene.time.frame_count, 90u);
        EXPECT_EQ(scene.solver, SolverSettings{}) << "auto, and nothing that would help it";
    }
    EXPECT_EQ(tags.size(), 13u);
    for (const auto& [tag, count] : tags) EXPECT_GT(count, scene_count / 50) << tag;
    EXPECT_EQ(collider_kinds.size(), std::size(collider_lists) - 1) << "a mesh is a file";
    EXPECT_EQ(moving_kinds.size(), std::size(collider_lists) - 2) << "a plane stays where it is, too";
    EXPECT_EQ(*sides.begin(), 2u);
    EXPECT_EQ(*sides.rbegin(), 129u);
    EXPECT_EQ(cloth_counts, (std::set<std::size_t>{1, 2, 3}));
    EXPECT_GT(strongest_wind, 55);
    EXPECT_LE(strongest_wind, 60);
    EXPECT_GT(stiffest_bend, 5e-3);
    EXPECT_LT(lightest, 0.03);
    EXPECT_GT(heaviest, 0.8);
}

/// Returns the pins' distance at the end over that at the start, which is 1 but for pulled cloth.
double pulled_to(const Cloth& cloth) {
    if (cloth.pins.size() != 2 || cloth.pins[0].path.moves() || !cloth.pins[1].path.moves()) return 1;
    const bool sideways = cloth.pins[1].particles.first[0] > 0 && cloth.pins[1].particles.first[1] == 0;
    return 1 + length(cloth.pins[1].path.keys.back().translate) / cloth.size[sideways ? 0 : 1];
}

TEST(WildScenesTest, HoldNothingThatCannotBe) {
    std::size_t pulled_count = 0;
    for (std::uint32_t index = 0; index < scene_count; ++index) {
        const SceneDescription scene = wild_scene(5, index);
        for (const Cloth& cloth : scene.cloths) {
            EXPECT_NEAR(length(cloth.placement.u), 1, 1e-12);
            EXPECT_NEAR(length(cloth.placement.v), 1, 1e-12);
            for (const Pin& pin : cloth.pins) {
                const std::vector<MotionKey>& keys = pin.path.keys;
                for (std::size_t k = 1; k < keys.size(); ++k) EXPECT_GT(keys[k].time, keys[k - 1].time) << index;
                EXPECT_LT(pin.particles.last[0], cloth.grid[0]);
                EXPECT_LT(pin.particles.last[1], cloth.grid[1]);
            }
            EXPECT_LE(pulled_to(cloth), cloth.stiffness.rigid ? 1 : 1.16) << index;
            pulled_count += pulled_to(cloth) > 1 ? 1 : 0;
        }
    }
    EXPECT_GT(pulled_count, scene_count / 20);
}

/// Counts the particles, of any cloth, that start within a collider.
std::size_t buried_count(const SceneDescription& scene) {
    std::size_t count = 0;
    const SimulationModel model(scene);
    for (const ClothModel& cloth : model.cloths)
        for (const glsl::vec4& x : cloth.position)
            for (const Collider& collider : scene.colliders) {
                const Vec3 place = {x.x, x.y, x.z};
                if (const auto* sphere = std::get_if<Sphere>(&collider.shape))
                    count += length({place[0] - sphere->center[0], place[1] - sphere->center[1],
                                     place[2] - sphere->center[2]}) < sphere->radius;
                if (const auto* plane = std::get_if<Plane>(&collider.shape))
                    count += plane->normal[0] * place[0] + plane->normal[1] * place[1] + plane->normal[2] * place[2] <
                             plane->offset;
            }
    return count;
}

TEST(WildScenesTest, CanBeModelledAndStartClearOfColliders) {
    for (std::uint32_t index = 0; index < 40; ++index) {
        EXPECT_NO_THROW(SimulationModel{full_random_scene(1, index)}) << index;
        EXPECT_NO_THROW(SimulationModel{wild_scene(1, index)}) << index;
        EXPECT_EQ(buried_count(wild_scene(1, index)), 0u) << index;
    }
}

}  // namespace
}  // namespace drape::bench
