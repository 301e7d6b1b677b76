// Cloth drawn over the edges and corners of boxes equals its twin bit for bit (lavapipe), by every method.
#include "twin_comparison.h"

namespace drape {
namespace {

using test::compare;
using test::frame_count;

/// Coarse cells, of more rows than an invocation of the pass looks at, fall on a standing and a turning box, whose
/// edges their particles straddle.
SceneDescription over_boxes(SolverMethod method) {
    SceneDescription scene = test::sheet(19, 34, 0.9, 0.85, test::substep_count);
    scene.time.frame_count = frame_count + 1;
    scene.solver.method = method;
    const MotionPath path{{{0, {0, 0, 0}, {0, 0, 0}}, {0.3, {0.05, 0.1, 0}, {20, 90, 10}}}};
    scene.colliders = {{Box{{0.2, -0.15, 0}, {0.12, 0.1, 0.2}}, 0.3, {10, 20, 30}, path},
                       {Box{{-0.25, -0.15, 0.02}, {0.1, 0.12, 0.13}}, 0.5},
                       {Sphere{{0, -0.3, 0.3}, 0.1}},
                       {Plane{{0, 1, 0}, -0.2}}};
    Cloth& cloth = scene.cloths[0];
    cloth.placement = {{-0.45, 0.0, -0.6}, {1, 0, 0}, {0, 0, 1}};
    cloth.stiffness = {false, 800, 60, 0};
    cloth.thickness = 0.002;
    cloth.velocity = {0, -1.5, 0};
    cloth.pins = {test::pin_box(9, 11, 9, 11)};  // between the boxes
    return scene;
}

std::vector<glsl::vec4> end_of(const SceneDescription& scene) {
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= frame_count; ++frame) twin.run_frame(frame);
    return twin.cloth(0)[Field::position];
}

TEST(TwinBoxEdgeTest, EveryMethod) {
    for (const SolverMethod method : {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line}) {
        SceneDescription scene = over_boxes(method);
        compare(scene);
        std::vector<glsl::vec4> met = end_of(scene);
        scene.cloths[0].contact = ContactOf::particles;
        std::string where;
        EXPECT_FALSE(test::same_bits(met, end_of(scene), where)) << "no edge was met";
    }
}

TEST(TwinBoxEdgeTest, MoreBoxesThanAreReadEarly) {
    SceneDescription scene = over_boxes(SolverMethod::line);
    for (const double x : {-0.3, -0.1, 0.1, 0.3})
        scene.colliders.push_back({Box{{x, -0.15, 0.22 + 0.1 * x}, {0.06, 0.12, 0.05}}, 0.4, {0, 100 * x, 15}});
    compare(scene);
    const std::vector<glsl::vec4> met = end_of(scene);
    scene.colliders.resize(scene.colliders.size() - 2);  // the last two are read late
    std::string where;
    EXPECT_FALSE(test::same_bits(met, end_of(scene), where)) << "those that are read late were not met";
}

TEST(TwinBoxEdgeTest, HolesTethersAndIterationsThatTheDeviceEnds) {
    SceneDescription scene = over_boxes(SolverMethod::line);
    scene.cloths[0].holes = {{{3, 5}, {6, 9}}, {{14, 0}, {16, 4}}};
    scene.solver.tethers = true;
    compare(scene);
    scene.solver.tethers = false;
    scene.solver.method = SolverMethod::relax;
    scene.solver.iterations = 3;
    scene.solver.tolerance = 0.02;
    compare(scene);
}

TEST(TwinBoxEdgeTest, ClothsTogetherAndAgainstEachOther) {
    SceneDescription scene = over_boxes(SolverMethod::line);
    Cloth second = scene.cloths[0];
    second.name = "second";
    second.placement.origin[1] = 0.06;
    scene.cloths.push_back(second);
    compare(scene);
    scene.cloths[1].placement.scale = {1.1, 1.3};  // its edges reach farther
    compare(scene);
    scene.cloths[1].placement.scale = {1, 1};
    for (Cloth& cloth : scene.cloths) cloth.self_collision = SelfCollision{};
    scene.cloths[1].grid = {17, 17};
    scene.cloths[1].thickness = 0.01;
    compare(scene);
}

TEST(TwinBoxEdgeTest, ClothThatStartsInBoxes) {
    SceneDescription scene = over_boxes(SolverMethod::line);
    Cloth second = scene.cloths[0];
    second.name = "second";
    second.velocity = {};
    second.placement.origin[1] = -0.1;
    scene.cloths[0].placement.origin[1] = 0.5;  // in none
    scene.cloths.push_back(second);
    EXPECT_NE(SimulationModel(scene).cloths[0].collider_list, SimulationModel(scene).cloths[1].collider_list);
    compare(scene);
    for (Cloth& cloth : scene.cloths) cloth.contact = ContactOf::particles;
    compare(scene);
}

TEST(TwinBoxEdgeTest, ClothThatStartsInSpheresThatAreReadLate) {
    SceneDescription scene = over_boxes(SolverMethod::line);
    scene.cloths[0].velocity = {};
    scene.colliders.clear();
    for (int k = 0; k < 8; ++k) scene.colliders.push_back({Sphere{{0.3 * k, -3, 0}, 0.1}});  // the early ones
    for (const double x : {-0.4, -0.28, -0.1, 0.0, 0.05, 0.3})
        scene.colliders.push_back({Sphere{{x, 0.03, x - 0.1}, 0.12}, 0.4});
    compare(scene);
}

TEST(TwinBoxEdgeTest, ThicknessThatCoversACellNeedsNoEdges) {
    SceneDescription scene = over_boxes(SolverMethod::line);
    scene.cloths[0].thickness = 0.05;
    const SimulationModel model(scene);
    EXPECT_EQ(model.cloths[0].edge_reach, 0);
    EXPECT_TRUE(std::ranges::none_of(frame_steps(model),
                                     [](const Step& step) { return step.kind == StepKind::collider_edges; }));
}

}  // namespace
}  // namespace drape
