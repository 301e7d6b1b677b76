// Cloth that starts in a given shape, and cells that differ as a map says: read, and found wrong before anything else.
#include "../support/given_files.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "base/vectors.h"
#include "drape/scene_reader.h"
#include "world/contact_shape.h"
#include "world/start.h"
#include "world/start_crossings.h"

namespace drape::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class GivenFiles : public ::testing::Test {
  protected:
    /// Reads a scene of one cloth of 4 x 3 particles, half a metre apart.
    SceneResult read(const std::string& members, const std::string& more = "") const {
        write_text(folder_ / "scene.json",
                   fmt::format("{{\"cloths\": [{{\"grid\": [4, 3], \"size\": [1.5, 1],\n{}}}]{}}}", members, more));
        return read_scene((folder_ / "scene.json").string());
    }
    std::vector<std::string> errors(const std::string& members) const { return texts(read(members).errors); }
    static std::vector<std::string> texts(const std::vector<SceneError>& errors) {
        std::vector<std::string> texts;
        for (const SceneError& error : errors)
            texts.push_back(error.text().substr(error.text().find("scene.json") + 10));
        return texts;
    }
    void put_start(const std::vector<float>& values) const {
        write_text(folder_ / "shape.npy", npy_of("<f4", "3, 4, 3", values));
    }
    /// Writes the wavy sheet with one particle elsewhere.
    void put_start_with(std::size_t particle, const Vec3& at) const {
        std::vector<float> values = wavy_sheet(4, 3, 0.5);
        for (std::size_t k = 0; k < 3; ++k) values[3 * particle + k] = static_cast<float>(at[k]);
        put_start(values);
    }

    TemporaryFolder folder_;
};

TEST_F(GivenFiles, AStartIsLookedForBesideTheScene) {
    put_start(wavy_sheet(4, 3, 0.5));
    const SceneResult result = read(R"("start": "shape.npy")");
    ASSERT_TRUE(result.scene) << result.errors[0].text();
    EXPECT_EQ(result.files, std::vector<std::string>{"shape.npy"});
    const Cloth& cloth = result.scene->cloths[0];
    ASSERT_EQ(cloth.start.size(), 12u);
    EXPECT_EQ(cloth.start[5], (Vec3{0.5, 1.4f, 0.5}));
    EXPECT_EQ(start_positions(cloth), cloth.start);
    EXPECT_EQ(start_place(cloth, 1, 1), cloth.start[5]);
    EXPECT_NEAR(std::abs(start_normal(cloth)[1]), 1, 0.2);
    // A text has no place: its files are looked for in the working directory, or where its caller says.
    const std::string text = R"({"cloths": [{"grid": [4, 3], "size": [1.5, 1], "start": "shape.npy"}]})";
    EXPECT_FALSE(read_scene_text(text, "text").scene);
    const SceneResult told = read_scene_text(text, "text", {}, folder_.path().string());
    ASSERT_TRUE(told.scene);
    EXPECT_EQ(told.scene->cloths[0].start, cloth.start);
    EXPECT_THAT(resolved_scene(text, {}, folder_.path().string()),
                AllOf(HasSubstr("\"start\":\"shape.npy\""), ::testing::Not(HasSubstr("placement"))));
}

