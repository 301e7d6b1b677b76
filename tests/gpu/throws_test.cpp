// Sheets and thin colliders are thrown at each other as a user would have it, by every method: nothing that is drawn
// passes a collider without a word, and `auto` takes the substeps at which nothing does.
#include "support/throws.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>

#include "drape/simulation.h"
#include "world/surface_distance.h"

namespace drape {
namespace {

/// Its messages are other tests' matter: validation takes most of the time of sheets as small as these.
const Device& device() {
    static const Device opened("", Validation::off);
    return opened;
}

struct Outcome {
    bool overlaps = false;    ///< the sheet starts in what contact keeps it from; nothing else is judged then
    bool would_pass = false;  ///< did the collider not hinder it
    bool passed = false;      ///< the sheet passed over a point in the middle of the collider
    std::optional<std::string> word;
    std::uint32_t most_substeps = 0;
};

/// Adds passages from frame to frame up, in the collider's frame.
class Sides {
  public:
    Sides(const SceneDescription& scene, std::vector<std::uint32_t> triangles)
        : scene_(scene),
          points_(test::middle_of(scene.colliders[0])),
          triangles_(std::move(triangles)),
          net_(points_.size()) {}

    void see(std::uint32_t frame, const std::vector<Vec3>& positions) {
        const ColliderPose pose = collider_pose(scene_.colliders[0], frame / scene_.time.fps);
        std::vector<Vec3> local;
        for (const Vec3& at : positions) local.push_back(exact::to_local(pose, at));
        const std::vector<int> net = test::passages(points_, triangles_, last_, local);
        for (std::size_t k = 0; k < net.size(); ++k) passed_ = (net_[k] += net[k]) != 0 || passed_;
        last_ = std::move(local);
    }
    bool passed() const { return passed_; }

  private:
    const SceneDescription& scene_;
    std::vector<Vec3> points_;
    std::vector<std::uint32_t> triangles_;
    std::vector<int> net_;  ///< per point
    std::vector<Vec3> last_;
    bool passed_ = false;
};

/// Returns where a rigid sheet that nothing stops is at the end of a frame.
std::vector<Vec3> unhindered(const SceneDescription& scene, std::vector<Vec3> positions, std::uint32_t frame) {
    const double t = frame / scene.time.fps;
    for (Vec3& at : positions) at = plus(at, times(0.5 * t * t, scene.gravity));
    return positions;
}

std::vector<Vec3> points_of(std::span<const float> numbers) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i + 3 < numbers.size(); i += 4)
        points.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    return points;
}

Outcome outcome_of(const SceneDescription& scene) {
    SimulationOptions options;
    options.draw = options.keep_promises = false;
    options.positions = options.statistics = true;
    Outcome outcome;
    std::optional<Simulation> simulation;
    try {
        simulation.emplace(scene, options, device());
    } catch (const SceneFailure&) {
        outcome.overlaps = true;
        return outcome;
    }
    Sides sides(scene, simulation->triangles(0)), free(scene, simulation->triangles(0));
    std::vector<Vec3> start;
    bool finite = true;
    simulation->run(
        scene.time.frame_count - 1, [](std::uint32_t) { return true; },
        [&](const FinishedFrame& frame) {
            const std::vector<Vec3> positions = points_of(frame.positions[0]);
            if (frame.frame == 0) start = positions;
            for (const Vec3& at : positions) finite = finite && length(at) < 1e3;
            if (finite) sides.see(frame.frame, positions);
            free.see(frame.frame, unhindered(scene, start, frame.frame));
            outcome.most_substeps = std::max(outcome.most_substeps, frame.effort.substeps);
        });
    outcome.would_pass = free.passed();
    outcome.passed = sides.passed();
    outcome.word = simulation->possible_passage();
    if (!outcome.word && simulation->verdict().failure) outcome.word = simulation->verdict().failure->reason;
    return outcome;
}

/// Every third throw is by `auto`. It need not follow the motion closely, which would take the substeps by itself.
SceneDescription next_throw(test::Random& random, int index, std::uint32_t most_columns) {
    const bool automatic = index % 3 == 0;
    SceneDescription scene = test::thrown(random, random.log_uniform(1, 500), most_columns, automatic ? 0.2 : 0.7);
    if (!automatic) return scene;
    scene.solver = {};
    scene.solver.tolerance_motion = 1000;
    return scene;
}

struct Counts {
    int judged = 0, would_pass = 0, stopped = 0, passed = 0, passed_silently = 0, told = 0;
    std::uint32_t most_substeps = 0;
    void add(const Outcome& outcome) {
        judged += 1;
        would_pass += outcome.would_pass;
        stopped += outcome.would_pass && !outcome.passed;
        passed += outcome.passed;
        passed_silently += outcome.passed && !outcome.word;
        told += outcome.word.has_value();
        most_substeps = std::max(most_substeps, outcome.most_substeps);
    }
};

/// Parts of all throws, which are made at the same time.
constexpr int part_count = 4;
class Throws : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Part, Throws, testing::Range(0, part_count));

TEST_P(Throws, PassNothingWithoutAWord) {
    // DRAPE_THROWS=200 is the campaign.
    const char* asked = std::getenv("DRAPE_THROWS");
    const int count = asked ? std::atoi(asked) / part_count : 5;
    test::Random random{std::mt19937(static_cast<unsigned>(4804 + GetParam()))};
    std::map<std::string, Counts> by_method;
    for (int i = 0; i < count; ++i) {
        const SceneDescription scene = next_throw(random, i, asked ? 65 : 17);
        const Outcome outcome = outcome_of(scene);
        if (outcome.overlaps) continue;
        const std::string method(named(scene.solver.method).name);
        by_method[method].add(outcome);
        EXPECT_TRUE(!outcome.passed || outcome.word)
            << "throw " << i << ", method " << method << ", " << scene.cloths[0].grid[0]
            << " columns, collider of kind " << scene.colliders[0].kind() << ": passed without a word";
        if (method == "auto" && outcome.passed && outcome.word)
            std::printf("[ measured ] throw %d passed at %u substeps: %s\n", i, outcome.most_substeps,
                        outcome.word->c_str());
    }
    int judged = 0, would_pass = 0;
    for (const auto& [method, counts] : by_method) {
        std::printf(
            "[ measured ] %s: %d throws, %d would pass, %d of them stopped; %d passed, %d without a word; %d told of; "
            "%u substeps at most\n",
            method.c_str(), counts.judged, counts.would_pass, counts.stopped, counts.passed, counts.passed_silently,
            counts.told, counts.most_substeps);
        judged += counts.judged;
        would_pass += counts.would_pass;
    }
    EXPECT_GT(2 * judged, count);
    EXPECT_GT(4 * would_pass, judged);
}

}  // namespace
}  // namespace drape
