// Only tiles of the picture in which something may be drawn are cleared and looked at, and the picture is the same.
#include <gtest/gtest.h>

#include "raster_picture.h"

namespace drape {
namespace {

/// A plane behind the eye is not seen, but as it moves it is no floor, and as it has no end it may be anywhere.
Collider unseen_plane() {
    Collider plane = painted(Plane{{0, 0, 1}, 50}, red);
    plane.path.keys = {{0, {}, {}}, {1, {}, {}}};
    return plane;
}

class RasterTiles : public Raster {
  protected:
    void expect_the_same_with_every_tile(const SceneDescription& scene, const std::vector<DrawnCloth>& cloths,
                                         Shot shot) {
        for (const std::uint32_t samples : {1u, 4u}) {
            shot.samples = samples;
            const Picture some = draw(scene, cloths, shot);
            SceneDescription marked = scene, empty = scene;
            marked.colliders.push_back(unseen_plane());
            EXPECT_EQ(some.bytes, draw(marked, cloths, shot).bytes) << samples;
            empty.colliders.clear();
            EXPECT_NE(some.bytes, draw(empty, {}, shot).bytes) << samples;
        }
    }
};

TEST_F(RasterTiles, OfEveryBodyAreMarked) {
    const SceneDescription room = dark_room();
    const PictureTiles tiles(width, height);
    const std::vector<Collider> bodies{painted(Sphere{{-1.2, 0.8, 0}, 0.13}, red),
                                       painted(Ellipsoid{{1.3, 0.9, 0}, {0.3, 0.1, 0.2}}, green),
                                       painted(Box{{1.2, -0.9, 0.2}, {0.1, 0.2, 0.3}}, blue),
                                       painted(Capsule{{-0.9, -0.7, 0.4}, {-0.6, -0.5, 0}, {0.1, 0.05}}, red)};
    for (const Collider& body : bodies) {
        const std::vector<std::uint32_t> marks = tiles.marks(std::span(&body, 1), 0, *room.camera);
        EXPECT_EQ(marks.size(), tiles.count());
        EXPECT_GT(std::ranges::count(marks, 0u), 0.5 * tiles.count());
        EXPECT_GT(std::ranges::count(marks, 1u), 0);
        SceneDescription scene = room;
        scene.colliders = {body};
        expect_the_same_with_every_tile(scene, {}, {.options = {.shadow = false, .shift = {0.4, -0.5}}});
    }
    const Collider plane = unseen_plane(), around = painted(Sphere{room.camera->position, 0.1}, red);
    for (const Collider& anywhere : {plane, around})
        EXPECT_EQ(std::ranges::count(tiles.marks(std::span(&anywhere, 1), 0, *room.camera), 1u), tiles.count());
}

TEST_F(RasterTiles, OfClothAreMarked) {
    SceneDescription scene = dark_room();
    scene.lights = {{{-0.3, -0.2, -1}, white, 0.6}};
    std::vector<DrawnCloth> cloths;
    for (int k = 0; k < 24; ++k) {  // in and around the picture, at places that fall everywhere on the tiles
        const Vec3 at{-1.6 + 0.29 * (k % 12), -1.2 + 0.23 * ((k * 5) % 11), 0.1 * (k % 3)};
        cloths.push_back(flat_cloth(at, {0.05 + 0.011 * k, 0.02, 0}, {-0.01, 0.04, 0.3}, {0, 0, 1}, red, blue, 3));
    }
    expect_the_same_with_every_tile(scene, cloths, {});
    // One sheet comes from before the eye to behind it.
    const DrawnCloth through = flat_cloth({0.2, -0.3, 3}, {0.3, 0, 0}, {0, 0.1, 4}, {0, 1, 0}, red, blue, 4);
    expect_the_same_with_every_tile(scene, {through}, {});
}

TEST(PictureTilesTest, AreAtMost128AlongASide) {
    EXPECT_EQ(PictureTiles(1280, 720).count(), 40u * 23u);
    EXPECT_EQ(PictureTiles(16384, 1).count(), 128u);
    EXPECT_EQ(PictureTiles(1, 4097).count(), 65u);
    EXPECT_EQ(PictureTiles(1, 1).count(), 1u);
}

}  // namespace
}  // namespace drape
