// Contact between cloths on the device against the twin, which looks for pairs among all that there are.
#include "drape/scene_reader.h"
#include "support/self_contact_scenes.h"
#include "twin_comparison.h"
#include "vulkan/device_requirements.h"
#include "world/panel.h"

namespace drape {
namespace {

using test::compare;

void expect_contact(const SceneDescription& scene) { EXPECT_GT(compare(scene).most_pairs, 20u) << "nothing met"; }

/// A sheet that starts low and fast, so that it is folded after 18 frames.
SceneDescription crumpling(std::uint32_t n, SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = test::fold(n, 0.5, method, substeps);
    scene.cloths[0].velocity = {0, -4, 0};
    return scene;
}

TEST(TwinSelfContactTest, Explicit) { expect_contact(crumpling(17, SolverMethod::explicit_steps, 40)); }
TEST(TwinSelfContactTest, Line) { expect_contact(crumpling(17, SolverMethod::line, 16)); }

/// Sums are added up in integers of 64 bits, two at a time, where a device has them: with the same result.
TEST(TwinSelfContactTest, WithoutWideAtomics) {
    const std::string_view without[] = {"wide_atomics"};
    const vulkan::Device narrow(test::gpu().instance, test::gpu().device.info().uuid_text(), without);
    EXPECT_FALSE(narrow.capabilities().wide_atomics);
    const glsl::SelfRecord last = compare(crumpling(15, SolverMethod::line, 16), {}, narrow);
    EXPECT_GT(last.most_pairs, 20u) << "nothing met";
}

/// Where a device binds sets, has storage buffers in place of texel buffers, and groups as small as Vulkan allows.
TEST(TwinSelfContactTest, WithoutWhatADeviceMayLack) {
    std::vector<std::string_view> without;
    for (const vulkan::DeviceRequirement& each : vulkan::device_requirements())
        if (!each.without.empty() && each.key != "storage_images" && each.key != "storage_buffers")
            without.push_back(each.key);
    const vulkan::Device bare(test::gpu().instance, test::gpu().device.info().uuid_text(), without);
    EXPECT_FALSE(bare.capabilities().push_descriptors || bare.capabilities().texel_buffers);
    const glsl::SelfRecord last = compare(crumpling(15, SolverMethod::line, 16), {}, bare);
    EXPECT_GT(last.most_pairs, 20u) << "nothing met";
    SceneDescription scene = test::everything();
    scene.solver.tethers = true;
    compare(scene, {}, bare);
}

TEST(TwinSelfContactTest, WithHolesOnAGridOfNoPowerOfTwo) {
    SceneDescription scene = crumpling(21, SolverMethod::line, 12);
    scene.cloths[0].grid = {21, 13};
    scene.cloths[0].size = {1, 0.6};
    scene.cloths[0].holes = {{{4, 3}, {9, 8}}};
    expect_contact(scene);
}

/// Longer than what an invocation goes down, and folding along their borders, on ground that moves nothing sideways.
TEST(TwinSelfContactTest, StripsThatFoldUpLengthwise) {
    SceneDescription scene = crumpling(21, SolverMethod::line, 10);
    scene.colliders[0].friction = 0;
    Cloth& cloth = scene.cloths[0];
    cloth.friction = 0;
    cloth.grid = {3, 70};
    cloth.size = {0.03, 1};
    cloth.self_collision = SelfCollision{0.007, {}};
    expect_contact(scene);
    std::swap(cloth.placement.u, cloth.placement.v);
    cloth.grid = {70, 3};
    cloth.size = {1, 0.03};
    expect_contact(scene);
}

SceneDescription two_layers(SolverMethod method, std::uint32_t substeps) {
    SceneDescription scene = test::layers(method, substeps);
    scene.cloths.pop_back();
    for (Cloth& cloth : scene.cloths) cloth.velocity = {0, -2, 0};
    return scene;
}

TEST(TwinSelfContactTest, TwoClothsExplicit) { expect_contact(two_layers(SolverMethod::explicit_steps, 30)); }
TEST(TwinSelfContactTest, TwoClothsLine) { expect_contact(two_layers(SolverMethod::line, 12)); }

/// The lower one starts in the ground, which leads it out at 0.1 m/s, against the upper one.
TEST(TwinSelfContactTest, AClothThatAColliderLeadsOut) {
    for (const SolverMethod method : {SolverMethod::line, SolverMethod::explicit_steps}) {
        SceneDescription scene = two_layers(method, 12);
        const double lowest = std::min(scene.cloths[0].placement.origin[1], scene.cloths[1].placement.origin[1]);
        scene.colliders = {{Plane{{0, 1, 0}, lowest + 0.02}}};
        expect_contact(scene);
    }
}
/// Simulated together but for contact.
TEST(TwinSelfContactTest, ClothsOfAKind) {
    SceneDescription scene = test::layers(SolverMethod::line, 10);
    scene.cloths.resize(1);
    for (const double height : {0.4, 0.44}) {
        scene.cloths.push_back(scene.cloths[0]);
        scene.cloths.back().name += std::to_string(scene.cloths.size());
        scene.cloths.back().placement.origin = {-0.4, height, -0.3};
        scene.cloths.back().velocity = {0, -40 * (height - 0.36), 0};
    }
    expect_contact(scene);
}

/// On the sheet one begins two rows below where the other ends: as near as cells that their own cloth keeps apart, but
/// these meet.
TEST(TwinSelfContactTest, BordersOfClothsThatLieNextToEachOtherOnTheSheet) {
    SceneDescription scene = test::layers(SolverMethod::line, 10);
    scene.cloths.resize(1);
    scene.cloths[0].grid = {15, 15};
    scene.cloths[0].size = {0.7, 0.7};
    scene.cloths[0].placement.origin = {-0.35, 0.4, -0.35};
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "second";
    scene.cloths[1].placement.origin = {-0.325, 0.43, 0.34};
    scene.cloths[1].velocity = {0, -4, 0};
    const std::vector<glsl::SelfCloth> laid = SimulationModel(scene).self_contact->cloths;
    ASSERT_EQ(laid[1].first.y, laid[0].grid.y + 1);
    expect_contact(scene);
}

void expect_parting(SceneDescription scene) {
    scene.gravity = {0, -9.81, 0};
    scene.cloths[0].size = {0.6, 1};
    scene.cloths[0].placement.origin[2] = -0.5;
    scene.cloths[1].size = {0.37, 0.9};
    scene.cloths[1].placement.origin[1] = 0.93;
    const glsl::SelfRecord last = compare(scene);
    EXPECT_GT(last.crossing_count, 0u) << "they were apart before the end";
}
TEST(TwinSelfContactTest, ClothsThatStartThroughEachOtherLine) { expect_parting(test::crossed(SolverMethod::line, 5)); }
TEST(TwinSelfContactTest, ClothsThatStartThroughEachOtherExplicit) {
    expect_parting(test::crossed(SolverMethod::explicit_steps, 9));
}
/// Apart before the end, and pushed from then on.
TEST(TwinSelfContactTest, ClothsThatHaveComeApartMeet) {
    SceneDescription scene = test::crossed(SolverMethod::line, 5);
    scene.gravity = {0, -9.81, 0};
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 10), test::pin_box(12, 0, 12, 10)};
    scene.cloths[1].placement.origin[1] = 0.78;
    const glsl::SelfRecord last = compare(scene);
    EXPECT_EQ(last.crossing_count, 0u);
    EXPECT_GT(last.most_pairs, 0u);
}

