// The crossing predicate in single precision agrees with double precision on random pairs and degenerate cases.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "twin/kernels.h"
#include "world/surface_distance.h"

namespace drape {
namespace {

Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The decision on the segment p q against triangle t in double precision, and its smallest distance to a threshold,
/// relative to the longest edge.
struct Decision {
    bool hit;
    double margin;
};

Decision crosses(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
    const Vec3 normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    const double size = length(normal);
    if (size == 0) return {false, 0};
    const double hp = dot(normal, minus(p, t[0])) / size, hq = dot(normal, minus(q, t[0])) / size;
    double margin = std::min(std::abs(hp), std::abs(hq));
    if ((hp < 0) == (hq < 0)) return {false, margin};
    const Vec3 along = minus(q, p);
    bool positive = true, negative = true;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& a = t[k];
        const Vec3& b = t[(k + 1) % 3];
        const Vec3 edge = minus(b, a);
        // The distance between the two lines is the volume over the area that they span.
        const Vec3 span = cross(along, edge);
        const double volume = dot(along, cross(minus(a, p), minus(b, p)));
        margin = std::min(margin, length(span) > 0 ? std::abs(volume) / length(span) : 0);
        positive = positive && volume >= 0;
        negative = negative && volume <= 0;
    }
    return {positive || negative, margin};
}

Decision intersect(const std::array<Vec3, 3>& s, const std::array<Vec3, 3>& t) {
    Decision all{false, 1e300};
    for (std::size_t k = 0; k < 3; ++k)
        for (const Decision& one : {crosses(s[k], s[(k + 1) % 3], t), crosses(t[k], t[(k + 1) % 3], s)}) {
            all.hit = all.hit || one.hit;
            all.margin = std::min(all.margin, one.margin);
        }
    return all;
}

glsl::vec3 single(const Vec3& v) { return {float(v[0]), float(v[1]), float(v[2])}; }

bool device_intersects(const std::array<Vec3, 3>& s, const std::array<Vec3, 3>& t) {
    return glsl::triangles_intersect(single(s[0]), single(s[1]), single(s[2]), single(t[0]), single(t[1]),
                                     single(t[2]));
}

TEST(CutPredicateTest, EqualsDoublePrecisionOnRandomPairsOutsideARoundingBand) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(-1, 1);
    const auto triangle = [&](double size, const Vec3& at) {
        std::array<Vec3, 3> t;
        for (Vec3& corner : t)  // inputs in single precision, so that the reference decides about the same triangles
            corner = {double(float(at[0] + size * double(unit(random)))),
                      double(float(at[1] + size * double(unit(random)))),
                      double(float(at[2] + size * double(unit(random))))};
        return t;
    };
    constexpr int pair_count = 200000;
    constexpr double edge = 1.0, band = 1e-5 * edge;
    int wrong_inside_band = 0, in_band = 0, wrong = 0, hits = 0;
    for (int k = 0; k < pair_count; ++k) {
        const Vec3 at{double(unit(random)), double(unit(random)), double(unit(random))};
        const std::array<Vec3, 3> s = triangle(edge / 2, at), t = triangle(edge / 2, at);
        const Decision exact = intersect(s, t);
        const bool same = device_intersects(s, t) == exact.hit;
        hits += exact.hit;
        in_band += exact.margin <= band;
        (exact.margin <= band ? wrong_inside_band : wrong) += !same;
    }
    std::printf("[ measured ] %d pairs, %d intersect, %d in the band (%.3f %%), %d differ there, %d outside it\n",
                pair_count, hits, in_band, 100.0 * in_band / pair_count, wrong_inside_band, wrong);
    EXPECT_GT(hits, pair_count / 20);
    EXPECT_EQ(wrong, 0);
    EXPECT_LE(in_band, pair_count / 1000);
}

TEST(CutPredicateTest, DegenerateCases) {
    const std::array<Vec3, 3> blade{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    const auto cloth = [](Vec3 a, Vec3 b, Vec3 c) { return std::array<Vec3, 3>{a, b, c}; };
    struct Case {
        const char* what;
        std::array<Vec3, 3> cloth;
        bool hit;
    };
    const Case cases[] = {
        {"coplanar, overlapping", cloth({0.1, 0.1, 0}, {0.5, 0.1, 0}, {0.1, 0.5, 0}), false},
        {"coplanar, apart", cloth({3, 3, 0}, {4, 3, 0}, {3, 4, 0}), false},
        {"parallel", cloth({0.1, 0.1, 0.1}, {0.5, 0.1, 0.1}, {0.1, 0.5, 0.1}), false},
        {"a vertex touches from above", cloth({0.2, 0.2, 0}, {0.2, 0.3, 1}, {0.3, 0.2, 1}), false},
        {"a vertex touches from below", cloth({0.2, 0.2, 0}, {0.2, 0.3, -1}, {0.3, 0.2, -1}), true},
        {"an edge lies in the blade, rest below", cloth({0.2, 0.2, 0}, {0.4, 0.2, 0}, {0.3, 0.2, -1}), true},
        {"an edge lies in the blade, rest above", cloth({0.2, 0.2, 0}, {0.4, 0.2, 0}, {0.3, 0.2, 1}), false},
        {"through a vertex of the blade", cloth({-1, 0, -1}, {1, 0, 1}, {0, 3, 0.5}), true},
        {"along an edge of the blade", cloth({0.2, 0, -1}, {0.6, 0, 1}, {0.4, -0.5, 0.5}), true},
        {"blade's tip inside the cloth triangle", cloth({-2, -1, 0.5}, {2, -1, -0.5}, {0, 3, 0.001}), true},
        {"degenerate cloth triangle, a point", cloth({0.2, 0.2, 0.5}, {0.2, 0.2, 0.5}, {0.2, 0.2, 0.5}), false},
    };
    for (const Case& one : cases) {
        EXPECT_EQ(device_intersects(one.cloth, blade), one.hit) << one.what;
        EXPECT_EQ(intersect(one.cloth, blade).hit, one.hit) << one.what << " (double precision)";
    }
}

TEST(CutPredicateTest, FractionIsWhereThePlaneIsMet) {
    const glsl::vec3 a{-1, -1, 0}, b{2, -1, 0}, c{-1, 2, 0};
    EXPECT_FLOAT_EQ(glsl::crossing_fraction({0, 0, 1}, {0, 0, -3}, a, b, c), 0.25f);
    EXPECT_FLOAT_EQ(glsl::crossing_fraction({0, 0, -3}, {0, 0, 1}, a, b, c), 0.75f);
    EXPECT_EQ(glsl::crossing_fraction({5, 0, 1}, {5, 0, -3}, a, b, c), glsl::not_crossed);
    // Both triangles that share an edge take a segment through it, so nothing slips through a seam.
    const glsl::vec3 p{0, 0, 1}, q{0, 0, -1};
    EXPECT_GE(glsl::crossing_fraction(p, q, {0, -1, 0}, {0, 1, 0}, {-1, 0, 0}), 0.0f);
    EXPECT_GE(glsl::crossing_fraction(p, q, {0, 1, 0}, {0, -1, 0}, {1, 0, 0}), 0.0f);
}

}  // namespace
}  // namespace drape
