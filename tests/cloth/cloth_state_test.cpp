// The table of a cloth's fields has the order, names, formats and sizes that every loop over it relies on.
#include "cloth/cloth_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/sheets.h"

namespace drape {
namespace {

/// Asks for as many fields as one scene can: holes, pins of all sorts, tethers, wind, a tolerance, cutters, tearing.
SceneDescription demanding(SolverMethod method) {
    SceneDescription scene = test::sheet(9, 7, 1, 1, 4, 3);
    scene.solver.method = method;
    scene.solver.tolerance = 0.01;
    scene.solver.tethers = true;
    scene.wind.velocity = {1, 0, 0};
    scene.cutters.emplace_back();
    Cloth& cloth = scene.cloths[0];
    cloth.stiffness = {false, 800, 60, 0.01};
    cloth.tear = Tear{.strain = {}, .tension = 200};
    cloth.holes = {{{3, 3}, {5, 5}}};
    Pin released = test::pin_box(0, 0, 0, 0);
    released.release = 0.5;
    cloth.pins = {released, test::pin_box(8, 0, 8, 0)};
    return scene;
}

TEST(ClothState, LineScratchOfTheLargestSheetFitsAnImage) {
    EXPECT_LE(line_scratch_extent(Grid(4096, 4096)).height, 16384u);
    EXPECT_EQ(line_scratch_extent(Grid(32, 32)).height, 1u);
}

TEST(ClothState, RowsStandInTheOrderOfTheirFieldsUnderNamesOfTheirOwn) {
    std::set<std::string_view> names;
    ASSERT_EQ(cloth_fields().size(), field_count);
    for (std::size_t i = 0; i < field_count; ++i) {
        const FieldRow& row = cloth_fields()[i];
        EXPECT_EQ(static_cast<std::size_t>(row.field), i) << row.name;
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
    }
    for (std::size_t direction = 0; direction < spring_directions.size(); ++direction)
        EXPECT_EQ(row_of(tension_of(direction)).name, "tension " + std::string(spring_directions[direction].name));
}

TEST(ClothState, ImagesHoldTexelsThatThereAreFormatsFor) {
    const glsl::StructLayout* const texels[] = {&glsl::layout_of<glsl::vec4>(), &glsl::layout_of<float>(),
                                                &glsl::layout_of<glsl::uint>()};
    for (const FieldRow& row : cloth_fields()) {
        if (!row.is_image()) continue;
        EXPECT_EQ(std::ranges::count(texels, &row.element), 1) << row.name;
    }
}

TEST(ClothState, WhatAFieldStartsWithFillsAnImageAndFitsABuffer) {
    for (const SolverMethod method : {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line}) {
        const SimulationModel model(demanding(method));
        const CutTopology topology(model.cloths[0]);
        const FieldContext about{model, model.cloths[0], topology, {.drawing = true, .statistics = true}};
        for (const FieldRow& row : cloth_fields()) {
            if (!row.needed(about)) continue;
            const std::uint64_t room = row.extent(about).count() * row.element.size;
            EXPECT_GT(room, 0u) << row.name;
            if (!row.start) continue;
            const std::size_t size = row.start(about).size();
            EXPECT_TRUE(row.is_image() ? size == room : size > 0 && size <= room) << row.name;
        }
    }
}

TEST(ClothState, AFieldIsThereOnlyWhereItIsNeeded) {
    SceneDescription scene = test::sheet(9, 7, 1, 1, 4, 1);
    scene.cloths[0].stiffness = {true, 0, 0, 0};
    const SimulationModel model(scene);
    const CutTopology topology(model.cloths[0]);
    std::vector<Field> needed;
    for (const FieldRow& row : cloth_fields())
        if (row.needed({model, model.cloths[0], topology})) needed.push_back(row.field);
    // Only some kinds of steps use the spare; without them the graph leaves it out. Nothing holds the sheet, so its
    // turn is kept, by the last three.
    EXPECT_EQ(needed, (std::vector{Field::position, Field::displacement, Field::position_remainder,
                                   Field::displacement_remainder, Field::displacement_spare, Field::displacement_before,
                                   Field::torques, Field::angular_error}));
}

}  // namespace
}  // namespace drape
