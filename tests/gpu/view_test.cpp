// Pictures show data: the strains read off a heat map are the statistics', the legend is the map's, normals are the
// cloth's. The colour map turns a heat map's colours back into strains, as a person does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>

#include "drape/simulation.h"
#include "library_device.h"
#include "picture/legend.h"

namespace drape {
namespace {

using test::library_device;
constexpr std::uint32_t width = 320, height = 240;

using ViewTest = test::LibraryTest;

using Color = std::array<int, 3>;

struct Picture {
    std::vector<std::uint8_t> rgba;
    Color at(std::uint32_t x, std::uint32_t y) const {
        const std::size_t first = 4 * (std::size_t{y} * width + x);
        return {rgba[first], rgba[first + 1], rgba[first + 2]};
    }
};

struct Shown {
    Picture picture;
    ClothStatistics statistics;
};

/// A square metre faces the camera and fills most of the picture, `scale` times its rest size.
SceneDescription sheet(std::array<double, 2> scale) {
    SceneDescription scene;
    scene.time.frame_count = 2;
    scene.gravity = {0, 0, 0};
    scene.image.size = {width, height};
    scene.image.samples = 4;
    scene.camera = Camera{{0, 0, 3}, {0, 0, 0}, 25};
    Cloth cloth;
    cloth.name = "sheet";
    cloth.grid = {9, 7};
    cloth.placement = {{-0.5, 0.5, 0}, {1, 0, 0}, {0, -1, 0}, scale};
    scene.cloths = {cloth};
    scene.solver = {.method = SolverMethod::relax, .substeps = 4};
    return scene;
}

/// Draws one frame, the first unless another is asked for.
Shown shown(const SceneDescription& scene, const PictureView& view, std::uint32_t frame = 0) {
    SimulationOptions options;
    options.draw = true;
    options.view = view;
    options.keep_promises = false;
    Simulation simulation(scene, options, library_device());
    for (std::uint32_t i = 0; i <= frame; ++i) EXPECT_TRUE(simulation.step());
    const FinishedFrame& last = simulation.frame();
    return {{{last.rgba.begin(), last.rgba.end()}}, last.statistics[0]};
}

double distance(const Color& pixel, const std::array<double, 3>& color) {
    double squares = 0;
    for (std::size_t i = 0; i < 3; ++i) squares += (pixel[i] - color[i]) * (pixel[i] - color[i]);
    return std::sqrt(squares);
}

/// Returns the place of the map whose colour is nearest, and how near it is.
std::pair<double, double> place_of(const ColorMap& map, const Color& pixel) {
    static std::map<const ColorMap*, std::vector<std::array<double, 3>>> tables;
    std::vector<std::array<double, 3>>& table = tables[&map];
    for (int i = static_cast<int>(table.size()); i <= 500; ++i) table.push_back(color_at(map, i / 500.0));
    std::pair<double, double> best{0, 1e9};
    for (std::size_t i = 0; i < table.size(); ++i)
        if (const double away = distance(pixel, table[i]); away < best.second)
            best = {static_cast<double>(i) / 500, away};
    return best;
}

double strain_of(const StrainScale& scale, const Color& pixel) {
    const auto [place, away] = place_of(*scale.map, pixel);
    EXPECT_LT(away, 3) << "no colour of the map";
    return scale.low + place * (scale.high - scale.low);
}

struct Strained {
    const char* name;
    View kind;
    std::array<double, 2> scale;
    double range, expected;
};

class UniformStrain : public ViewTest, public testing::WithParamInterface<Strained> {};

TEST_P(UniformStrain, IsReadOffThePicture) {
    const auto& [name, kind, size, range, expected] = GetParam();
    const SceneDescription scene = sheet(size);
    const PictureView view{kind, range};
    const StrainScale scale = strain_scale(view, scene).value();
    EXPECT_EQ(scale.high, range);
    const Shown seen = shown(scene, view);
    for (const auto& [x, y] : {std::pair{160u, 120u}, {200u, 80u}, {130u, 160u}})
        EXPECT_NEAR(strain_of(scale, seen.picture.at(x, y)), expected, 0.015 * (scale.high - scale.low));
    const StrainStatistics& stretch = seen.statistics.stretch;
    if (expected != 0) {
        EXPECT_NEAR(expected > 0 ? stretch.largest : stretch.smallest, expected, 1e-6);
    }
}

const Strained strained[] = {
    {"StretchShowsTheMostStretched", View::stretch, {1.03, 0.98}, 0.05, 0.03},
    {"StretchAlongRowsToo", View::stretch, {0.99, 1.02}, 0.05, 0.02},
    {"WarpIsAlongU", View::warp, {1.03, 0.98}, 0.05, 0.03},
    {"WeftIsAlongV", View::weft, {1.03, 0.98}, 0.05, -0.02},
    {"BeyondTheRangeIsTheEnd", View::stretch, {1.2, 1}, 0.2, 0.2},
};
INSTANTIATE_TEST_SUITE_P(Every, UniformStrain, testing::ValuesIn(strained),
                         [](const auto& test) { return std::string(test.param.name); });

/// Returns the largest strain of all pixels right of the legend that have a colour of the map.
double largest_strain_in(const Picture& picture, const StrainScale& scale) {
    double largest = scale.low;
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = width / 4; x < width; ++x)
            if (const auto [place, away] = place_of(*scale.map, picture.at(x, y)); away < 3)
                largest = std::max(largest, scale.low + place * (scale.high - scale.low));
    return largest;
}

TEST_F(ViewTest, LargestStrainOfAMovingClothIsTheStatisticsOwn) {
    SceneDescription scene = sheet({1, 1});
    scene.cloths[0].pins.push_back({.particles = {{0, 0}, {8, 0}}, .release = {}, .path = {}, .pivot = {}});
    scene.cloths[0].stiffness.stretch = 100;
    scene.time.frame_count = 40;
    scene.gravity = {0, -9.81, 0};
    scene.image.background = {0, 0, 0};
    const PictureView view{View::stretch, 0.01};
    const Shown seen = shown(scene, view, 8);
    ASSERT_GT(seen.statistics.stretch.largest, 0.004);
    EXPECT_NEAR(largest_strain_in(seen.picture, strain_scale(view, scene).value()), seen.statistics.stretch.largest,
                0.03 * view.range);
}

TEST_F(ViewTest, CutSpringsAreNotStrained) {
    SceneDescription scene = sheet({1, 1});
    scene.image.background = {0, 0, 0};
    scene.time.frame_count = 12;
    // A blade goes through the whole sheet between two columns, then both halves are drawn apart.
    scene.cutters.push_back({{{{0.03, 3, -3}, {0.03, 3, 3}, {0.03, -9, 0}}}, 0, 0.02, {}});
    for (const std::uint32_t column : {0u, 8u}) {
        MotionPath away;
        away.keys = {{0.03, {0, 0, 0}, {}}, {0.2, {column == 0 ? -0.05 : 0.05, 0, 0}, {}}};
        scene.cloths[0].pins.push_back(
            {.particles = {{column, 0}, {column, 6}}, .release = {}, .path = away, .pivot = {}});
    }
    const PictureView view{View::stretch, 0.5};
    const Shown seen = shown(scene, view, 11);
    // A gap of 5 cm on a cell of 12.5 cm would be 40 %.
    EXPECT_LT(seen.statistics.stretch.largest, 0.3);
    EXPECT_LT(largest_strain_in(seen.picture, strain_scale(view, scene).value()),
              seen.statistics.stretch.largest + 0.03 * view.range);
}

TEST_F(ViewTest, ClothWithAHoleIsDrawn) {
    SceneDescription scene = sheet({1.03, 1.03});
    scene.cloths[0].holes = {{{3, 2}, {5, 4}}};
    const PictureView view{View::stretch, 0.05};
    EXPECT_NEAR(largest_strain_in(shown(scene, view).picture, strain_scale(view, scene).value()), 0.03, 0.001);
}

TEST_F(ViewTest, LegendIsTheMapWithTheEndsOfTheScale) {
    const SceneDescription scene = sheet({1, 1});
    for (const View kind : {View::stretch, View::weft}) {
        const StrainScale scale = strain_scale({kind, 0.02}, scene).value();
        const Picture picture = shown(scene, {kind, 0.02}).picture;
        const LegendBar bar = legend_bar(width, height);
        for (std::uint32_t row = 0; row < bar.height; ++row) {
            const double place = 1 - static_cast<double>(row) / (bar.height - 1);
            EXPECT_LT(distance(picture.at(bar.x + bar.width / 2, bar.y + row), color_at(*scale.map, place)), 2);
        }
        // The sheet is not strained, so another range changes nothing but the numbers.
        const Picture other = shown(scene, {kind, 0.05}).picture;
        std::size_t different = 0;
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x) {
                if (picture.at(x, y) == other.at(x, y)) continue;
                ++different;
                EXPECT_LT(x, width / 4);
                EXPECT_LE(y, bar.y + bar.height + 8);
            }
        EXPECT_GT(different, 10u);
    }
    EXPECT_EQ(percent_text(0.025), "2.5%");
    EXPECT_EQ(percent_text(-0.001), "-0.1%");
}