TEST_F(GivenFiles, WhatIsWrongWithAStartIsSaidWhereItIsNamed) {
    EXPECT_THAT(errors(R"("start": "none.npy")"), ElementsAre(AllOf(HasSubstr(":2:10: /cloths/0/start: cannot read"),
                                                                    HasSubstr("none.npy': No such file"))));
    write_text(folder_ / "shape.npy", npy_of("<f4", "4, 3, 3", wavy_sheet(3, 4, 0.5)));
    EXPECT_THAT(errors(R"("start": "shape.npy")"),
                ElementsAre(AllOf(HasSubstr("(3, 4, 3) or (frames, 3, 4, 3)"), HasSubstr("float32 (4, 3, 3)"))));
    put_start_with(6, {0, std::nan(""), 0});
    EXPECT_THAT(errors(R"("start": "shape.npy")"),
                ElementsAre(HasSubstr("expected finite places, got nan for particle [2, 1] in 'shape.npy'")));
    put_start_with(6, {0, 1, 0});
    EXPECT_THAT(errors(R"("start": "shape.npy")"),
                ElementsAre(HasSubstr("got one place for particle [0, 0] and particle [2, 1] in 'shape.npy'")));
    std::vector<double> far(36, 1e300);
    write_text(folder_ / "shape.npy", npy_of("<f8", "3, 4, 3", far));
    EXPECT_THAT(errors(R"("start": "shape.npy")"), ElementsAre(HasSubstr("finite places, got 1e+300")));
    std::vector<float> line;
    for (int i = 0; i < 12; ++i) line.insert(line.end(), {0.1f * static_cast<float>(i), 1, 0});
    put_start(line);
    EXPECT_THAT(errors(R"("start": "shape.npy")"), ElementsAre(HasSubstr("thinner than single precision tells")));
    put_start(wavy_sheet(4, 3, 0.5));
    EXPECT_THAT(errors(R"("placement": {"jitter": 0.1}, "start": "shape.npy")"),
                ElementsAre(HasSubstr(":2:14: /cloths/0/placement: expected placement or start, got both")));
    EXPECT_THAT(errors(R"("start": 7)"), ElementsAre(HasSubstr("expected a string, got 7")));
    put_start(wavy_sheet(4, 3, 0.5, 1e6));
    EXPECT_THAT(errors(R"("start": "shape.npy")"), IsEmpty());
    put_start(wavy_sheet(4, 3, 0.5, 1e8));
    EXPECT_THAT(errors(R"("start": "shape.npy")"), ElementsAre(HasSubstr("thinner than single precision tells")));
}

TEST_F(GivenFiles, AClothMayRestAsItStarts) {
    put_start(wavy_sheet(4, 3, 0.5));
    const SceneResult flat = read(R"("start": "shape.npy", "rest": "flat")");
    ASSERT_TRUE(flat.scene);
    EXPECT_GT(start_strain(flat.scene->cloths[0]), 0.07);
    for (const std::array<double, 4>& ratios : rest_ratios(flat.scene->cloths[0]))
        EXPECT_EQ(ratios, (std::array<double, 4>{1, 1, 1, 1}));
    const SceneResult result = read(R"("start": "shape.npy", "rest": "start", "holes": [[[1, 0], [3, 1]]])");
    ASSERT_TRUE(result.scene) << result.errors[0].text();
    const Cloth& cloth = result.scene->cloths[0];
    EXPECT_EQ(start_strain(cloth), 0);
    EXPECT_NEAR(covering_radius(cloth), (1 + contact_stretch) * covering_radius(flat.scene->cloths[0]), 1e-9)
        << "it may stretch from there, too";
    const std::vector<std::array<double, 4>> ratios = rest_ratios(cloth);
    // Heights are 0, 0.2 and 0.4 m in turn: those of neighbours differ by 0.2 or 0.4, across a cell by 0.4 or 0.
    const double step = std::hypot(0.5, 0.2) / 0.5;
    EXPECT_NEAR(ratios[0][0], step, 1e-6);
    EXPECT_NEAR(ratios[0][1], step, 1e-6);
    EXPECT_NEAR(ratios[0][2], std::hypot(0.5, 0.5, 0.4) / std::hypot(0.5, 0.5), 1e-6);
    EXPECT_NEAR(ratios[1][3], 1, 1e-6);
    EXPECT_EQ(ratios[1][0], 1) << "in a hole";
    EXPECT_NEAR(ratios[5][0], std::hypot(0.5, 0.4) / 0.5, 1e-6) << "along its border";
    EXPECT_EQ(ratios[2][2], 1) << "in a hole";
    EXPECT_EQ(ratios[11][0], 1) << "beyond the grid";
}

