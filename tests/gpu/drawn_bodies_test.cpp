// Bodies are drawn where they are.
#include "picture/drawn_bodies.h"

#include <gtest/gtest.h>

#include "raster_picture.h"

namespace drape {
namespace {

TEST(DrawnBodies, BodiesThatClothMovesAreFoundBehindTheOneLeftOut) {
    SceneDescription scene;
    scene.colliders = {painted(Plane{{0, 1, 0}, 0}, white), painted(Sphere{{0, 1, 0}, 0.2}, red),
                       painted(Sphere{{1, 1, 0}, 0.2}, blue)};
    BodyState moved;
    moved.collider = 2;
    moved.position = {3, 2, 1};
    for (const std::optional<std::size_t> left_out : {std::optional<std::size_t>(0), std::optional<std::size_t>()}) {
        const DrawnBodies bodies(scene, left_out);
        const std::vector<Collider> all = bodies.at(0, {&moved, 1});
        const std::size_t first = left_out ? 0 : 1;
        ASSERT_EQ(all.size(), 2 + first);
        EXPECT_EQ(std::get<Sphere>(all[first].shape).center, (Vec3{0, 1, 0}));
        EXPECT_EQ(collider_pose(all[first + 1], 0).center, (Vec3{3, 2, 1}));
        EXPECT_EQ(bodies.ids(4).back(), 7);
    }
}

}  // namespace
}  // namespace drape
