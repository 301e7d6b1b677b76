// Cloth is cut while it is folded. Contact leaves out the triangles that the cutter splits, and the proof does not
// speak of them: the exact checker, which sees their parts as they are drawn, finds no crossing without one of these.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "contact_scenes.h"
#include "crossing_checker.h"
#include "drape/scene_reader.h"
#include "gpu_test.h"
#include "simulation/frame_server.h"
#include "support/cut_checks.h"

namespace drape::test {
namespace {

struct DrawnCloth {
    FloatMesh mesh;
    std::vector<bool> whole;  ///< per triangle; the others are parts of split ones
};

/// Returns all that is drawn of a cloth: parts of split triangles have vertices that are no particles.
DrawnCloth drawn(const CutTopology& topology, std::span<const float> xyzw) {
    std::vector<glsl::vec4> particles;
    DrawnCloth cloth;
    for (std::size_t i = 0; i < xyzw.size(); i += 4) {
        particles.push_back({xyzw[i], xyzw[i + 1], xyzw[i + 2], xyzw[i + 3]});
        cloth.mesh.points.push_back({xyzw[i], xyzw[i + 1], xyzw[i + 2]});
    }
    for (const glsl::CutVertex& vertex : topology.vertices()) {
        const Vec3 at = evaluate(vertex, particles);
        cloth.mesh.points.push_back({static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2])});
    }
    const std::vector<std::uint32_t>& indices = topology.indices();
    for (std::size_t k = 0; k < indices.size(); k += 3) {
        if (indices[k] == indices[k + 1]) continue;
        cloth.mesh.triangles.push_back({indices[k], indices[k + 1], indices[k + 2]});
        cloth.whole.push_back(std::ranges::max(cloth.mesh.triangles.back()) < particles.size());
    }
    return cloth;
}

struct CutRun {
    std::size_t frames = 0, whole_crossings = 0, part_crossings = 0, most = 0;
    std::optional<std::uint32_t> first_split;   ///< first frame in which triangles are split
    std::optional<std::uint32_t> first_parted;  ///< first frame in which parts of some cross something
    std::uint32_t split = 0;                    ///< triangles
    std::size_t parted_frames = 0, cells_lost = 0;
    std::optional<SelfContactReport> told;
};

CutRun run_of(const SceneDescription& scene) {
    const SimulationModel model(scene);
    CutRun run;
    FrameOptions options;
    options.draw = false;
    options.positions = true;
    RunListener listener;
    listener.on_cut = [&](const CutEvent& event, const CutTopology&) {
        if (event.counts.triangles > 0 && !run.first_split) run.first_split = event.frame + 1;
        run.split += event.counts.triangles;
    };
    FrameServer server(gpu().device, model, options, listener);
    const std::vector<CutTopology>& topologies = server.graphs().layout().topologies;
    const std::size_t before = topologies[0].whole_triangles().size() / 3;
    server.run(
        scene.time.frame_count - 1, [](std::uint32_t) { return true; },
        [&](const FinishedFrame& frame) {
            const DrawnCloth cloth = drawn(topologies[0], frame.positions[0]);
            std::size_t parts = 0;
            for (const Crossing& each : find_crossings({cloth.mesh}).pairs)
                ++(cloth.whole[each.triangle[0]] && cloth.whole[each.triangle[1]] ? run.whole_crossings : parts);
            ++run.frames;
            run.part_crossings += parts;
            run.most = std::max(run.most, parts);
            run.parted_frames += parts > 0 ? 1 : 0;
            if (parts > 0 && !run.first_parted) run.first_parted = frame.frame;
        });
    run.cells_lost = before - topologies[0].whole_triangles().size() / 3;
    run.told = server.member(0).self_contact();
    return run;
}

TEST(CutContact, ProvesWholeTrianglesAndLeavesOutSplitOnes) {
    const SceneResult read = read_scene_text(cut_folds(17, 91, 8), "cut folds");
    ASSERT_TRUE(read.scene) << read.errors[0].text();
    const CutRun run = run_of(*read.scene);
    std::printf(
        "[ measured ] %zu frames, %u triangles split from frame %u on, parts of them cross in %zu frames from frame %u "
        "on, %zu pairs at most; %zu pairs of whole triangles cross; %u pairs near each other\n",
        run.frames, run.split, run.first_split.value_or(0), run.parted_frames, run.first_parted.value_or(0), run.most,
        run.whole_crossings, run.told->most_pairs);
    EXPECT_EQ(run.frames, 91u);
    EXPECT_FALSE(run.told->first_unproved);
    EXPECT_EQ(run.whole_crossings, 0u) << "where it is proved that none cross";
    ASSERT_TRUE(run.first_split);
    EXPECT_EQ(run.split, run.cells_lost) << "what is told is all that contact leaves out";
    ASSERT_TRUE(run.first_parted) << "the exception is not empty";
    EXPECT_GE(*run.first_parted, *run.first_split);
    EXPECT_GT(run.told->most_pairs, 300u) << "nothing met";
}

}  // namespace
}  // namespace drape::test
