// Where two boxes meet (shaders/include/body_boxes.h), against a polygon that is cut in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "base/vectors.h"
#include "twin/kernels.h"

namespace drape {
namespace {

using glsl::FaceCorner;
using glsl::FacingFace;
using Point = std::array<double, 2>;
using Polygon = std::vector<Point>;

double across(const Point& o, const Point& a, const Point& b) {
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

double area_of(const Polygon& polygon) {
    double sum = 0;
    for (std::size_t k = 2; k < polygon.size(); ++k) sum += across(polygon[0], polygon[k - 1], polygon[k]);
    return std::abs(0.5 * sum);
}

/// Returns the area of the convex hull of some points (Andrew's chain).
double hull_area(Polygon points) {
    std::ranges::sort(points);
    Polygon hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t first = hull.size();
        for (const Point& p : points) {
            while (hull.size() >= first + 2 && across(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
            hull.push_back(p);
        }
        if (!hull.empty()) hull.pop_back();
        std::ranges::reverse(points);
    }
    return area_of(hull);
}

/// Returns the part of a polygon with sign times its coordinate at most limit (Sutherland and Hodgman 1974).
Polygon cut(const Polygon& whole, std::size_t axis, double sign, double limit) {
    Polygon part;
    for (std::size_t k = 0; k < whole.size(); ++k) {
        const Point &from = whole[k], &to = whole[(k + 1) % whole.size()];
        const double a = sign * from[axis] - limit, b = sign * to[axis] - limit;
        if (a <= 0) part.push_back(from);
        if ((a <= 0) != (b <= 0)) {
            const double share = a / (a - b);
            part.push_back({from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])});
        }
    }
    return part;
}

double shared_area(const FacingFace& face) {
    Polygon all;
    for (const Point& sign : {Point{-1, -1}, Point{1, -1}, Point{1, 1}, Point{-1, 1}})
        all.push_back({double{face.middle.x} + sign[0] * double{face.u.x} + sign[1] * double{face.v.x},
                       double{face.middle.y} + sign[0] * double{face.u.y} + sign[1] * double{face.v.y}});
    for (const double sign : {1.0, -1.0}) all = cut(cut(all, 0, sign, double{face.wide}), 1, sign, double{face.deep});
    return area_of(all);
}

Polygon corners_of(const FacingFace& face) {
    Polygon all;
    for (int k = 0; k < glsl::face_corner_count; ++k)
        if (const FaceCorner corner = glsl::face_corner(face, k); corner.is_one) {
            all.push_back({double{corner.place.x}, double{corner.place.y}});
            const double margin = 1 + 1.01e-4;
            EXPECT_LE(std::abs(corner.place.x), face.wide * margin) << k;
            EXPECT_LE(std::abs(corner.place.y), face.deep * margin) << k;
        }
    return all;
}

/// A face that another sees from above, turned about its normal and tilted.
FacingFace facing(double x, double y, double turn, double tilt, double u, double v, double wide, double deep) {
    const double c = std::cos(turn), s = std::sin(turn), t = std::cos(tilt);
    const auto f = [](double value) { return static_cast<float>(value); };
    return {{f(x), f(y), 0.1f},
            {f(u * c), f(u * s * t), f(u * s * std::sin(tilt))},
            {f(-v * s), f(v * c * t), f(v * c * std::sin(tilt))},
            f(wide),
            f(deep)};
}

TEST(BodyBoxes, CornersOfTwoFacesAreThoseOfACutPolygon) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(-1, 1);
    const auto size = [&] { return std::pow(10, share(random)); };
    int overlaps = 0;
    for (int k = 0; k < 20000; ++k) {
        const double wide = size(), deep = size(), u = size(), v = size();
        const FacingFace face = facing(share(random) * (wide + u), share(random) * (deep + v), 3 * share(random),
                                       0.9 * share(random), u, v, wide, deep);
        const Polygon corners = corners_of(face);
        ASSERT_LE(corners.size(), static_cast<std::size_t>(glsl::pair_meetings)) << k;
        const double least = std::min(wide * deep, u * v);
        EXPECT_NEAR(hull_area(corners), shared_area(face), 1e-3 * least) << k;
        overlaps += shared_area(face) > 0 ? 1 : 0;
    }
    EXPECT_GT(overlaps, 5000);
}

/// Faces that fall together, or nearly, where rounding decides what is inside.
TEST(BodyBoxes, CornersOfAlikeFacesAreFour) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> share(-1, 1);
    for (int k = 0; k < 2000; ++k) {
        const double little = 1e-7 * share(random), quarter = 0.5 * std::acos(-1.0) * (k % 4);
        const FacingFace face =
            facing(little, 1e-7 * share(random), quarter + 1e-7 * share(random), 1e-7, 0.05, 0.05, 0.05, 0.05);
        const Polygon corners = corners_of(face);
        EXPECT_EQ(corners.size(), 4u) << k;
        EXPECT_NEAR(hull_area(corners), 0.01, 1e-6) << k;
    }
}

}  // namespace
}  // namespace drape
