// The pairs that the passes of contact leave out because the cloth keeps them apart (shaders/include/self_ring.h) are
// none that they would list, by the test of the pairs itself on patches bent, stretched, sheared, crumpled and thrown
// at random.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <random>

#include "twin/kernels.h"

namespace drape {
namespace {

using glsl::ivec2;
using glsl::uint;
using glsl::vec3;

constexpr int across = 4;

/// The first `columns` x `rows` of a patch of 4 x 4 particles: positions and motions, by row.
struct Patch {
    glsl::SelfCloth cloth{};
    int columns = across, rows = across;
    std::array<vec3, across * across> at{}, moves{};

    std::size_t place(int column, int row) const {
        return static_cast<std::size_t>(std::min(row, rows - 1) * across + std::min(column, columns - 1));
    }
    bool has(uint corner) const {
        const ivec2 texel = glsl::self_texel(corner);
        return texel.x < columns && texel.y < rows;
    }
    glsl::SelfCorners corners(const std::array<vec3, across * across>& values, glsl::uvec4 pair) const {
        const auto of = [&](uint corner) {
            return values[place(glsl::self_texel(corner).x, glsl::self_texel(corner).y)];
        };
        return {of(pair.x), of(pair.y), of(pair.z), of(pair.w)};
    }
    glsl::SelfColumns in_columns(const std::array<vec3, across * across>& values) const {
        const auto column = [&](int c) {
            return glsl::SelfColumn{values[place(c, 0)], values[place(c, 1)], values[place(c, 2)], values[place(c, 3)]};
        };
        return {column(0), column(1), column(2), column(3)};
    }
};

glsl::SelfContactPush a_push() {
    glsl::SelfContactPush push{};
    push.least = 4e-6f;
    return push;
}

uint ruled_out(const Patch& patch) {
    return glsl::self_close_apart(a_push(), patch.cloth, patch.in_columns(patch.at), patch.in_columns(patch.moves));
}

bool is_listed(const Patch& patch, bool edges, glsl::uvec4 pair) {
    const auto texel = [](uint corner) { return glsl::self_texel(corner); };
    const float kept = glsl::self_pair_thickness(patch.cloth.thickness, patch.cloth, patch.cloth, edges, texel(pair.x),
                                                 texel(pair.y), texel(pair.z), texel(pair.w));
    const glsl::SelfGap gap = glsl::self_gap(edges, patch.corners(patch.at, pair));
    return glsl::self_listed_pair(edges, gap, patch.corners(patch.moves, pair), kept, patch.cloth.thickness);
}

/// Counts the listed pairs of primitives of close pair k, all of whose corners the patch has.
int listed_of(const Patch& patch, int k) {
    const glsl::ivec4 cells = glsl::self_close_pair(k);
    const ivec2 one{cells.x, cells.y}, other{cells.z, cells.w};
    int listed = 0;
    const auto count = [&](bool edges, glsl::uvec4 pair) {
        const bool exists = patch.has(pair.x) && patch.has(pair.y) && patch.has(pair.z) && patch.has(pair.w);
        if (!exists || glsl::self_shares_corner(edges, pair)) return;
        listed += is_listed(patch, edges, pair) ? 1 : 0;
    };
    for (int which = 1; which <= 2; ++which) {
        count(false, glsl::self_point_pair(one, other, which));
        count(false, glsl::self_point_pair(other, one, which));
    }
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) count(true, glsl::self_edge_pair(one, i, other, j));
    return listed;
}

/// A pair exists if both cells have their first particle.
bool exists(const Patch& patch, int k) {
    const glsl::ivec4 cells = glsl::self_close_pair(k);
    return std::max(cells.x, cells.z) < patch.columns && std::max(cells.y, cells.w) < patch.rows;
}

class RandomPatch {
  public:
    explicit RandomPatch(unsigned seed) : random_(seed) {}

    Patch next() {
        Patch patch;
        patch.cloth.grid = {32, 32};
        patch.cloth.spacing = {within(0.01f, 0.03f), within(0.01f, 0.03f)};
        const float dx = patch.cloth.spacing.x, dy = patch.cloth.spacing.y, spacing = std::min(dx, dy);
        patch.cloth.least_flat = dx * dy / std::hypot(dx, dy);
        patch.cloth.thickness = within(0.1f, 1) * spacing;
        if (within(0, 1) < 0.3f) patch.columns = 2 + static_cast<int>(within(0, 2.99f));
        if (within(0, 1) < 0.3f) patch.rows = 2 + static_cast<int>(within(0, 2.99f));
        const vec3 origin = anywhere(2), u = unit(), turned = glsl::ordered_cross(u, unit());
        const vec3 v = turned * (1 / length(turned)), w = glsl::ordered_cross(u, v);
        // The patch is bent about each axis and twisted, stretched or pressed, sheared, each particle moved for itself.
        const float stretch = within(0.6f, 1.4f), shear = within(-0.5f, 0.5f) * within(0, 1);
        const vec3 bend = anywhere(within(0, 30));
        const float noise = within(0, 1) < 0.5f ? 0 : within(0, 0.4f) * spacing;
        const vec3 common = anywhere(within(0, 0.8f) * spacing);
        const float own = within(0, 1) * within(0, 1) * 0.5f * spacing;
        for (int row = 0; row < across; ++row)
            for (int column = 0; column < across; ++column) {
                const float x = static_cast<float>(column) * dx, y = static_cast<float>(row) * dy;
                const float height = bend.x * x * x + bend.y * y * y + bend.z * x * y;
                const std::size_t i = patch.place(column, row);
                patch.at[i] = origin + u * (x * stretch + shear * y) + v * (y * stretch) + w * height + anywhere(noise);
                patch.moves[i] = common + anywhere(own);
            }
        return patch;
    }

