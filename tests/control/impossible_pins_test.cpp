// No substep can follow pins held inside a collider, or rigid cloth pulled apart.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "control/impossible_scene.h"
#include "reference/model_scenes.h"
#include "support/every_kind.h"

namespace drape {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// A metre of cloth is held by its two upper corners, of which the right one is pulled `outwards` over a second.
SceneDescription pulled_sheet(double outwards) {
    SceneDescription scene = model_scenes::sheet(5, 5, 1, 1, 4);
    scene.time = {60, 61};
    scene.cloths[0].pins = {model_scenes::pin_box(0, 0, 0, 0), model_scenes::pin_box(4, 0, 4, 0)};
    scene.cloths[0].pins[1].path.keys = {{0, {}, {}}, {1, {outwards, 0, 0}, {}}};
    return scene;
}

std::string impossible(const SceneDescription& scene, std::uint32_t frame) {
    return impossible_scene(SimulationModel(scene), frame);
}

TEST(ImpossiblePins, OnlyRigidClothCannotBePulledLonger) {
    SceneDescription scene = pulled_sheet(0.3);
    EXPECT_THAT(impossible(scene, 60), IsEmpty());
    scene.cloths[0].stiffness.rigid = true;
    EXPECT_THAT(impossible(scene, 0), IsEmpty());
    EXPECT_THAT(impossible(scene, 60), HasSubstr("30 % farther apart"));
    scene.cloths[0].pins[1].release = 0.5;
    EXPECT_THAT(impossible(scene, 60), IsEmpty());
}

/// Returns a shape of each kind about the held corner's place, 0.4 m and more across.
std::vector<ColliderShape> shapes_about(const Vec3& at) {
    return test::of_every_kind<Mesh>(Plane{{0, 1, 0}, at[1] + 0.1}, Sphere{at, 0.2}, Box{at, {0.2, 0.2, 0.2}},
                                     Ellipsoid{at, {0.2, 0.3, 0.2}},
                                     Capsule{{at[0] - 0.2, at[1], at[2]}, {at[0] + 0.2, at[1], at[2]}, {0.2, 0.1}});
}

TEST(ImpossiblePins, NothingIsHeldInsideACollider) {
    const SceneDescription free = pulled_sheet(0);
    for (const ColliderShape& shape : shapes_about(free.cloths[0].placement.origin)) {
        SceneDescription scene = free;
        scene.colliders.emplace_back().shape = shape;
        EXPECT_THAT(impossible(scene, 0), HasSubstr("inside /colliders/")) << shape.index();
        // The collider leaves, so that the cloth's corner is no longer inside.
        scene.colliders[0].path.keys = {{0, {}, {}}, {1, {0, -3, 0}, {}}};
        EXPECT_THAT(impossible(scene, 0), HasSubstr("inside /colliders/")) << shape.index();
        EXPECT_THAT(impossible(scene, 60), IsEmpty()) << shape.index();
    }
}

}  // namespace
}  // namespace drape