TEST_F(GivenFiles, WhatIsWrongWithARestIsSaid) {
    EXPECT_THAT(errors(R"("rest": "start")"),
                ElementsAre(HasSubstr(":2:9: /cloths/0/rest: expected a file start beside rest \"start\", got none")));
    EXPECT_THAT(errors(R"("rest": "curved")"), ElementsAre(HasSubstr("/cloths/0/rest: expected ")));
    put_start_with(6, {5, 1, 0.5});
    EXPECT_THAT(errors(R"("start": "shape.npy")"), IsEmpty());
    EXPECT_THAT(errors(R"("start": "shape.npy", "rest": "start")"),
                ElementsAre(AllOf(HasSubstr(":2:10: /cloths/0/start: expected springs between 0.25 and 4 times"),
                                  HasSubstr("at particle [1, 0] in 'shape.npy'"))));
    put_start(wavy_sheet(4, 3, 0.05));
    EXPECT_THAT(errors(R"("start": "shape.npy", "rest": "start")"),
                ElementsAre(HasSubstr("times at particle [0, 0] in 'shape.npy'")));
}

TEST_F(GivenFiles, VelocitiesAreReadAndWhatIsWrongWithThemIsSaid) {
    std::vector<float> values;
    for (int i = 0; i < 36; ++i) values.push_back(0.25f * static_cast<float>(i));
    write_text(folder_ / "motion.npy", npy_of("<f4", "3, 4, 3", values));
    const SceneResult result = read(R"("velocities": "motion.npy")");
    ASSERT_TRUE(result.scene) << result.errors[0].text();
    EXPECT_EQ(result.files, std::vector<std::string>{"motion.npy"});
    const Cloth& cloth = result.scene->cloths[0];
    ASSERT_EQ(cloth.velocities.size(), 12u);
    EXPECT_EQ(start_velocity(cloth, 5), (Vec3{3.75, 4, 4.25}));
    EXPECT_EQ(start_speed(cloth), length(Vec3{8.25, 8.5, 8.75}));
    EXPECT_THAT(errors(R"("velocity": [0, 0, 1], "velocities": "motion.npy")"),
                ElementsAre(HasSubstr(":2:13: /cloths/0/velocity: expected velocity or velocities, got both")));
    EXPECT_THAT(errors(R"("velocities": "none.npz")"), ElementsAre(HasSubstr("/cloths/0/velocities: cannot read")));
    EXPECT_THAT(errors(R"("velocities": "motion.obj")"),
                ElementsAre(HasSubstr("velocities are read from .npy and .npz")));
    values[20] = std::numeric_limits<float>::infinity();
    write_text(folder_ / "motion.npy", npy_of("<f4", "3, 4, 3", values));
    EXPECT_THAT(errors(R"("velocities": "motion.npy")"),
                ElementsAre(HasSubstr("expected finite velocities, got inf for particle [2, 1] in 'motion.npy'")));
    std::ranges::fill(values, 1000.0f);
    write_text(folder_ / "motion.npy", npy_of("<f4", "3, 4, 3", values));
    EXPECT_THAT(texts(read(R"("velocities": "motion.npy")").warnings),
                ElementsAre(HasSubstr("/cloths/0/velocities: cloth \"cloth\" starts at 1732 m/s")));
}

TEST_F(GivenFiles, AnotherUnitIsWarnedOf) {
    put_start(wavy_sheet(4, 3, 500, 100));
    const SceneResult result = read(R"("start": "shape.npy")");
    ASSERT_TRUE(result.scene);
    EXPECT_THAT(texts(result.warnings),
                ElementsAre(HasSubstr("is 1847 m long: scenes are in metres"),
                            HasSubstr("along the rows are on average 1.14e+03 times as long as at rest"),
                            HasSubstr("along the columns")));
}