  private:
    float within(float least, float most) { return std::uniform_real_distribution<float>(least, most)(random_); }
    vec3 anywhere(float size) { return {size * within(-1, 1), size * within(-1, 1), size * within(-1, 1)}; }
    static float length(vec3 x) { return std::sqrt(glsl::ordered_dot(x, x)); }
    vec3 unit() {
        const vec3 x = anywhere(1);
        return x * (1 / length(x));
    }
    std::mt19937 random_;
};

TEST(SelfRingTest, NothingIsLeftOutThatWouldBeListed) {
    RandomPatch random(17);
    std::array<int, glsl::self_close_pairs> out{}, kept{}, listed{};
    for (int trial = 0; trial < 60000; ++trial) {
        const Patch patch = random.next();
        const uint bits = ruled_out(patch);
        for (int k = 0; k < glsl::self_close_pairs; ++k) {
            if (!exists(patch, k)) continue;
            const auto of = static_cast<std::size_t>(k);
            const int found = listed_of(patch, k);
            if ((bits & (1u << k)) != 0)
                EXPECT_EQ(found, 0) << "patch " << trial << ", pair " << k;
            else
                ++(found > 0 ? listed : kept)[of];
            out[of] += (bits & (1u << k)) != 0 ? 1 : 0;
        }
    }
    for (std::size_t k = 0; k < out.size(); ++k) {
        std::printf("[ measured ] pair %zu: left out %d times, listed %d, looked at for nothing %d\n", k, out[k],
                    listed[k], kept[k]);
        EXPECT_GT(out[k], 2000) << k;
        EXPECT_GT(listed[k], 500) << k;
    }
}

/// The ring is of use: in cloth that is flat, or bent as over a rod of four spacings, nothing close is looked at.
TEST(SelfRingTest, OfClothThatIsFlatOrRoundNothingIsLookedAt) {
    for (const float radius : {1e6f, 0.08f}) {
        Patch patch;
        patch.cloth.grid = {32, 32};
        patch.cloth.spacing = {0.02f, 0.02f};
        patch.cloth.least_flat = 0.02f / std::sqrt(2.0f);
        patch.cloth.thickness = 0.008f;
        for (int row = 0; row < across; ++row)
            for (int column = 0; column < across; ++column) {
                const float angle = 0.02f * static_cast<float>(column) / radius;
                patch.at[patch.place(column, row)] = {radius * std::sin(angle), 0.02f * static_cast<float>(row),
                                                      radius * (1 - std::cos(angle))};
                patch.moves[patch.place(column, row)] = {0.001f, 0, 0.002f};
            }
        EXPECT_EQ(ruled_out(patch), (1u << glsl::self_close_pairs) - 1) << radius;
    }
}

/// Each pair of cells at most two columns and rows apart belongs to one cell, the one with the lower place first.
TEST(SelfRingTest, EveryClosePairIsOneCells) {
    std::array<int, 25> seen{};
    for (int k = 0; k < glsl::self_close_pairs; ++k) {
        const glsl::ivec4 pair = glsl::self_close_pair(k);
        const int columns = pair.z - pair.x, rows = pair.w - pair.y;
        EXPECT_TRUE(rows > 0 || (rows == 0 && columns >= 0)) << k;
        EXPECT_TRUE(glsl::self_close({pair.x, pair.y}, {pair.z, pair.w})) << k;
        EXPECT_EQ(glsl::self_neighbours({pair.x, pair.y}, {pair.z, pair.w}), k < glsl::self_neighbour_pairs) << k;
        ++seen[static_cast<std::size_t>((rows + 2) * 5 + columns + 2)];
    }
    for (int rows = -2; rows <= 2; ++rows)
        for (int columns = -2; columns <= 2; ++columns) {
            const bool own = rows > 0 || (rows == 0 && columns >= 0);
            EXPECT_EQ(seen[static_cast<std::size_t>((rows + 2) * 5 + columns + 2)], own ? 1 : 0);
        }
    EXPECT_FALSE(glsl::self_close({0, 0}, {3, 0}));
    EXPECT_FALSE(glsl::self_close({0, 3}, {0, 0}));
}

}  // namespace
}  // namespace drape
