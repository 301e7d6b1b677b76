// The native yardstick of `drape bench speed` does all the work of a frame: it equals the twin, bit for bit.
#include <gtest/gtest.h>

#include <cstring>

#include "cloth/texels.h"
#include "native/native_run.h"
#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

using glsl::vec3;

struct Run {
    const char* name;
    SolverMethod method;
    std::uint32_t columns, rows, substeps, iterations;
    double damping;
};

void PrintTo(const Run& run, std::ostream* out) { *out << run.name; }

/// The sheet is held by its top row and crumpled a little, so that no two springs are alike.
SceneDescription scene_of(const Run& run) {
    SceneDescription scene = test::sheet(run.columns, run.rows, 1.3, 0.9, run.substeps, run.iterations);
    scene.solver.method = run.method;
    scene.time.frame_count = 4;
    Cloth& cloth = scene.cloths[0];
    model_scenes::set_wave_speed(cloth, 20);
    cloth.placement.v = {0.1, -0.3, 0.8};
    cloth.velocity = {0.4, 0.2, -0.3};
    cloth.stiffness.compression = 0.6;
    cloth.damping = run.damping;
    cloth.pins = {test::pin_box(0, 0, 2, 0), test::pin_box(run.columns - 1, 0, run.columns - 1, 1)};
    return scene;
}

template <class T>
void expect_same_bits(const std::vector<T>& a, const std::vector<T>& b, const char* what) {
    ASSERT_EQ(a.size(), b.size()) << what;
    for (std::size_t i = 0; i < a.size(); ++i)
        ASSERT_EQ(std::memcmp(&a[i], &b[i], sizeof(T)), 0) << what << " of particle " << i;
}

std::vector<vec3> field_of(const TwinCloth& cloth, Field field) {
    std::vector<vec3> all;
    for (const glsl::vec4& value : cloth[field]) all.push_back(xyz(value));
    return all;
}

class NativeKernels : public testing::TestWithParam<Run> {
  protected:
    static void compare(const SceneDescription& scene, native::NativeWay way) {
        const SimulationModel model(scene);
        Twin twin(model);
        native::NativeRun run(model, way);
        for (std::uint32_t frame = 1; frame < 4; ++frame) {
            twin.run_frame(frame);
            run.run(1);
            for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) {
                SCOPED_TRACE(fmt::format("{} workers, {}, frame {}, cloth {}", way.worker_count,
                                         way.vectors ? "vectors" : "scalars", frame, cloth));
                TwinCloth& state = twin.cloth(cloth);
                expect_same_bits(run.positions(cloth), field_of(state, Field::position), "position");
                expect_same_bits(run.displacements(cloth), field_of(state, Field::displacement), "displacement");
                if (!model.cloths[cloth].scheme.line_scratch) continue;
                for (std::size_t direction = 0; direction < spring_directions.size(); ++direction)
                    expect_same_bits(run.tension(cloth, direction), state.tension(direction), "tension");
            }
        }
    }
};

TEST_P(NativeKernels, EqualTheTwinOnAnyNumberOfCores) {
    const SceneDescription scene = scene_of(GetParam());
    for (const int worker_count : {1, 2, 5}) compare(scene, {worker_count, true});
    compare(scene, {1, false});
}

TEST_P(NativeKernels, EqualTheTwinWithCloths) {
    SceneDescription scene = scene_of(GetParam());
    scene.cloths.push_back(scene.cloths[0]);
    scene.cloths[1].name = "other";
    scene.cloths[1].velocity = {-1, 0, 0.5};
    for (const int worker_count : {1, 2}) compare(scene, {worker_count, true});
}

INSTANTIATE_TEST_SUITE_P(Methods, NativeKernels,
                         testing::Values(Run{"explicit", SolverMethod::explicit_steps, 37, 29, 24, 1, 0.3},
                                         Run{"explicit_even", SolverMethod::explicit_steps, 16, 32, 24, 1, 0},
                                         Run{"line", SolverMethod::line, 37, 29, 6, 1, 0.3},
                                         Run{"line_tall", SolverMethod::line, 16, 40, 6, 2, 0},
                                         Run{"line_wide", SolverMethod::line, 50, 18, 12, 1, 2},
                                         Run{"relax", SolverMethod::relax, 37, 29, 6, 1, 0.3},
                                         Run{"relax_even", SolverMethod::relax, 16, 32, 6, 1, 0}),
                         testing::PrintToStringParamName());

TEST(NativeRun, RefusesWhatItHasNoKernelFor) {
    SceneDescription scene = scene_of({"", SolverMethod::relax, 8, 8, 2, 1, 0});
    EXPECT_NO_THROW(native::NativeRun(SimulationModel(scene), {}));
    const auto refused = [](SceneDescription other) {
        EXPECT_THROW(native::NativeRun(SimulationModel(other), {}), std::invalid_argument);
    };
    SceneDescription other = scene;
    other.solver.iterations = 2;
    refused(other);
    other = scene;
    other.cloths[0].stiffness.bend = 1e-4;
    refused(other);
    other = scene;
    other.wind.velocity = {1, 0, 0};
    refused(other);
    other = scene;
    other.cloths[0].holes = {{{2, 2}, {4, 4}}};
    refused(other);
}

}  // namespace
}  // namespace drape
