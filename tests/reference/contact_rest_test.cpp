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
#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

struct Falling {
    std::string name, method;
    int sheets, substeps, side;
    std::uint32_t seconds = 5;  ///< until it rests
    unsigned seed = 2026;
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
    const std::string text = R"({"time": {"frames": )" + std::to_string(60 * falling.seconds + 1) +
                             R"(}, "cloths": [)" + cloths + R"(],
        "colliders": {"planes": [{"normal": [0, 1, 0], "friction": 0.7}]},
        "solver": {"method": ")" +
                             falling.method + R"(", "substeps": )" + std::to_string(falling.substeps) + "}}";
    return parse_scene(text);
}

/// A sheet of 9 x 9 particles that lies on the ground, whose thickness grows along its rows from a quarter of
/// `thickness`.
SceneDescription wedge(double thickness) {
    SceneDescription scene = test::sheet(9, 9, 0.4, 0.4, 16);
    scene.colliders.push_back({Plane{}, 0.5});
    Cloth& cloth = scene.cloths[0];
    cloth.thickness = thickness;
    cloth.damping = 2;
    cloth.placement = {{-0.2, thickness, -0.2}, {1, 0, 0}, {0, 0, 1}};
    for (int i = 0; i < 81; ++i) cloth.particle_thickness.push_back(0.25f + 0.75f * static_cast<float>(i % 9) / 8);
    return scene;
}

double height(const Twin& twin, std::size_t cloth, std::size_t particle) {
    return twin.cloth(cloth)[Field::position][particle].y;
}

TEST(ContactRestTest, ASheetLiesAtTheHeightsThatItsMapOfThicknessSays) {
    for (const SolverMethod method : {SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps}) {
        SceneDescription scene = wedge(0.02);
        scene.solver.method = method;
        if (method == SolverMethod::explicit_steps) scene.solver.substeps = 60;
        const SimulationModel model(scene);
        Twin twin(model);
        for (std::uint32_t frame = 1; frame <= 120; ++frame) twin.run_frame(frame);
        double worst = 0;
        for (std::size_t i = 0; i < 81; ++i)
            worst = std::max(worst, std::abs(height(twin, 0, i) - 0.02 * scene.cloths[0].particle_thickness[i]));
        std::printf("[ measured ] farthest from the map's height: %.2e m\n", worst);
        EXPECT_LT(worst, 1e-6);
    }
}

/// Layers keep the mean of their thicknesses, the upper one's from its map; nearer than 0.98 of it they are led apart.
TEST(ContactRestTest, ASheetLiesOnAnotherAsHighAsItsMapOfThicknessSays) {
    SceneDescription scene = wedge(0.02);
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[0].particle_thickness.clear();
    scene.cloths[1].name = "upper";
    scene.cloths[1].placement.origin[1] = 0.045;
    scene.cloths[1].self_collision.emplace();
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 90; ++frame) twin.run_frame(frame);
    double least = 2, most = 0;
    for (std::size_t i = 0; i < 81; ++i) {
        const double kept = 0.01 * (1 + double(scene.cloths[1].particle_thickness[i]));
        const double ratio = (height(twin, 1, i) - height(twin, 0, i)) / kept;
        least = std::min(least, ratio);
        most = std::max(most, ratio);
    }
    std::printf("[ measured ] distances are %.4f to %.4f of what the map says\n", least, most);
    EXPECT_GT(least, 0.97);
    EXPECT_LT(most, 1.01);
}

/// Velocities of particles, m/s.
struct Speeds {
    double rms, most;
};

