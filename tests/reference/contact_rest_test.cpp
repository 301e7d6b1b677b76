// Heaps and piles of cloth come to rest on a floor with friction: nothing that contact does keeps them moving.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "cloth/simulation_model.h"
#include "drape/scene_reader.h"
#include "reference/twin.h"

namespace drape {
namespace {

struct Falling {
    std::string name, method;
    int sheets, substeps, side;
};

/// One sheet that begins upright, or several above each other, whose places are drawn.
SceneDescription scene_of(const Falling& falling, std::mt19937& random) {
    const auto between = [&](double least, double most) {
        return std::to_string(std::uniform_real_distribution<double>(least, most)(random));
    };
    const std::string side = std::to_string(falling.side) + ", " + std::to_string(falling.side);
    std::string cloths;
    for (int k = 0; k < falling.sheets; ++k) {
        const std::string turned = between(-0.2, 0.2);  // about the vertical
        const std::string placement =
            falling.sheets == 1
                ? "[0, " + between(0.41, 0.45) + R"(, 0], "u": [1, 0, )" + turned + R"(], "v": [0, -1, 0])"
                : "[" + between(0, 0.04) + ", " + std::to_string(0.03 * (k + 1)) + ", " + between(0, 0.04) +
                      R"(], "u": [1, 0, )" + turned + R"(], "v": [)" + turned + ", 0, -1]";
        cloths += std::string(k == 0 ? "" : ", ") + R"({"name": "sheet)" + std::to_string(k) + R"(", "grid": [)" +
                  side + R"(], "size": [0.4, 0.4], "damping": 1, "friction": 0.7,
                      "self_collision": {"friction": 0.5}, "placement": {"origin": )" +
                  placement + "}}";
    }
    const std::string text = R"({"time": {"frames": 301}, "cloths": [)" + cloths + R"(],
        "colliders": {"planes": [{"normal": [0, 1, 0], "friction": 0.7}]},
        "solver": {"method": ")" +
                             falling.method + R"(", "substeps": )" + std::to_string(falling.substeps) + "}}";
    return parse_scene(text);
}

/// Root mean square over all particles, m.
double rms_of(const Twin& twin, const SimulationModel& model, Field field) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t k = 0; k < model.cloths.size(); ++k)
        for (const glsl::vec4& v : twin.cloth(k)[field]) {
            sum += double(v.x) * v.x + double(v.y) * v.y + double(v.z) * v.z;
            ++count;
        }
    return std::sqrt(sum / static_cast<double>(count));
}

double farthest_moved(const std::vector<std::vector<glsl::vec4>>& before, const Twin& twin) {
    double most = 0;
    for (std::size_t k = 0; k < before.size(); ++k)
        for (std::size_t i = 0; i < before[k].size(); ++i) {
            const glsl::vec4 &a = before[k][i], &b = twin.cloth(k)[Field::position][i];
            most = std::max(most, std::hypot(double(a.x) - b.x, double(a.y) - b.y, double(a.z) - b.z));
        }
    return most;
}

class ContactRestTest : public testing::TestWithParam<Falling> {};

TEST_P(ContactRestTest, ComesToRestInFiveSecondsAndCreepsNoMore) {
    std::mt19937 random(2026);
    const SceneDescription scene = scene_of(GetParam(), random);
    const SimulationModel model(scene);
    Twin twin(model);
    std::vector<std::vector<glsl::vec4>> a_second_before;
    for (std::uint32_t frame = 1; frame <= 300; ++frame) {
        twin.run_frame(frame);
        if (frame != 240) continue;
        for (std::size_t k = 0; k < model.cloths.size(); ++k) a_second_before.push_back(twin.cloth(k)[Field::position]);
    }
    const double speed = rms_of(twin, model, Field::displacement) * scene.solver.substeps * scene.time.fps;
    const double creep = farthest_moved(a_second_before, twin);
    std::printf("[ measured ] %.3f mm/s RMS, %.4f mm in the last second\n", 1e3 * speed, 1e3 * creep);
    // A hundredth of the motion's limit (4 mm/s for 40 cm), under which a run by `auto` sleeps, is 40 um/s.
    EXPECT_LT(speed, 1e-4);
    EXPECT_LT(creep, 1e-5);
    EXPECT_GT(twin.contact().record.most_touching, 0u);
}

INSTANTIATE_TEST_SUITE_P(Of, ContactRestTest,
                         testing::Values(Falling{"heap_by_line", "line", 1, 20, 9},
                                         Falling{"heap_by_relax", "relax", 1, 20, 9},
                                         Falling{"heap_by_explicit", "explicit", 1, 64, 9},
                                         Falling{"pile_by_line", "line", 4, 20, 6}),
                         [](const auto& which) { return which.param.name; });

}  // namespace
}  // namespace drape