TEST_F(GivenFiles, OverlapsAndCrossingsSeeTheShape) {
    put_start_with(5, {0.5, -0.25, 0.5});
    const char* const ground = R"(, "colliders": {"planes": [{}]})";
    EXPECT_THAT(texts(read(R"("start": "shape.npy")", ground).warnings),
                Contains(HasSubstr("/cloths/0/start: cloth \"cloth\" starts up to 0.25 m inside /colliders/planes/0 "
                                   "(1 particle)")));
    EXPECT_THAT(
        texts(read(R"("start": "shape.npy")", R"(, "overlap": "refuse", "colliders": {"planes": [{}]})").errors),
        Contains(HasSubstr("/cloths/0/start: expected a start outside all colliders")));
    // A particle is pulled through the triangles of its neighbours.
    put_start_with(5, {1.3, 1.1, 0.7});
    EXPECT_THAT(texts(read(R"("start": "shape.npy", "self_collision": true)").warnings),
                Contains(HasSubstr("starts through itself: no frame is proved; a shape that does not cross itself")));
    EXPECT_THAT(texts(read(R"("start": "shape.npy", "self_collision": true)", R"(, "overlap": "refuse")").errors),
                Contains(HasSubstr("starts through itself")));
    put_start(wavy_sheet(4, 3, 0.5));
    EXPECT_THAT(read(R"("start": "shape.npy", "self_collision": true)").warnings, IsEmpty());
}

TEST_F(GivenFiles, ShapesThatLieOnEachOtherOrCrossAreFound) {
    const auto found = [&](const Vec3& moved) {
        SceneDescription scene;
        scene.cloths.resize(2);
        for (Cloth& cloth : scene.cloths) {
            cloth.grid = {4, 3};
            cloth.size = {1.5, 1};
            cloth.self_collision.emplace();
            const std::vector<float> values = wavy_sheet(4, 3, 0.5);
            for (std::size_t i = 0; i < 36; i += 3) cloth.start.push_back({values[i], values[i + 1], values[i + 2]});
        }
        for (Vec3& at : scene.cloths[1].start) at = plus(at, moved);
        return start_crossings(scene);
    };
    ASSERT_EQ(found({0, 0, 0}).size(), 1u) << "the same places";
    EXPECT_EQ(found({0, 0, 0})[0].second, 1u);
    EXPECT_THAT(found({0, 0.5, 0}), IsEmpty());
    const std::vector<StartCrossing> crossed = found({0.25, 0.1, 0});
    ASSERT_EQ(crossed.size(), 1u);
    EXPECT_GT(crossed[0].triangles, 0u);
    // 0.4 m is how high the waves are: the second is off the first where its lowest is above the other's highest.
    EXPECT_NEAR(crossed[0].depth * std::abs(crossed[0].way[1]), 0.3, 0.1);
    EXPECT_GT(crossed[0].way[1], 0);
}

TEST_F(GivenFiles, ContactKnowsHowFarAShapeIsStretched) {
    put_start(wavy_sheet(4, 3, 0.5));
    const Cloth flat = read(R"("friction": 0.3)").scene->cloths[0],
                wavy = read(R"("start": "shape.npy")").scene->cloths[0];
    EXPECT_NEAR(start_ratios(wavy, 0).largest, std::hypot(1, 0.8), 1e-6);
    EXPECT_NEAR(start_strain(wavy), std::hypot(1, 0.8) - 1, 1e-6);
    EXPECT_NEAR(covering_radius(wavy) / covering_radius(flat), std::hypot(1, 0.8) / (1 + contact_stretch), 1e-6);
}

TEST_F(GivenFiles, HolesFromAPictureAreTheDarkCells) {
    write_text(folder_ / "map.png", grey_png(3, {0, 0, 255, 0, 0, 127}));
    const Cloth cloth = read(R"("maps": {"holes": "map.png"})").scene->cloths[0];
    EXPECT_EQ(missing_cells(cloth), (std::vector<bool>{true, true, false, true, true, true}));
    write_text(folder_ / "map.png", grey_png(1, {0, 255}));  // sampled: the upper row is dark, the lower light
    EXPECT_EQ(missing_cells(read(R"("maps": {"holes": "map.png"})").scene->cloths[0]),
              (std::vector<bool>{true, true, true, false, false, false}));
    write_text(folder_ / "map.png", grey_png(1, {0}));
    EXPECT_THAT(errors(R"("maps": {"holes": "map.png"})"),
                ElementsAre(HasSubstr("/cloths/0/maps: expected holes that leave a cell of the cloth, got none left")));
}

