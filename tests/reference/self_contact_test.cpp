// Contact of cloths with themselves and each other, on the twin, is judged by a checker that shares nothing with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/self_contact_scenes.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {
namespace {

struct Found {
    std::size_t crossed_frames = 0;
    std::uint32_t most_pairs = 0, unproved = 0, truncated = 0;
};

Found run(const SceneDescription& scene, std::uint32_t frames) {
    const SimulationModel model(scene);
    Twin twin(model);
    Found found;
    for (std::uint32_t frame = 1; frame <= frames; ++frame) {
        twin.run_frame(frame);
        const std::size_t crossed = test::crossings(model, twin);
        found.crossed_frames += crossed > 0 ? 1 : 0;
        if (!model.self_contact) continue;
        const glsl::SelfRecord& record = twin.contact().record;
        found.most_pairs = std::max(found.most_pairs, record.most_pairs);
        found.unproved += record.unproved;
        found.truncated += record.truncated;
        EXPECT_TRUE(crossed == 0 || found.unproved > 0)
            << "certified, but " << crossed << " triangles cross in frame " << frame;
    }
    std::printf("[ measured ] crossings in %zu of %u frames, %u pairs, %u motions cut short, %u not proved\n",
                found.crossed_frames, frames, found.most_pairs, found.truncated, found.unproved);
    return found;
}

void expect_apart(const SceneDescription& scene, std::uint32_t frames, bool pressed = false) {
    const Found found = run(scene, frames);
    EXPECT_EQ(found.crossed_frames, 0u);
    EXPECT_EQ(found.unproved, 0u);
    EXPECT_GT(found.most_pairs, 50u) << "nothing met";
    if (pressed) {
        EXPECT_GT(found.truncated, 0u);
    }
}

TEST(SelfContactTest, WithoutItFoldsGoThroughEachOther) {
    SceneDescription scene = test::fold(13, 0.5, SolverMethod::line, 16);
    scene.cloths[0].self_collision.reset();
    EXPECT_GT(run(scene, 45).crossed_frames, 0u);
}

TEST(SelfContactTest, FoldsLieOnEachOtherByLineSolves) {
    expect_apart(test::fold(13, 0.5, SolverMethod::line, 16), 60);
}

TEST(SelfContactTest, ThinFoldsLieOnEachOtherByExplicitSteps) {
    expect_apart(test::fold(13, 0.1, SolverMethod::explicit_steps, 50), 50);
}

TEST(SelfContactTest, FoldsAsThickAsAnEdge) { expect_apart(test::fold(13, 1, SolverMethod::line, 16), 50); }

/// Cloth that fell on itself fast, in few substeps, is pressed to microns; it comes apart again and lies still.
TEST(SelfContactTest, WhatWasPressedTogetherComesApart) {
    const SimulationModel model(test::fold(25, 0.5, SolverMethod::line, 6));
    Twin twin(model);
    std::uint32_t falling = 0, lying = 0;
    for (std::uint32_t frame = 1; frame <= 200; ++frame) {
        twin.run_frame(frame);
        EXPECT_EQ(twin.contact().record.unproved, 0u);
        (frame <= 160 ? falling : lying) += twin.contact().record.truncated;
    }
    std::printf("[ measured ] motions cut short: %u falling, %u lying\n", falling, lying);
    EXPECT_GT(falling, 30u);
    EXPECT_EQ(lying, 0u);
}

/// Sheets fall onto each other and the ground, each `apart` above the one before.
SceneDescription pile(std::uint32_t count, double apart) {
    SceneDescription scene = test::stack(count, 7, SolverMethod::line, 8);
    for (std::uint32_t k = 0; k < count; ++k) {
        scene.cloths[k].placement.origin[1] = -0.29 + apart * k;
        scene.cloths[k].self_collision->thickness = 0.012;
    }
    scene.colliders.erase(scene.colliders.begin());
    return scene;
}

double mean_height(const Twin& twin, std::size_t cloth) {
    const auto& x = twin.cloth(cloth)[Field::position];
    double sum = 0;
    for (const glsl::vec4& at : x) sum += double(at.y);
    return sum / static_cast<double>(x.size());
}

/// The load of a layer grows with the pile above it; when thickness was given back evenly, the lowest ones lost theirs.
TEST(SelfContactTest, APileKeepsItsHeight) {
    const SceneDescription scene = pile(20, 0.03);
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 45; ++frame) twin.run_frame(frame);
    const double height = mean_height(twin, 19) - mean_height(twin, 0);
    const double share = height / (19 * *scene.cloths[0].self_collision->thickness);
    std::printf("[ measured ] a layer of the pile keeps %.2f of its thickness\n", share);
    EXPECT_EQ(twin.contact().record.unproved, 0u);
    EXPECT_GT(share, 0.75);
    EXPECT_LT(share, 1.05);
}

