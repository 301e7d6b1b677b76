// The scene tells ahead how its cloths are driven.
#include "control/drive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/byte_stream.h"
#include "control/frame_judgement.h"
#include "support/sheets.h"

namespace drape {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

constexpr double gravity = 9.81;

/// A sheet hangs on one pinned edge that is moved by `way` between 1 and 1.1 s.
SceneDescription jerked(const Vec3& way) {
    SceneDescription scene = test::sheet(5, 5, 1, 1, 1);
    scene.solver = {};
    scene.time.frame_count = 121;
    Pin pin;
    pin.particles = {{0, 0}, {4, 0}};
    pin.path.keys = {{1.0, {}, {}}, {1.1, way, {}}};
    scene.cloths[0].pins = {pin};
    return scene;
}

TEST(Drive, OfAPinIsItsAcceleration) {
    const SimulationModel model(jerked({0.3, 0, 0}));
    // A leg from rest to rest in T is accelerated by 6 |way|/T^2 (1 - 2 t/T), first looked at 1/480 s after its start.
    EXPECT_THAT(drive_of(model, 60), ElementsAre(DoubleNear(gravity, 1e-9)));
    EXPECT_THAT(drive_of(model, 61), ElementsAre(DoubleNear(gravity + 172.5, 1e-3)));
    EXPECT_THAT(drive_of(model, 66), ElementsAre(DoubleNear(gravity + 172.5, 1e-3)));
    EXPECT_THAT(drive_of(model, 68), ElementsAre(DoubleNear(gravity, 1e-9)));
}

TEST(Drive, OfAPinThatHasLetGoIsNone) {
    SceneDescription scene = jerked({0.3, 0, 0});
    scene.cloths[0].pins[0].release = 0.5;
    EXPECT_THAT(drive_of(SimulationModel(scene), 61), ElementsAre(DoubleNear(gravity, 1e-9)));
}

TEST(Drive, OfATurningPinReachesAsFarAsTheCloth) {
    SceneDescription scene = jerked({0, 0, 0});
    scene.cloths[0].pins[0].path.keys[1].rotate = {0, 10, 0};
    const SimulationModel model(scene);
    const double angular = 172.5 / 0.3 * (10 * 3.14159265 / 180);  // rad/s^2
    EXPECT_THAT(drive_of(model, 61), ElementsAre(DoubleNear(gravity + angular * model.cloths[0].reach(), 0.1)));
}

TEST(Drive, OfACollider) {
    SceneDescription scene = jerked({0, 0, 0});
    Collider ball{Sphere{{0, -5, 0}, 0.2}};
    ball.path.keys = {{0.5, {}, {}}, {0.6, {0, 0.3, 0}, {}}};
    scene.colliders.push_back(ball);
    const SimulationModel model(scene);
    EXPECT_THAT(drive_of(model, 31), ElementsAre(DoubleNear(gravity + 172.5, 1e-3)));
    EXPECT_THAT(drive_of(model, 20), ElementsAre(DoubleNear(gravity, 1e-9)));
}

TEST(Drive, OfTheWindIsWhatHangsFromItsPressure) {
    SceneDescription scene = jerked({0, 0, 0});
    scene.wind.velocity = {0, 0, 7};
    // Three tenths of its pressure on a plate stretch a cloth (cloth/hang.cpp).
    const double wind = 0.3 * 0.5 * 1.2 * 7 * 7 / scene.cloths[0].areal_density;
    EXPECT_GT(wind, 1);
    EXPECT_THAT(drive_of(SimulationModel(scene), 5), ElementsAre(DoubleNear(gravity + wind, 1e-9)));
}

TEST(Drive, IsEventfulWhereItIsFarAboveTheLastProbe) {
    const SimulationModel model(jerked({0.3, 0, 0}));
    Drive drive(model);
    EXPECT_FALSE(drive.eventful(61)) << "nothing was probed yet, so the next frame is";
    drive.probed(1, 6);
    EXPECT_FALSE(drive.eventful(60));
    EXPECT_TRUE(drive.eventful(61));
    drive.probed(61, 6);
    EXPECT_FALSE(drive.eventful(66));
    // A little more drive is no event.
    const SimulationModel slow(jerked({0.001, 0, 0}));
    Drive calm(slow);
    calm.probed(1, 6);
    EXPECT_FALSE(calm.eventful(61));
}

TEST(Drive, IsEventfulWhereAPinLetsGo) {
    SceneDescription scene = jerked({0, 0, 0});
    scene.cloths[0].pins[0].release = 0.5;
    const SimulationModel model(scene);
    EXPECT_TRUE(Drive(model).eventful(31));
    EXPECT_FALSE(Drive(model).eventful(30));
}

TEST(Drive, IsReadBackForAsManyClothsAsThereAre) {
    const SimulationModel model(jerked({0.3, 0, 0}));
    const auto reads = [&](const std::vector<double>& probed) {
        ByteWriter writer;
        writer(probed);
        const std::vector<std::byte> bytes = writer.take();
        ByteReader reader(bytes);
        return Drive(model).transfer(reader);
    };
    EXPECT_TRUE(reads({}));
    EXPECT_TRUE(reads({gravity}));
    EXPECT_FALSE(reads({gravity, gravity}));
}

}  // namespace
}  // namespace drape