TEST_F(GivenFiles, EveryPatternOfHolesBecomesItsBoxes) {
    for (std::uint32_t pattern = 0; pattern < 63; ++pattern) {
        std::vector<std::uint8_t> pixels;
        std::vector<bool> missing;
        for (int cell = 0; cell < 6; ++cell) {
            missing.push_back((pattern >> cell & 1) != 0);
            pixels.push_back(missing.back() ? 10 : 200);
        }
        write_text(folder_ / "map.png", grey_png(3, pixels));
        EXPECT_EQ(missing_cells(read(R"("maps": {"holes": "map.png"})").scene->cloths[0]), missing) << pattern;
    }
}

TEST_F(GivenFiles, FactorsAreThoseOfTheRange) {
    write_text(folder_ / "map.npy", npy_of("<f8", "2, 3", std::vector<double>{0, 0.5, 1, 1, 1, 1}));
    const Cloth cloth = read(R"("stiffness": {"stretch": 500, "shear": 40, "bend": 1e-3}, "areal_density": 0.2,
                "maps": {"stiffness": "map.npy", "stiffness_range": [0.5, 4], "density": "map.npy"})")
                            .scene->cloths[0];
    EXPECT_EQ(cloth.stiffness, (Stiffness{false, 2000, 160, 4e-3}));
    EXPECT_EQ(cloth.cell_stiffness, (std::vector<float>{0.125f, 0.5625f, 1, 1, 1, 1}));
    EXPECT_DOUBLE_EQ(cloth.areal_density, 0.02);
    EXPECT_EQ(cloth.cell_density, (std::vector<float>{1, 5.5f, 10, 10, 10, 10}));
}

TEST_F(GivenFiles, ASeamBearsItsShare) {
    write_text(folder_ / "map.npy", npy_of("<f8", "2, 3", std::vector<double>{1, 0.5, 1, 1, 0, 1}));
    const SceneResult result = read(R"("tear": {"strain": 0.5}, "maps": {"tear": "map.npy"})");
    EXPECT_EQ(result.scene->cloths[0].cell_tear, (std::vector<float>{1, 0.55f, 1, 1, 0.1f, 1}));
    ASSERT_EQ(result.warnings.size(), 1u) << "single springs may err by 0.1";
    EXPECT_THAT(result.warnings[0].text(), HasSubstr("/cloths/0/tear: the cloth tears at a strain of 0.05"));
    EXPECT_THAT(errors(R"("tear": {"strain": 0.05}, "maps": {"tear": "map.npy"})"),
                ElementsAre(HasSubstr("/cloths/0/tear: expected a limit above the stretch error")));
    EXPECT_THAT(errors(R"("tear": {"strain": 0.5}, "maps": {"tear": "map.npy", "tear_range": [0, 1]})"),
                ElementsAre(HasSubstr("/tear_range/0: expected a number in [0.001, 1000], got 0")));
}

/// The fixture's cloth has 4 x 3 particles.
TEST_F(GivenFiles, FrictionAndThicknessAreOfParticles) {
    const std::vector<double> values{0, 0.5, 1, 1, 0, 0.5, 1, 1, 0, 0.5, 1, 0.25};
    write_text(folder_ / "map.npy", npy_of("<f8", "3, 4", values));
    write_text(folder_ / "map.png", grey_png(1, {0, 255}));
    const Cloth cloth = read(R"("friction": 0.4, "thickness": 0.01, "self_collision": {"thickness": 0.05},
                "maps": {"friction": "map.npy", "friction_range": [0, 3],
                         "thickness": "map.npy", "thickness_range": [2, 0.5]})")
                            .scene->cloths[0];
    EXPECT_EQ(cloth.friction, 0.4);
    EXPECT_EQ(cloth.particle_friction, (std::vector<float>{0, 1.5f, 3, 3, 0, 1.5f, 3, 3, 0, 1.5f, 3, 0.75f}));
    EXPECT_EQ(cloth.thickness, 0.02) << "the thickest particle's";
    EXPECT_EQ(cloth.self_collision->thickness, 0.1);
    EXPECT_EQ(cloth.particle_thickness,
              (std::vector<float>{1, 0.625f, 0.25f, 0.25f, 1, 0.625f, 0.25f, 0.25f, 1, 0.625f, 0.25f, 0.8125f}));
    EXPECT_EQ(least_thickness(cloth), 0.005);
    // A picture of another size spans the cloth: its upper half is dark.
    EXPECT_EQ(read(R"("maps": {"friction": "map.png", "friction_range": [0, 1]})").scene->cloths[0].particle_friction,
              (std::vector<float>{0, 0, 0, 0, 0.5f, 0.5f, 0.5f, 0.5f, 1, 1, 1, 1}));
}

