// Meshes that deform push cloth, carry it along, and do not pass through it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/vectors.h"
#include "cloth/frame_inputs.h"
#include "control/drive.h"
#include "control/sleep.h"
#include "support/meshes.h"
#include "support/sheet_state.h"
#include "support/sheets.h"
#include "twin/mesh_twin.h"
#include "twin/twin.h"
#include "world/motion.h"
#include "world/surface_distance.h"

namespace drape {
namespace {

SceneDescription small_sheet(double side, double height, std::uint32_t substeps) {
    SceneDescription scene = test::sheet(17, 17, side, side, substeps);
    scene.time.frame_count = 61;
    Cloth& cloth = scene.cloths[0];
    cloth.placement = {{-0.5 * side, height, -0.5 * side}, {1, 0, 0}, {0, 0, 1}};
    cloth.contact = ContactOf::particles;
    cloth.thickness = 0.005;
    cloth.friction = 1;
    return scene;
}

/// Runs a scene and calls `see(frame, positions)` after every frame.
template <class See>
void run(const SceneDescription& scene, const See& see) {
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame < scene.time.frame_count; ++frame) {
        twin.run_frame(frame);
        std::vector<Vec3> at;
        for (std::size_t i = 0; i < twin.cloth(0)[Field::position].size(); ++i)
            at.push_back(test::position_of(twin.cloth(0), i));
        see(frame, at);
    }
}

std::vector<Vec3> end_of(const SceneDescription& scene) {
    std::vector<Vec3> last;
    run(scene, [&](std::uint32_t, const std::vector<Vec3>& at) { last = at; });
    return last;
}

double farthest_apart(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, length(minus(a[i], b[i])));
    return most;
}

/// A table that turns, slides and rises carries cloth along as well by poses as by keys.
TEST(DeformingContactTest, RigidMotionByPoses) {
    const Vec3 half{0.4, 0.05, 0.4};
    MotionPath path{{{0, {0, 0, 0}, {0, 0, 0}}, {1, {0.1, 0.05, 0}, {0, 60, 0}}}};
    SceneDescription scene = small_sheet(0.3, 0.056, 12);
    const auto posed = [&](const Vec3& at, std::size_t pose) {
        const RigidTransform motion = motion_at(path, static_cast<double>(pose) / 60);
        return plus(rotate(motion.rotation, at), motion.translation);
    };
    const std::vector<Vec3> start = end_of([&] {
        SceneDescription still = scene;
        still.colliders = {{test::mesh_of(test::box_mesh(half), {}), 1}};
        return still;
    }());
    scene.colliders = {{test::mesh_of(test::box_mesh(half), {}), 1}};
    scene.colliders[0].path = path;
    const std::vector<Vec3> by_keys = end_of(scene);
    scene.colliders = {{test::deforming_mesh(test::box_mesh(half), {}, 61, 60, posed), 1}};
    const std::vector<Vec3> by_poses = end_of(scene);
    std::printf("[ measured ] carried by %.3f m, keys and poses %.2e m apart\n", farthest_apart(by_keys, start),
                farthest_apart(by_keys, by_poses));
    EXPECT_GT(farthest_apart(by_keys, start), 0.2);
    EXPECT_LT(farthest_apart(by_keys, by_poses), 5e-4);
}

/// A ball that swells keeps cloth at its surface, which it pushes up.
TEST(DeformingContactTest, ASwellingBall) {
    const auto radius = [](double time) { return 0.2 + 0.15 * std::clamp(time, 0.0, 1.0); };
    SceneDescription scene = small_sheet(0.5, 0.21, 12);
    scene.time.frame_count = 41;
    scene.colliders = {{test::deforming_mesh(test::ball_mesh(0.2, 64), {}, 31, 30, [&](const Vec3& at, std::size_t k) {
        return times(radius(static_cast<double>(k) / 30) / 0.2, at);
    })}};
    double deepest = -1;
    run(scene, [&](std::uint32_t frame, const std::vector<Vec3>& at) {
        double least = 1;
        for (const Vec3& each : at) least = std::min(least, length(each) - radius(frame / 60.0) - 0.005);
        deepest = std::max(deepest, -least);
        if (frame > 10) {
            EXPECT_LT(least, 1e-3) << "lies on it, frame " << frame;
        }
    });
    std::printf("[ measured ] %.2e m deep\n", deepest);
    EXPECT_LT(deepest, 1.2e-3) << "as far as the triangles are inside the ball, and a little";
}