/// A ring whose rim's cells are uneven, some of them a triangle alone, meets itself and what falls through its hole.
TEST(TwinSelfContactTest, OutlinesOfAnyShape) {
    const SceneDescription ring = parse_scene(
        R"({"cloths": [{"outline": {"path": "M-.5 0A.5.5 0 0 0 .5 0A.5.5 0 0 0-.5 0ZM0-.3h.2v.2h-.2z",
            "spacing": 0.062}}]})");
    for (const auto& [method, substeps] : {std::pair(SolverMethod::line, 14u), {SolverMethod::explicit_steps, 40u}}) {
        SceneDescription scene = crumpling(17, method, substeps);
        Cloth& cloth = scene.cloths[0];
        cloth.grid = ring.cloths[0].grid;
        cloth.size = ring.cloths[0].size;
        cloth.holes = ring.cloths[0].holes;
        cloth.panel = ring.cloths[0].panel;
        const std::vector<std::uint32_t> cells = cell_triangles(cloth);
        EXPECT_GT(std::ranges::count(cells, upper_triangle) + std::ranges::count(cells, lower_triangle), 0);
        scene.cloths.push_back(scene.cloths[0]);
        scene.cloths[1].name = "other";
        scene.cloths[1].placement.origin[2] += 0.05;
        expect_contact(scene);
    }
}

TEST(TwinSelfContactTest, ThreeClothsLine) { expect_contact(test::layers(SolverMethod::line, 12)); }

}  // namespace
}  // namespace drape