TEST_F(GivenFiles, WhatIsWrongWithAMapOfParticlesIsSaidWhereItIsNamed) {
    EXPECT_THAT(errors(R"("maps": {"friction": "none.png", "thickness": "x.gif"})"),
                ElementsAre(AllOf(HasSubstr(":2:22: /cloths/0/maps/friction: cannot read"), HasSubstr("No such file")),
                            HasSubstr("/cloths/0/maps/thickness: cannot read")));
    for (const double value : {-0.25, 1.25, std::nan("")}) {
        write_text(folder_ / "map.npy", npy_of("<f8", "1, 1", std::vector<double>{value}));
        for (const std::string key : {"friction", "thickness"})
            EXPECT_THAT(errors(R"("maps": {")" + key + R"(": "map.npy"})"),
                        ElementsAre(HasSubstr("/cloths/0/maps/" + key + ": ")))
                << value;
    }
    write_text(folder_ / "map.npy", npy_of("<f8", "1, 1, 1", std::vector<double>{1}));
    EXPECT_THAT(errors(R"("maps": {"thickness": "map.npy"})"),
                ElementsAre(HasSubstr("/cloths/0/maps/thickness: cannot read")));
    write_text(folder_ / "map.png", grey_png(1, {9}));
    EXPECT_THAT(errors(R"("maps": {"thickness": "map.png", "thickness_range": [0, 1]})"),
                ElementsAre(HasSubstr("/thickness_range/0: expected a number in [0.001, 1000], got 0")));
    EXPECT_THAT(errors(R"("maps": {"thickness_range": [1, 2]})"),
                ElementsAre(HasSubstr("/maps/thickness_range: expected a map of thickness")));
    EXPECT_THAT(errors(R"("maps": {"friction": "map.png", "friction_range": [0, -1]})"),
                ElementsAre(HasSubstr("/friction_range/1: expected a number in [0, 1000], got -1")));
    EXPECT_THAT(errors(R"("self_collision": {"thickness": 9}, "maps": {"thickness": "map.png"})"),
                ElementsAre(HasSubstr("/self_collision/thickness: expected")));
}

TEST_F(GivenFiles, WhatIsWrongWithAMapIsSaidWhereItIsNamed) {
    EXPECT_THAT(errors(R"("maps": {"holes": "none.png", "density": "x.gif"})"),
                ElementsAre(AllOf(HasSubstr(":2:19: /cloths/0/maps/holes: cannot read"), HasSubstr("No such file")),
                            HasSubstr("/cloths/0/maps/density: cannot read")));
    write_text(folder_ / "map.png", grey_png(1, {9}));
    EXPECT_THAT(
        errors(R"("maps": {"stiffness": "map.png"}, "stiffness": "rigid")"),
        ElementsAre(HasSubstr("/cloths/0/maps/stiffness: expected springs with a stiffness, got stiffness \"rigid\"")));
    EXPECT_THAT(errors(R"("maps": {"density": "map.png", "density_range": [0, 1]})"),
                ElementsAre(HasSubstr("/density_range/0: expected a number in [0.001, 1000], got 0")));
    EXPECT_THAT(errors(R"("maps": {"hole": "map.png"})"), ElementsAre(HasSubstr("expected \"holes\"")));
}

}  // namespace
}  // namespace drape::testing