/// A thin wall that moves by several times its thickness in a substep takes cloth along and does not pass through it.
TEST(DeformingContactTest, AThinWallThatIsFast) {
    test::Triangles wall;
    wall.vertices = {{0, -0.6, -0.6}, {0, 0.6, -0.6}, {0, 0.6, 0.6}, {0, -0.6, 0.6}};
    wall.triangles = {{0, 1, 2}, {0, 2, 3}};
    SceneDescription scene = small_sheet(0.4, 0, 4);
    scene.time.frame_count = 13;
    scene.gravity = {0, 0, 0};
    scene.cloths[0].placement = {{0.3, -0.2, -0.2}, {0, 1, 0}, {0, 0, 1}};
    const auto place = [](double time) { return 9 * time; };  // m: 37.5 mm a substep
    Mesh pushed = test::deforming_mesh(
        wall, {}, 13, 60,
        [&](const Vec3& at, std::size_t k) {
            return plus(at, {place(double(k) / 60), 0, 0});
        },
        0.01);
    pushed.spacing = 0.02;
    scene.colliders = {{pushed}};
    run(scene, [&](std::uint32_t frame, const std::vector<Vec3>& at) {
        double least = 1e9;
        for (const Vec3& each : at) least = std::min(least, each[0] - place(frame / 60.0));
        EXPECT_GT(least, 0.009) << "frame " << frame;
    });
    EXPECT_GT(place(12 / 60.0), 1.5) << "it went far beyond the cloth's start";
}

Vec3 turned(const Vec3& v, double angle) {
    return {std::cos(angle) * v[0] + std::sin(angle) * v[2], v[1], -std::sin(angle) * v[0] + std::cos(angle) * v[2]};
}

/// Returns how far the point of the ring below that is nearest to a place moves: along its circle. Nothing: about the
/// middle of ring or tube it is not one.
std::optional<Vec3> way_of_ring(const Vec3& at) {
    const double out = std::hypot(at[0], at[2]), off = std::hypot(out - 0.3, at[1]);
    if (out < 0.1 || off < 0.03) return std::nullopt;
    const double scale = (0.3 + 0.1 * (out - 0.3) / off) / out;
    const Vec3 foot{scale * at[0], 0, scale * at[2]};
    return times(0.5, minus(turned(foot, 0.1), turned(foot, -0.1)));
}