/// Contact gives thickness back no faster than it says, however little is left.
TEST(SelfContactTest, WhatStartsPressedTogetherIsNotThrownApart) {
    SceneDescription scene = pile(2, 0.001);
    scene.gravity = {0, 0, 0};
    scene.colliders.clear();
    for (Cloth& cloth : scene.cloths) cloth.damping = 0;
    const SimulationModel model(scene);
    Twin twin(model);
    double before = mean_height(twin, 1) - mean_height(twin, 0), fastest = 0;
    for (std::uint32_t frame = 1; frame <= 30; ++frame) {
        twin.run_frame(frame);
        const double apart = mean_height(twin, 1) - mean_height(twin, 0);
        fastest = std::max(fastest, (apart - before) * 60);
        before = apart;
    }
    std::printf("[ measured ] apart at up to %.3f m/s, then %.4f m\n", fastest, before);
    EXPECT_GT(before, *scene.cloths[0].self_collision->thickness * 0.99);
    EXPECT_LT(fastest, 1.5 * recovery_speed * double(glsl::self_deep_recovery));  // both kinds of pairs push
}

TEST(SelfContactTest, FoldsByRelaxation) { expect_apart(test::fold(13, 0.4, SolverMethod::relax, 16), 50); }

/// The sheet is pulled tight around itself, so that motions are cut short.
TEST(SelfContactTest, ATwistedSheetIsNeverCrossed) {
    expect_apart(test::twist(13, 0.4, SolverMethod::line, 30, 2.5, 1), 60, true);
}

/// Nothing can keep apart parts that are held, so nothing is certified.
TEST(SelfContactTest, WhatIsHeldAcrossItselfIsNotCertified) {
    SceneDescription scene = test::sheet(13, 13, 1, 1, 8);
    scene.solver.method = SolverMethod::line;
    scene.gravity = {0, 0, 0};
    Cloth& cloth = scene.cloths[0];
    cloth.self_collision = SelfCollision{0.03, {}};
    cloth.pins = {test::pin_box(0, 0, 12, 0), test::pin_box(0, 6, 12, 6), test::pin_box(0, 12, 12, 12)};
    // The lower edge is carried up and through the upper half.
    cloth.pins[2].path.keys = {{0, {}, {}}, {0.25, {0.1, 0.75, 0.2}, {}}, {0.5, {0.2, 0.75, -0.3}, {}}};
    const Found found = run(scene, 30);
    EXPECT_GT(found.crossed_frames, 0u);
    EXPECT_GT(found.unproved, 0u);
}

TEST(SelfContactTest, WithoutItClothsGoThroughEachOther) {
    SceneDescription scene = test::layers(SolverMethod::line, 16);
    scene.cloths[0].self_collision.reset();
    EXPECT_GT(run(scene, 20).crossed_frames, 0u);
}

TEST(SelfContactTest, ClothsLieOnEachOtherByLineSolves) { expect_apart(test::layers(SolverMethod::line, 16), 60); }

TEST(SelfContactTest, ClothsLieOnEachOtherByExplicitSteps) {
    expect_apart(test::layers(SolverMethod::explicit_steps, 40), 40);
}