TEST_F(ViewTest, NormalsAreColors) {
    SceneDescription scene = sheet({1, 1});
    const double c = std::cos(0.5), s = std::sin(0.5);
    scene.cloths[0].placement = {{-0.5 * c, 0.5, 0.5 * s}, {c, 0, -s}, {0, -1, 0}, {1, 1}};
    const Color pixel = shown(scene, {View::normals, 0}).picture.at(160, 120);
    // The normal points towards the camera: cross(along rows, along columns) or its opposite.
    const double expected[] = {0.5 + 0.5 * s, 0.5, 0.5 + 0.5 * c};
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(pixel[i], 255 * expected[i], 1.5);
}

TEST_F(ViewTest, WireHasALinePerEdge) {
    const SceneDescription scene = sheet({1, 1});
    const Picture picture = shown(scene, {View::wire, 0}).picture;
    // A row of pixels through cells meets sides of columns and diagonals, two lines per cell.
    int lines = 0;
    bool dark = false;
    const std::uint32_t y = 125;
    for (std::uint32_t x = 76; x < 244; ++x) {
        const bool now = picture.at(x, y)[1] < 165;
        lines += now && !dark;
        dark = now;
    }
    EXPECT_GE(lines, 12);
    EXPECT_LE(lines, 17);
}