/// The field has the distances of both forms and the way of the surface near each sample, for a ring that turns and for
/// a wall.
TEST(DeformingContactTest, SamplesOfTheField) {
    SceneDescription scene = small_sheet(0.4, 0.5, 4);
    Mesh ring = test::deforming_mesh(test::torus_mesh(0.3, 0.1, 48), {}, 2, 60, [](const Vec3& at, std::size_t k) {
        return turned(at, 0.1 * static_cast<double>(k));
    });
    test::Triangles flat;
    flat.vertices = {{0, -0.2, -0.2}, {0, 0.2, -0.2}, {0, 0.2, 0.2}, {0, -0.2, 0.2}};
    flat.triangles = {{0, 1, 2}, {0, 2, 3}};
    Mesh wall = test::deforming_mesh(
        flat, {}, 2, 60,
        [](const Vec3& at, std::size_t k) {
            return plus(at, {0.05 * double(k), 0, 0});
        },
        0.04);
    ring.spacing = wall.spacing = 0.03;
    scene.colliders = {{ring}, {wall}, {test::mesh_of(test::box_mesh({0.1, 0.1, 0.1}), {2, 0, 0})}};
    const SimulationModel model(scene);
    const FrameInputs inputs = frame_inputs(model, 1);
    for (std::size_t substep = 0; substep < 4; ++substep) {
        const glsl::ColliderRecord& record = inputs.colliders[3 * substep + 1];
        EXPECT_EQ(record.way_out.z, 0.25f * static_cast<float>(substep + 1));
        EXPECT_NEAR(double{record.way_out.w}, 0.05 / 4, 1e-6);
    }
    const auto texels = twin_fields(model, inputs);
    ASSERT_TRUE(texels);
    const std::size_t rigid = model.mesh_fields.first(2);
    for (std::size_t k = rigid; k < texels->size(); ++k) ASSERT_EQ((*texels)[k].x, model.mesh_fields.texels()[k].x);
    std::size_t near = 0;
    for (std::size_t mesh = 0; mesh < 2; ++mesh) {
        const glsl::vec4* const head = texels->data() + model.mesh_fields.first(mesh);
        EXPECT_EQ(head[1].w, 0.25f);
        const MeshSequence& sequence = *std::get<Mesh>(scene.colliders[mesh].shape).sequence;
        const auto columns = static_cast<std::size_t>(head[1].x), rows = static_cast<std::size_t>(head[1].y),
                   layers = static_cast<std::size_t>(head[1].z);
        for (std::size_t k = 0; k < columns * rows * layers; ++k) {
            const std::size_t x = k % columns, y = k / columns % rows, z = k / columns / rows;
            const Vec3 at = plus({double{head[0].x}, double{head[0].y}, double{head[0].z}},
                                 times(double{head[0].w}, Vec3{double(x), double(y), double(z)}));
            const glsl::vec4* const sample = head + glsl::field_head + glsl::moving_point_texels * k;
            const double begin = sequence.at(0)->distance(at), end = sequence.at(1)->distance(at);
            EXPECT_NEAR(double{sample[0].x}, begin, std::abs(begin) < 0.05 ? 1e-6 : 0.3 * (std::abs(begin) + 0.02));
            EXPECT_NEAR(double{sample[1].x}, end, std::abs(end) < 0.05 ? 1e-6 : 0.3 * (std::abs(end) + 0.02));
            if (x + 1 < columns && y + 1 < rows) {
                EXPECT_EQ(sample[0].y, (head + glsl::field_head + glsl::moving_point_texels * (k + columns))[0].x);
            }
            const Vec3 way{double{sample[2].x}, double{sample[2].y}, double{sample[2].z}};
            if (mesh == 1) {
                EXPECT_LT(length(minus(way, {0.05, 0, 0})), 1e-6);
                continue;
            }
            if (std::abs(end) > 0.05) continue;
            const std::optional<Vec3> exact = way_of_ring(at);
            if (!exact) continue;
            EXPECT_LT(length(minus(way, *exact)), 0.0015) << "of " << length(*exact);
            ++near;
        }
    }
    EXPECT_GT(near, 1000u);
}

/// Its vertices are accelerated by 2 * 0.01 * 0.2 m from pose to pose, 20 times a second.
TEST(DeformingContactTest, DriveKnowsWhatAcceleratesIt) {
    SceneDescription scene = small_sheet(0.4, 0.3, 4);
    scene.solver.method = SolverMethod::automatic;
    const std::vector<double> still = drive_of(SimulationModel(scene), 12);
    scene.colliders = {{test::deforming_mesh(test::ball_mesh(0.2, 16), {}, 11, 20, [](const Vec3& at, std::size_t k) {
        return times(1 + 0.01 * static_cast<double>(k * k), at);
    })}};
    EXPECT_NEAR(drive_of(SimulationModel(scene), 12)[0] - still[0], 0.004 * 400, 0.01);
    EXPECT_EQ(drive_of(SimulationModel(scene), 50)[0], still[0]) << "it holds its last form";
}

TEST(DeformingContactTest, SleepKnowsThatItMoves) {
    SceneDescription scene = small_sheet(0.4, 0.3, 4);
    scene.solver.method = SolverMethod::automatic;
    Mesh mesh = test::deforming_mesh(test::ball_mesh(0.2, 16), {}, 11, 20, [](const Vec3& at, std::size_t k) {
        return times(1 + 0.01 * static_cast<double>(k), at);
    });
    mesh.frames_start = 0.5;
    scene.colliders = {{mesh}};
    const auto is_quiet = [&](std::uint32_t frame) { return quiet(SimulationModel(scene), frame); };
    EXPECT_TRUE(is_quiet(10));
    EXPECT_FALSE(is_quiet(31));
    EXPECT_FALSE(is_quiet(61)) << "the last step that sees the motion";
    EXPECT_TRUE(is_quiet(63));
    std::get<Mesh>(scene.colliders[0].shape).loop = true;
    EXPECT_FALSE(is_quiet(10));
    EXPECT_FALSE(is_quiet(63));
}

}  // namespace
}  // namespace drape