/// A strip held by its ends is pressed down onto a sheet that is held by its sides.
TEST(SelfContactTest, ClothsThatAreHeldAgainstEachOther) {
    SceneDescription scene = test::sheet(11, 9, 0.6, 0.48, 24);
    scene.solver.method = SolverMethod::line;
    Cloth& sheet = scene.cloths[0];
    sheet.self_collision = SelfCollision{};
    sheet.thickness = 0.02;
    sheet.stiffness = {false, 2000, 100, 1e-4};
    sheet.damping = 1;
    sheet.placement = {{-0.3, 0.5, -0.24}, {1, 0, 0}, {0, 0, 1}};
    Cloth strip = sheet;
    strip.name = "strip";
    strip.grid = {7, 13};
    strip.size = {0.35, 0.7};
    strip.placement.origin = {-0.15, 0.54, -0.36};
    sheet.pins = {test::pin_box(0, 0, 0, 8), test::pin_box(10, 0, 10, 8)};
    strip.pins = {test::pin_box(0, 0, 6, 0), test::pin_box(0, 12, 6, 12)};
    for (Pin& pin : strip.pins) pin.path.keys = {{0, {}, {}}, {0.1, {0, -0.5, 0}, {}}};
    scene.cloths.push_back(strip);
    expect_apart(scene, 40, true);
}

/// Returns the height of the centre of mass of all cloths times their mass, m kg.
double mass_moment(const SimulationModel& model, const Twin& twin) {
    double moment = 0;
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
        for (const glsl::vec4& at : twin.cloth(cloth)[Field::position])
            moment += model.scene.cloths[cloth].areal_density / double(at.w) * double(at.y);
    return moment;
}

TEST(SelfContactTest, ClothsOfDifferentMassExchangeMomentumAndMakeNone) {
    SceneDescription scene = test::sheet(9, 9, 0.8, 0.8, 16);
    scene.solver.method = SolverMethod::line;
    scene.gravity = {0, 0, 0};
    Cloth& light = scene.cloths[0];
    light.areal_density = 0.05;
    light.placement = {{0, 0.1, 0}, {1, 0, 0}, {0, 0, 1}};
    light.velocity = {0, -1, 0};
    light.self_collision = SelfCollision{0.05, 0.3};
    Cloth heavy = light;
    heavy.name = "heavy";
    heavy.areal_density = 0.5;
    heavy.placement = {{0.03, 0, 0.02}, {1, 0, 0}, {0, 0, 1}};
    heavy.velocity = {0, 0, 0};
    scene.cloths.push_back(heavy);
    const SimulationModel model(scene);
    Twin twin(model);
    const double begin = mass_moment(model, twin);
    const double light_start = double(twin.cloth(0)[Field::position][40].y);
    for (std::uint32_t frame = 1; frame <= 2; ++frame) twin.run_frame(frame);  // still apart
    const double per_frame = (mass_moment(model, twin) - begin) / 2;
    for (std::uint32_t frame = 3; frame <= 20; ++frame) twin.run_frame(frame);
    const double off = (mass_moment(model, twin) - begin) / (20 * per_frame) - 1;
    const double flown = double(twin.cloth(0)[Field::position][40].y) - light_start;
    std::printf("[ measured ] momentum off by %.2e of itself; the light cloth flew %.3f m\n", off, flown);
    EXPECT_GT(flown, -0.2) << "they did not meet";
    EXPECT_NEAR(off, 0, 0.03);
}

/// The nearest points are compared with points tried all over the two primitives.
TEST(SelfContactKernelTest, NearestPointsAreNearest) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> anywhere(-1, 1);
    const auto point = [&] { return glsl::vec3{anywhere(random), anywhere(random), anywhere(random)}; };
    for (int trial = 0; trial < 400; ++trial) {
        const bool edges = trial % 2 == 0;
        const glsl::SelfCorners x{point(), point(), point(), point()};
        const glsl::SelfGap gap = glsl::self_gap(edges, x);
        const auto length = [](glsl::vec3 v) { return std::hypot(double(v.x), double(v.y), double(v.z)); };
        double least = 1e9;
        for (int i = 0; i <= 40; ++i)
            for (int k = 0; k <= 40; ++k) {
                const float s = static_cast<float>(i) / 40, t = static_cast<float>(k) / 40;
                if (!edges && s + t > 1) continue;
                const glsl::vec3 one = edges ? x.a * (1 - s) + x.b * s : x.a;
                const glsl::vec3 other = edges ? x.c * (1 - t) + x.d * t : x.b * (1 - s - t) + x.c * s + x.d * t;
                least = std::min(least, length(other - one));
            }
        EXPECT_LE(gap.distance, least + 1e-5) << trial;
        EXPECT_GE(gap.distance, least - 0.06) << trial;
        if (gap.apart > 0) {
            EXPECT_NEAR(gap.apart, gap.distance, 1e-4) << trial;
        }
    }
}

