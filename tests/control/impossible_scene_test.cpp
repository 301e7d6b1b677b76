// A refusal says what makes a scene impossible, where that is known.
#include "control/impossible_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reference/model_scenes.h"

namespace drape {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

Collider collider(const ColliderShape& shape) {
    Collider result;
    result.shape = shape;
    return result;
}

TEST(ImpossibleScene, RoomBetweenCollidersIsThatOfTheirClosestPoints) {
    const Collider ball = collider(Sphere{{0, 0, 0}, 0.5});
    EXPECT_NEAR(room_between(ball, collider(Sphere{{3, 4, 0}, 1}), 0), 3.5, 1e-6);
    EXPECT_NEAR(room_between(ball, collider(Plane{{0, 1, 0}, -2}), 0), 1.5, 1e-6);
    EXPECT_NEAR(room_between(ball, collider(Capsule{{2, -9, 0}, {2, 9, 0}, {0.25, 0.25}}), 0), 1.25, 1e-6);
    EXPECT_NEAR(room_between(ball, collider(Ellipsoid{{2, 0, 0}, {0.5, 3, 1}}), 0), 1, 1e-6);
    Collider box = collider(Box{{2, 0, 0}, {1, 1, 1}});
    EXPECT_NEAR(room_between(ball, box, 0), 0.5, 1e-6);
    box.rotate = {0, 0, 45};  // its edge is nearest
    EXPECT_NEAR(room_between(ball, box, 0), 1.5 - std::sqrt(2.0), 1e-6);
    EXPECT_EQ(room_between(ball, collider(Sphere{{0.6, 0, 0}, 0.5}), 0), 0) << "they overlap";
}

/// A sheet lies on a ball of 0.2 m, onto which another falls by `way` in a second; between them there is 0.1 m.
SceneDescription press(double way) {
    SceneDescription scene = model_scenes::sheet(5, 5, 1, 1, 4);
    scene.time = {60, 61};
    scene.colliders = {collider(Sphere{{0, -0.2, 0}, 0.2}), collider(Sphere{{0, 0.3, 0}, 0.2})};
    scene.cloths[0].contact = ContactOf::particles;
    scene.cloths[0].thickness = 0.004;
    scene.colliders[1].path.keys = {{0, {}, {}}, {1, {0, -way, 0}, {}}};
    return scene;
}

std::string reason_for(const SceneDescription& scene, std::uint32_t frame) {
    return impossible_scene(SimulationModel(scene), frame);
}

TEST(ImpossibleScene, CollidersThatLeaveNoRoomForCloth) {
    EXPECT_THAT(reason_for(press(0.091), 60), IsEmpty()) << "it takes twice its thickness";
    EXPECT_THAT(reason_for(press(0.093), 30), IsEmpty());
    EXPECT_THAT(reason_for(press(0.093), 60),
                HasSubstr("/colliders/spheres/0 and /colliders/spheres/1 leave 0.007 m between them, where cloth"));
    EXPECT_THAT(reason_for(press(0.093), 60), HasSubstr("takes 0.008"));
    EXPECT_THAT(reason_for(press(0.2), 60), HasSubstr("leave 0 m"));
    SceneDescription joined = press(0);  // nothing was ever between them
    joined.colliders[1].shape = Sphere{{0, 0.1, 0}, 0.2};
    joined.colliders[1].path.keys = {{0, {}, {}}, {1, {0, -0.1, 0}, {}}};
    EXPECT_THAT(reason_for(joined, 60), IsEmpty());
}

TEST(ImpossibleScene, WindThatTakesClothAlongAtOnce) {
    SceneDescription scene = model_scenes::sheet(5, 5, 1, 1, 4);
    scene.time = {60, 61};
    scene.cloths[0].areal_density = 0.005;
    scene.wind.velocity = {0, 0, 40};
    EXPECT_THAT(reason_for(scene, 6), HasSubstr("wind takes cloth 'sheet' to its own speed 80 times over in a frame"));
    scene.cloths[0].areal_density = 0.15;
    EXPECT_THAT(reason_for(scene, 6), IsEmpty());
}

}  // namespace
}  // namespace drape
