// Oracles measure strain against the lengths at which springs rest, whatever the cloth's outline or rest shape.
#include "run/scene_run.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cloth/cloth_geometry.h"
#include "drape/scene_reader.h"

namespace drape {
namespace {

TEST(SceneRun, AnOutlinesSpringsAreUnstrainedAtItsStart) {
    verify::SceneRun run;
    run.scene =
        parse_scene(R"({"cloths": [{"outline": {"path": "M-1 0A1 1 0 0 0 1 0A1 1 0 0 0-1 0Z", "spacing": 0.1}}]})");
    run.frames.push_back({ClothGeometry(run.scene, run.scene.cloths[0], false, {}).position});
    const auto expect_strains = [&](double strain) {
        for (const bool down : {false, true}) {
            const std::vector<double> strains = verify::spring_strains(run, 0, 0, down);
            EXPECT_GT(strains.size(), 300u);
            EXPECT_NEAR(std::ranges::max(strains), strain, 1e-5);
            EXPECT_NEAR(std::ranges::min(strains), strain, 1e-5);
        }
    };
    expect_strains(0);
    for (glsl::vec4& at : run.frames[0][0]) at.x *= 1.25f, at.y *= 1.25f;
    expect_strains(0.25);
}

}  // namespace
}  // namespace drape