/// Returns those at a frame's end, as the statistics state them, or, without `excess`, the mean ones of its last
/// substep.
Speeds speeds_of(const Twin& twin, const SimulationModel& model, float excess = 1) {
    double most = 0, sum = 0;
    std::size_t count = 0;
    for (std::size_t k = 0; k < model.cloths.size(); ++k)
        for (std::size_t i = 0; i < model.cloths[k].grid.particle_count(); ++i) {
            const glsl::vec4 &d = twin.cloth(k)[Field::displacement][i], &e = twin.cloth(k)[Field::end_excess][i];
            const double moved =
                std::hypot(double(d.x + excess * e.x), double(d.y + excess * e.y), double(d.z + excess * e.z));
            most = std::max(most, moved);
            sum += moved * moved;
            ++count;
        }
    const double per_second = model.scene.solver.substeps * model.scene.time.fps;
    return {std::sqrt(sum / static_cast<double>(count)) * per_second, most * per_second};
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

/// By `explicit` a flap that sticks out swings on under the cloth's damping alone, 1/s, so that its speed halves in 1.4
/// s and more: after 5 s five of eight draws are below the bounds.
TEST_P(ContactRestTest, ComesToRestAndCreepsNoMore) {
    std::mt19937 random(GetParam().seed);
    const SceneDescription scene = scene_of(GetParam(), random);
    const SimulationModel model(scene);
    Twin twin(model);
    std::vector<std::vector<glsl::vec4>> a_second_before;
    for (std::uint32_t frame = 1; frame <= 60 * GetParam().seconds; ++frame) {
        twin.run_frame(frame);
        if (frame + 60 != 60 * GetParam().seconds) continue;
        for (std::size_t k = 0; k < model.cloths.size(); ++k) a_second_before.push_back(twin.cloth(k)[Field::position]);
    }
    const auto [speed, fastest] = speeds_of(twin, model);
    const double creep = farthest_moved(a_second_before, twin);
    std::printf("[ measured ] %.3f mm/s RMS, %.3f at most, %.4f mm in the last second\n", 1e3 * speed, 1e3 * fastest,
                1e3 * creep);
    // A hundredth of the motion's limit (4 mm/s for 40 cm), under which a run by `auto` sleeps, is 40 um/s.
    EXPECT_LT(speed, 1e-4);
    EXPECT_LT(fastest, 4e-4);
    EXPECT_LT(creep, 1e-5);
    EXPECT_GT(twin.contact().record.most_touching, 0u);
}

INSTANTIATE_TEST_SUITE_P(Of, ContactRestTest,
                         testing::Values(Falling{"heap_by_line", "line", 1, 20, 9},
                                         Falling{"heap_by_relax", "relax", 1, 20, 9},
                                         Falling{"heap_by_explicit", "explicit", 1, 64, 9, 8},
                                         Falling{"another_by_explicit", "explicit", 1, 64, 9, 8, 1},
                                         Falling{"pile_by_line", "line", 4, 20, 6}),
                         [](const auto& which) { return which.param.name; });

/// Sheets lie on a floor, each a little beside the one below: stairs, or a pile.
SceneDescription lying(SolverMethod method, std::uint32_t substeps, int sheets, double beside) {
    SceneDescription scene = test::sheet(5, 5, 0.2, 0.2, substeps);
    scene.solver.method = method;
    scene.colliders.push_back({Plane{}, 0.6});
    Cloth sheet = scene.cloths[0];
    sheet.pins.clear();
    sheet.damping = 2;
    sheet.thickness = 0.006;
    sheet.friction = 0.5;
    sheet.stiffness = {false, 1000, 100, 2e-5};
    sheet.self_collision.emplace();
    scene.cloths.clear();
    for (int k = 0; k < sheets; ++k) {
        sheet.name = "sheet" + std::to_string(k);
        sheet.placement = {{beside * k, 0.006 + 0.007 * k, beside * k}, {1, 0, 0}, {0, 0, 1}};
        scene.cloths.push_back(sheet);
    }
    return scene;
}

class RestingSpeed : public testing::TestWithParam<SolverMethod> {};

/// What lies on cloth does not fall, by its stated velocity, at g h/2 for ever, however long substeps are.
TEST_P(RestingSpeed, OfLayersIsThatOfTheirMotionAtAnyNumberOfSubsteps) {
    for (const std::uint32_t substeps : {4u, 10u, 40u})
        for (const int sheets : {2, 4}) {
            const SimulationModel model(lying(GetParam(), substeps, sheets, 0.011));
            Twin twin(model);
            for (std::uint32_t frame = 1; frame <= 75; ++frame) twin.run_frame(frame);
            const double speed = speeds_of(twin, model).most, moves = speeds_of(twin, model, 0).most;
            std::printf("[ measured ] %d sheets, %u substeps: %.1e m/s, moves at %.1e m/s\n", sheets, substeps, speed,
                        moves);
            EXPECT_GT(twin.contact().record.most_touching, 0u);
            EXPECT_LT(speed, 1e-4 + 2 * moves);
            EXPECT_LT(sheets == 2 ? speed : 0, 5e-5);
        }
}

/// Layers at rest stay there when substeps change: their state has no velocity and no acceleration to carry over.
TEST_P(RestingSpeed, OfLayersStaysNothingWhenSubstepsChange) {
    const SimulationModel model(lying(GetParam(), 10, 3, 0.011)), finer(lying(GetParam(), 24, 3, 0.011)),
        coarser(lying(GetParam(), 6, 3, 0.011));
    Twin twin(model);
    std::uint32_t frame = 1;
    for (; frame <= 90; ++frame) twin.run_frame(frame);
    double most = 0;
    for (const SimulationModel* run : {&finer, &coarser, &model, &coarser, &finer}) {
        twin.change_substep(*run);
        for (int k = 0; k < 3; ++k) {
            twin.run_frame(frame++);
            most = std::max(most, speeds_of(twin, *run).most);
        }
    }
    std::printf("[ measured ] at most %.1e m/s\n", most);
    EXPECT_LT(most, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Methods, RestingSpeed,
                         testing::Values(SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps));

/// Returns how fast (m/s) a cloth slides after half a second down another that is held everywhere, from rest.
double sliding_speed(double friction, double degrees) {
    const double angle = degrees * 0.017453292519943295;
    const std::string meets = R"("thickness": 0.01, "self_collision": {"friction": )" + std::to_string(friction) + "}";
    const SimulationModel model(parse_scene(
        R"({"time": {"frames": 31}, "gravity": [)" + std::to_string(9.81 * std::sin(angle)) + ", " +
        std::to_string(-9.81 * std::cos(angle)) + R"(, 0], "solver": {"method": "line", "substeps": 20}, "cloths": [
        {"name": "held", "grid": [17, 7], "size": [0.8, 0.3], "pins": [{"box": [[0, 0], [16, 6]]}],
         "placement": {"v": [0, 0, -1]}, )" +
        meets + R"(}, {"name": "free", "grid": [5, 5], "size": [0.16, 0.16],
         "placement": {"origin": [0.11, 0.01005, -0.05], "v": [0, 0, -1]}, )" +
        meets + "}]}"));
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 30; ++frame) twin.run_frame(frame);
    double sum = 0;
    for (const glsl::vec4& moved : twin.cloth(1)[Field::displacement]) sum += double(moved.x);
    return sum / 25 * model.scene.solver.substeps * model.scene.time.fps;
}

TEST(ContactFrictionTest, ClothOnTiltedClothSticksOrSlidesByCoulombsLaw) {
    // The tangent of 30.96 degrees is 0.6.
    EXPECT_NEAR(sliding_speed(0.6, 30.9), 0, 1e-4);
    EXPECT_NEAR(sliding_speed(0.5, 20), 0, 1e-4);
    const auto by_closed_form = [](double friction, double degrees) {
        const double angle = degrees * 0.017453292519943295;
        return 0.5 * 9.81 * (std::sin(angle) - friction * std::cos(angle));
    };
    EXPECT_NEAR(sliding_speed(0.5, 30), by_closed_form(0.5, 30), 0.01 * by_closed_form(0.5, 30));
    EXPECT_NEAR(sliding_speed(0.1, 10), by_closed_form(0.1, 10), 0.01 * by_closed_form(0.1, 10));
}

}  // namespace
}  // namespace drape