/// Corners of pair k of two cells.
glsl::uvec4 pair_of_cells(glsl::ivec2 a, glsl::ivec2 b, int k) {
    if (k < 2) return glsl::self_point_pair(a, b, k + 1);
    if (k < glsl::self_first_edge_pair) return glsl::self_point_pair(b, a, k - 1);
    const int edges = k - glsl::self_first_edge_pair;
    return glsl::self_edge_pair(a, edges / 3, b, edges % 3);
}

glsl::SelfCorners raised(glsl::SelfCorners x, glsl::vec3 by) { return {x.a + by, x.b + by, x.c + by, x.d + by}; }

/// The primitives are of 2 cm, microns apart, a metre from the origin: the line between their nearest points, as
/// rounding leaves it, is no plane's normal.
TEST(SelfContactKernelTest, APlaneIsKnownBetweenWhatAllButTouches) {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> anywhere(-1, 1), inside(0.2f, 0.4f), micron(2e-6f, 1e-5f);
    const auto point = [&](float size) {
        return glsl::vec3{size * anywhere(random), size * anywhere(random), size * anywhere(random)};
    };
    int trials = 0, planes = 0, square_to_the_line = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const bool edges = trial % 2 == 0;
        glsl::SelfCorners x{point(0.02f), point(0.02f), point(0.02f), point(0.02f)};
        const glsl::vec3 first = edges ? x.b - x.a : x.c - x.b, second = edges ? x.d - x.c : x.d - x.b;
        const glsl::vec3 normal = glsl::ordered_cross(first, second);
        const float area = std::sqrt(glsl::ordered_dot(normal, normal));
        if (area < 1e-4f) continue;
        ++trials;
        // The first primitive is led to within microns of a point inside the other.
        const float s = inside(random), t = inside(random);
        const glsl::vec3 from = edges ? x.a + first * s : x.a,
                         to = edges ? x.c + second * t : x.b + first * s + second * t;
        const glsl::vec3 lead = to - from + normal * (micron(random) / area);
        x.a = x.a + lead;
        if (edges) x.b = x.b + lead;
        const glsl::SelfCorners far = raised(x, point(1));
        const glsl::SelfGap gap = glsl::self_gap_squared(edges, far), line = glsl::self_gap(edges, far);
        EXPECT_GE(gap.apart, line.apart);
        planes += gap.apart > 0.5f * gap.distance ? 1 : 0;
        square_to_the_line += line.apart > 0.5f * line.distance ? 1 : 0;
        const auto height = [&](glsl::vec3 at) {
            return double(gap.normal.x) * at.x + double(gap.normal.y) * at.y + double(gap.normal.z) * at.z;
        };
        const double below = edges ? std::max(height(far.a), height(far.b)) : height(far.a);
        const double above =
            edges ? std::min(height(far.c), height(far.d)) : std::min({height(far.b), height(far.c), height(far.d)});
        EXPECT_NEAR(above - below, gap.apart, gap.doubt) << trial;
    }
    std::printf("[ measured ] planes of %d pairs: %d; square to the line between them: %d\n", trials, planes,
                square_to_the_line);
    EXPECT_EQ(planes, trials);
    EXPECT_LT(square_to_the_line, trials * 3 / 4);
}

