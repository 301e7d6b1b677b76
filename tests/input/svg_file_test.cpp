// Shapes of an SVG file become curves in metres, wherever groups and transforms put them.
#include "input/svg_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "base/output_error.h"

namespace drape::input {
namespace {

using ::testing::HasSubstr;

class SvgFileTest : public ::testing::Test {
  protected:
    ~SvgFileTest() override { std::filesystem::remove(path_); }
    std::filesystem::path file(const std::string& shapes, const std::string& attributes = "") {
        return text("<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" " + attributes + ">" + shapes +
                    "</svg>");
    }
    std::filesystem::path text(const std::string& all) {
        std::ofstream(path_) << all;
        return path_;
    }
    std::vector<PathCurve> metres(const std::string& shapes, const std::string& element = "") {
        return read_svg(file(shapes), {element, 1.0, 1e-4});
    }
    std::string error_of(const std::filesystem::path& path, const std::string& element = "") {
        try {
            read_svg(path, {element, 1.0, 1e-4});
        } catch (const std::exception& error) {
            return error.what();
        }
        return "none";
    }

  private:
    std::filesystem::path path_ =
        std::filesystem::temp_directory_path() / ("drape_svg_" + std::to_string(::getpid()) + ".svg");
};

double covered(const PathCurve& curve) {
    double sum = 0;
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
        const auto &a = curve.points[i], &b = curve.points[(i + 1) % curve.points.size()];
        sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    return std::abs(sum);
}

std::array<double, 2> middle(const PathCurve& curve) {
    std::array<double, 2> low = curve.points[0], high = low;
    for (const auto& at : curve.points)
        for (std::size_t k = 0; k < 2; ++k) low[k] = std::min(low[k], at[k]), high[k] = std::max(high[k], at[k]);
    return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2};
}

TEST_F(SvgFileTest, EveryShapeHasItsArea) {
    using std::numbers::pi;
    const struct {
        const char* shape;
        double area;
    } shapes[] = {
        {R"x(<path d="M0 0H2V1H0Z"/>)x", 2},
        {R"x(<rect x="1" y="1" width="2" height="3"/>)x", 6},
        {R"x(<rect width="2" height="3" rx=".5"/>)x", 6 - (4 - pi) * 0.25},
        {R"x(<rect width="2" height="3" rx=".5" ry="9"/>)x", 6 - (4 - pi) * 0.75},
        {R"x(<circle cx="1" cy="2" r="2"/>)x", 4 * pi},
        {R"x(<ellipse rx="2" ry="1"/>)x", 2 * pi},
        {R"x(<polygon points="0,0 2,0 0,2"/>)x", 2},
        {R"x(<polyline points="0 0 2 0 2 2 0 2"/>)x", 4},
        {R"x(<rect width="1" height="1" transform="scale(2 3)"/>)x", 6},
        {R"x(<rect width="1" height="1" transform="rotate(20 3 4) skewX(30)"/>)x", 1},
        {R"x(<g transform="scale(2)"><g><rect width="1" height="1" transform="matrix(1 2 0 1 5 5)"/></g></g>)x", 4},
    };
    for (const auto& [shape, wanted] : shapes) {
        const std::vector<PathCurve> curves = metres(shape);
        ASSERT_EQ(curves.size(), 1u) << shape;
        EXPECT_NEAR(covered(curves[0]), wanted, 2e-3 * wanted) << shape;
    }
}

TEST_F(SvgFileTest, TheInnermostTransformIsDoneFirst) {
    const auto at = [&](const std::string& shape) { return middle(metres(shape).at(0)); };
    const std::string square = R"x(<rect x="-1" y="-1" width="2" height="2" )x";
    EXPECT_THAT(at(square + R"x(transform="translate(5,1) scale(3)"/>)x"), ::testing::ElementsAre(5, 1));
    EXPECT_THAT(at(square + R"x(transform="scale(3) translate(5 1)"/>)x"), ::testing::ElementsAre(15, 3));
    EXPECT_THAT(at("<g transform='translate(1)'>" + square + "transform='translate(2 7)'/></g>"),
                ::testing::ElementsAre(3, 7));
    const auto turned = at(R"x(<rect x="2" y="-1" width="2" height="2" transform="rotate(90)"/>)x");
    EXPECT_NEAR(turned[0], 0, 1e-12);
    EXPECT_NEAR(turned[1], 3, 1e-12) << "to the right becomes down";
}

TEST_F(SvgFileTest, AUnitIsAsLargeAsTheDrawingSays) {
    const auto width = [&](const std::string& attributes) {
        return std::sqrt(covered(read_svg(file(R"x(<rect width="10" height="10"/>)x", attributes), {}).at(0)));
    };
    EXPECT_NEAR(width(R"x(width="200mm" viewBox="0 0 100 50")x"), 0.02, 1e-12);
    EXPECT_NEAR(width(R"x(height="1in" viewBox="0,0,100,50")x"), 10 * 0.0254 / 50, 1e-12);
    EXPECT_NEAR(width(R"x(width="100%" viewBox="0 0 100 50")x"), 10 * 0.0254 / 96, 1e-12);
    EXPECT_NEAR(width(R"x(width="20cm")x"), 10 * 0.0254 / 96, 1e-12) << "without a viewBox units are pixels";
}

TEST_F(SvgFileTest, WhatIsOnlyDefinedDoesNotCountUnlessItIsNamed) {
    const std::string shapes = R"x(<defs><circle id="c" r="1"/></defs><g id="g"><rect width="2" height="2"/><rect
        id="r" width="1" height="1"/></g>)x";
    EXPECT_EQ(metres(shapes).size(), 2u);
    EXPECT_EQ(metres(shapes, "g").size(), 2u);
    EXPECT_NEAR(covered(metres(shapes, "r").at(0)), 1, 1e-12);
    EXPECT_NEAR(covered(metres(shapes, "c").at(0)), std::numbers::pi, 1e-3);
    EXPECT_THAT(error_of(file(shapes), "h"), HasSubstr("an element with the id \"h\""));
}

TEST_F(SvgFileTest, WhatIsWrongIsSaid) {
    EXPECT_THAT(error_of(file(R"x(<path id="p" d="M0 0L1 x"/>)x")), HasSubstr("a number at character 8 of the path in "
                                                                              "element <path id=\"p\"> of the file"));
    EXPECT_THAT(error_of(file(R"x(<rect width="1mm" height="1"/>)x")), HasSubstr("a number width without a unit"));
    EXPECT_THAT(error_of(file(R"x(<rect width="1" height="1" transform="turn(3)"/>)x")), HasSubstr("rotate, skewX"));
    EXPECT_THAT(error_of(file(R"x(<rect width="1" height="1" transform="scale(0)"/>)x")), HasSubstr("its size"));
    EXPECT_THAT(error_of(file("<text>a</text>")), HasSubstr("that goes around something"));
    EXPECT_THAT(error_of(text("<html/>")), HasSubstr("whose first element is svg"));
    EXPECT_THAT(error_of(text("<svg><path</svg>")), HasSubstr("at byte"));
    EXPECT_THAT(error_of("/nowhere/at/all.svg"), HasSubstr("all.svg"));
    std::string deep = "<rect width='1' height='1'/>";
    for (int k = 0; k < 300; ++k) deep = "<g>" + deep + "</g>";
    EXPECT_THAT(error_of(file(deep)), HasSubstr("at most 256 groups"));
}

}  // namespace
}  // namespace drape::input
