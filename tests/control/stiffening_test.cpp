// Keys that make a cloth stiffer do work on it, of which the watch knows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/byte_stream.h"
#include "support/watched_sheet.h"

namespace drape {
namespace {

using test::hanging;
using test::resting;
using test::said;
using testing::HasSubstr;
using testing::IsEmpty;

/// Returns what is said of the last of two frames about `t` = 1 s, before and after the stiffness rises to ten times.
std::string said_as_it_stiffens(const SceneDescription& scene, double stored, double kinetic) {
    const SimulationModel model(scene);
    Watch watch(model);
    ClothStatistics soft = resting();
    soft.potential_energy -= 1;  // it hangs down by 1 J, of which springs hold so much
    soft.elastic_energy = stored;
    if (watch.implausible(60, {soft})) return "before";
    soft.potential_energy += 1;
    soft.kinetic_energy = kinetic;
    const auto found = watch.implausible(61, {soft});
    return found ? found->what : std::string();
}

TEST(StiffeningTest, StiffnessThatRisesDoesWorkOnWhatIsStored) {
    SceneDescription scene = hanging();
    EXPECT_THAT(said_as_it_stiffens(scene, 0.5, 5), HasSubstr("gained 5 J, where at most 1.39 J are explained"));
    scene.cloths[0].stiffness_keys = {{60 / 60.0, 0.1}, {60.5 / 60, 1}};
    EXPECT_THAT(said_as_it_stiffens(scene, 0.5, 5), IsEmpty());  // 9 times 0.5 J more
    EXPECT_THAT(said_as_it_stiffens(scene, 0.5, 6), HasSubstr("gained 6 J, where at most 5.89 J are explained"));
    EXPECT_THAT(said_as_it_stiffens(scene, 0, 5), HasSubstr("where at most 1.39 J are explained"));
    scene.cloths[0].stiffness_keys = {{60 / 60.0, 1}, {60.5 / 60, 0.1}};
    EXPECT_THAT(said_as_it_stiffens(scene, 0.5, 5), HasSubstr("where at most 1.39 J are explained"));
}

TEST(StiffeningTest, ClothThatExplodesWhileItStiffensIsNoResult) {
    SceneDescription scene = hanging();
    scene.cloths[0].stiffness_keys = {{0, 0.5}, {2, 1}};
    const SimulationModel model(scene);
    Watch watch(model);
    ClothStatistics lively = resting();
    std::optional<Implausible> found;
    std::uint32_t frame = 0;
    for (double energy = 1e-3; !found && frame < 60; energy *= 1.5, ++frame) {  // in springs and motion alike
        lively.elastic_energy = lively.kinetic_energy = energy;
        found = watch.implausible(frame, {lively});
    }
    ASSERT_TRUE(found);
    EXPECT_THAT(found->what, HasSubstr("the cloth has gained"));
    EXPECT_LT(found->value, 4);  // a tenth of m g d is 1.39 J, and the factor rises by less than a half meanwhile
}

TEST(StiffeningTest, ItRemembersTheWorkOfStiffness) {
    SceneDescription scene = hanging();
    scene.cloths[0].stiffness_keys = {{0, 0.1}, {0.5, 1}};
    const SimulationModel model(scene);
    Watch whole(model), resumed(model);
    ClothStatistics stretched = resting();
    stretched.potential_energy -= 1;
    stretched.elastic_energy = 0.5;
    for (std::uint32_t frame = 0; frame < 20; ++frame) EXPECT_FALSE(whole.implausible(frame, {stretched}));
    ByteWriter writer;
    EXPECT_TRUE(whole.transfer(writer));
    const std::vector<std::byte> bytes = writer.take();
    ByteReader reader(bytes);
    EXPECT_TRUE(resumed.transfer(reader));
    EXPECT_EQ(reader.left(), 0u);
    stretched.kinetic_energy = 50;
    const auto one = whole.implausible(20, {stretched}), other = resumed.implausible(20, {stretched});
    ASSERT_TRUE(one && other);
    EXPECT_EQ(one->bound, other->bound);
    EXPECT_GT(one->bound, 2);
    const SimulationModel steady(hanging());
    ByteReader again(bytes);
    EXPECT_TRUE(!Watch(steady).transfer(again) || again.left() > 0);
}

TEST(StiffeningTest, ClothThatWasSoftComesBackFast) {
    ClothStatistics fast = resting();
    fast.largest_speed = 100;
    fast.potential_energy -= 0.1;
    SceneDescription scene = hanging();
    EXPECT_THAT(said(scene, 100, fast), HasSubstr("where at most 74.6 m/s are explained"));
    scene.cloths[0].stiffness.stretch = 1000;
    scene.cloths[0].stiffness_keys = {{0, 0.01}, {1, 1}};  // 9.81 m/s^2 1 m / (0.01 sqrt(1000) m/s) = 31 m/s
    EXPECT_THAT(said(scene, 100, fast), IsEmpty());
    fast.largest_speed = 400;
    EXPECT_THAT(said(scene, 100, fast), HasSubstr("where at most 385 m/s are explained"));
}

}  // namespace
}  // namespace drape