/// Contact leads a particle off the way that the solver wants by no more than its limit, and may stop it anywhere on
/// it.
TEST(SelfContactKernelTest, ContactStaysAboutTheWayThatTheSolverWants) {
    std::mt19937 random(10);
    std::uniform_real_distribution<float> anywhere(-1, 1), part(0, 1);
    const auto point = [&](float size) {
        return glsl::vec3{size * anywhere(random), size * anywhere(random), size * anywhere(random)};
    };
    const auto length = [](glsl::vec3 v) { return std::hypot(double(v.x), double(v.y), double(v.z)); };
    const float thickness = 0.01f, limit = glsl::self_limit(thickness);
    for (int trial = 0; trial < 2000; ++trial) {
        const glsl::vec3 carried = point(0.02f), before = carried + point(0.1f), asked = carried + point(0.1f);
        const glsl::vec3 bounded = glsl::self_bounded(asked, before, carried, thickness);
        double off = 1;
        for (int k = 0; k <= 1000; ++k)
            off = std::min(off, length(bounded - (carried + (before - carried) * (static_cast<float>(k) / 1000))));
        EXPECT_LE(off, limit * 1.01) << trial;
        const glsl::vec3 again = glsl::self_bounded(bounded, before, carried, thickness);
        EXPECT_NEAR(length(again - bounded), 0, 1e-7) << trial;
        const glsl::vec3 allowed = carried + (before - carried) * part(random) + point(0.5f * limit);
        const glsl::vec3 left = glsl::self_bounded(allowed, before, carried, thickness);
        EXPECT_EQ(length(left - allowed), 0) << trial;
    }
}

TEST(SelfContactKernelTest, PairsOfTwoCellsThatShareNoCornerAreKnown) {
    std::vector<glsl::ivec2> offsets{{2, 0}, {-2, 1}, {0, 2}, {1, 2}};
    for (int k = 0; k < glsl::self_neighbour_pairs; ++k) {
        const glsl::ivec4 pair = glsl::self_close_pair(k);
        offsets.push_back({pair.z - pair.x, pair.w - pair.y});
    }
    for (const glsl::ivec2 offset : offsets) {
        const glsl::ivec2 a{8, 8}, b{8 + offset.x, 8 + offset.y};
        glsl::uint expected = 0;
        for (int k = 0; k < 13; ++k) {
            const glsl::uvec4 pair = pair_of_cells(a, b, k);
            bool again = glsl::self_shares_corner(k >= glsl::self_first_edge_pair, pair);
            for (int before = 0; before < k; ++before) {
                const glsl::uvec4 other = pair_of_cells(a, b, before);
                const bool of_a_kind = (before < glsl::self_first_edge_pair) == (k < glsl::self_first_edge_pair);
                again |= of_a_kind && pair.x == other.x && pair.y == other.y && pair.z == other.z && pair.w == other.w;
            }
            expected |= again ? 0u : 1u << k;
        }
        EXPECT_EQ(glsl::self_disjoint(offset.x, offset.y), expected) << offset.x << ", " << offset.y;
    }
}

/// However the corners are told to move, the shares leave no motion that brings the two together.
TEST(SelfContactKernelTest, TruncatedMotionsDoNotMeet) {
    std::mt19937 random(8);
    std::uniform_real_distribution<float> anywhere(-1, 1);
    const auto point = [&](float size) {
        return glsl::vec3{size * anywhere(random), size * anywhere(random), size * anywhere(random)};
    };
    int cut_short = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const bool edges = trial % 2 == 0;
        glsl::SelfCorners x{point(1), point(1), point(1), point(1)}, moved{point(2), point(2), point(2), point(2)};
        const glsl::SelfGap gap = glsl::self_gap_squared(edges, x);
        const glsl::vec3 all[4] = {moved.a, moved.b, moved.c, moved.d};
        float along[4], share[4] = {};
        for (int k = 0; k < 4; ++k) along[k] = glsl::ordered_dot(gap.normal, all[k]);
        for (int round = 0; round < glsl::self_rounds; ++round) {
            const glsl::vec4 all_along{along[0], along[1], along[2], along[3]},
                made{share[0], share[1], share[2], share[3]}, end = glsl::self_ends(gap, all_along, made);
            const float middle = glsl::self_middle(edges, gap.apart, end, glsl::self_wants(all_along, made));
            const float ends[4] = {end.x, end.y, end.z, end.w};
            for (int k = 0; k < 4; ++k) {
                const float before = share[k];
                share[k] = glsl::self_share(gap, middle, ends[k], k == 0 || (edges && k == 1) ? 1.0f : -1.0f, along[k],
                                            before, false, 1e-6f);
                EXPECT_GE(share[k], before) << trial;
                cut_short += share[k] < 1 ? 1 : 0;
                // Another pair may have allowed less.
                if (trial % 3 == 0) share[k] = before + (share[k] - before) * 0.5f;
            }
        }
        moved = {moved.a * share[0], moved.b * share[1], moved.c * share[2], moved.d * share[3]};
        for (const float part : {0.25f, 0.5f, 0.75f, 1.0f}) {
            const glsl::SelfGap then = glsl::self_gap(
                edges, {x.a + moved.a * part, x.b + moved.b * part, x.c + moved.c * part, x.d + moved.d * part});
            EXPECT_GT(then.distance, 0.45f * gap.apart) << trial;
        }
    }
    EXPECT_GT(cut_short, 1000);
}