TEST_F(ViewTest, OnlyAHeatMapHasItsColors) {
    const SceneDescription scene = sheet({1, 1});
    for (const auto& [name, kind] : view_spellings) {
        SimulationOptions options;
        options.draw = true;
        options.view.kind = kind;
        const std::string plan = Simulation(scene, options, library_device()).describe_plan("json");
        const bool heat = kind == View::stretch || kind == View::warp || kind == View::weft;
        EXPECT_EQ(plan.find("heat colors") != std::string::npos, heat) << name;
    }
}

TEST(StrainRange, FollowsFromWeightWindAndStiffness) {
    SceneDescription scene = sheet({1, 1});
    scene.gravity = {0, -10, 0};
    scene.cloths[0].areal_density = 0.2;
    scene.cloths[0].stiffness.stretch = 1000;  // 2 N/m on the edge: 0.2 %, 100 times of it 20 %
    EXPECT_DOUBLE_EQ(default_strain_range(scene), 0.2);
    scene.wind.velocity = {10, 0, 0};  // 60 Pa: 6 %, five times of it 30 %
    EXPECT_DOUBLE_EQ(default_strain_range(scene), 0.5);
    scene.wind.velocity = {0, 0, 0};
    scene.cloths[0].stiffness.rigid = true;
    EXPECT_DOUBLE_EQ(default_strain_range(scene), 0.005);
}

TEST_F(ViewTest, TheDefaultScaleIsLogarithmic) {
    for (const View kind : {View::stretch, View::warp}) {
        const SceneDescription scene = sheet({1.004, 0.99});
        const StrainScale scale = strain_scale({kind, 0}, scene).value();
        const double low = kind == View::stretch ? 0 : 0.5;
        EXPECT_DOUBLE_EQ(scale.place_of(0), low);
        EXPECT_DOUBLE_EQ(scale.place_of(scale.high), 1);
        // ln(1 + 1000 s / r) / ln 1001
        const double share = std::log(1 + 1000 * 0.004 / scale.high) / std::log(1001);
        EXPECT_DOUBLE_EQ(scale.place_of(0.004), low + (1 - low) * share);
        const auto [place, away] = place_of(*scale.map, shown(scene, {kind, 0}).picture.at(160, 120));
        EXPECT_LT(away, 3);
        EXPECT_NEAR(place, scale.place_of(0.004), 0.01);
    }
}

}  // namespace
}  // namespace drape