TEST(TriangleCrossingsTest, KnowsCrossingFromTouchingAndApart) {
    const std::vector<TriangleCrossings::Point> flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const auto with = [&](const TriangleCrossings::Point& p, const TriangleCrossings::Point& q,
                          const TriangleCrossings::Point& r, const std::vector<std::uint32_t>& indices) {
        std::vector<TriangleCrossings::Point> points = flat;
        points.insert(points.end(), {p, q, r});
        return TriangleCrossings({{points, indices}}).count();
    };
    EXPECT_EQ(with({0.2, 0.2, -1}, {0.3, 0.2, 1}, {5, 5, 1}, {0, 1, 2, 3, 4, 5}), 1u);
    EXPECT_EQ(with({0.2, 0.2, 0.01}, {0.3, 0.2, 1}, {5, 5, 1}, {0, 1, 2, 3, 4, 5}), 0u);
    // Triangles that share a corner: through the inside, beside it.
    EXPECT_EQ(with({0.2, 0.2, -1}, {0.3, 0.2, 1}, {5, 5, 1}, {0, 1, 2, 0, 3, 4}), 1u);
    EXPECT_EQ(with({-0.2, -0.2, -1}, {-0.3, -0.2, 1}, {5, 5, 1}, {0, 1, 2, 0, 3, 4}), 0u);
    // Triangles that share an edge do not cross.
    EXPECT_EQ(with({0.2, 0.2, 0.01}, {5, 5, 1}, {5, 5, 2}, {0, 1, 2, 0, 1, 3}), 0u);
}

/// Particles within a hole are nobody's corner, and meet nothing.
TEST(SelfContactTest, ClothFallsThroughAHole) {
    SceneDescription scene = test::sheet(17, 17, 1, 1, 10);
    scene.solver.method = SolverMethod::line;
    Cloth& frame = scene.cloths[0];
    frame.placement = {{-0.5, 0, -0.5}, {1, 0, 0}, {0, 0, 1}};
    frame.holes = {{{3, 3}, {13, 13}}};
    frame.pins = {test::pin_box(0, 0, 16, 16)};
    frame.self_collision.emplace();
    Cloth small = frame;
    small.name = "small";
    small.grid = {5, 5};
    small.size = {0.3, 0.3};
    small.placement.origin = {-0.15, 0.1, -0.15};
    small.holes.clear(), small.pins.clear();
    scene.cloths.push_back(small);
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t count = 1; count <= 30; ++count) twin.run_frame(count);
    for (const glsl::vec4& at : twin.cloth(1)[Field::position]) EXPECT_LT(at.y, -0.8) << "9.81/8 - .1 m below the hole";
}

TEST(SelfContactTest, TheMessagesTellTheSpeedsOfTheShaders) {
    EXPECT_EQ(static_cast<float>(recovery_speed), glsl::self_recovery_speed);
    EXPECT_EQ(static_cast<float>(parting_speed), glsl::self_parting_speed);
}

}  // namespace
}  // namespace drape
