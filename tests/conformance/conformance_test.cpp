// The steps of a frame, one pass at a time from the twin's states, are on any device what the twin's are, as near as
// the arithmetic of Vulkan promises (step_bounds.h).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

#include "cloth/kernel_steps.h"
#include "gpu_test.h"
#include "scenes.h"
#include "single_steps.h"
#include "solver/kernel_choice.h"
#include "solver/step_row.h"
#include "step_bounds.h"
#include "support/twin_with_cuts.h"
#include "vulkan/error.h"

namespace drape {
namespace {

using test::conformance_scenes;
using test::Difference;
using test::FieldPair;
using test::StepBound;

/// A scene, and the kernel that its steps have beside the plain ones.
struct Case {
    const test::ConformanceScene* scene;
    KernelName kernel;
};

void PrintTo(const Case& each, std::ostream* out) { *out << each.scene->name << " with " << each.kernel.name; }

/// Returns every scene with every kernel that has a part in it.
std::vector<Case> all_cases() {
    std::vector<Case> all;
    for (const test::ConformanceScene& scene : conformance_scenes()) {
        const SimulationModel model(scene.scene);
        for (const KernelName& kernel : kernel_names)
            if (kernel.kernel == Kernel::plain || used_kernels(model, {kernel.kernel}).has(kernel.kernel))
                all.push_back({&scene, kernel});
    }
    return all;
}

const StepBound& bound_of(const Step& step) { return test::step_bounds()[static_cast<std::size_t>(step.kind)]; }

std::string shader_of(const Step& step) {
    const StepRow& row = step_rows()[static_cast<std::size_t>(step.kind)];
    return std::string(std::ranges::find(row.kernels, step.kernel, &KernelRow::kernel)->shader);
}

/// Judges all that steps wrote and keeps what is farthest off, by shader and field.
class Judge {
  public:
    /// `exact`: the device rounds as C++ does.
    Judge(const SimulationModel& model, bool exact) : exact_(exact) {
        for (const ClothModel& cloth : model.cloths)
            longest_ = std::max({longest_, cloth.grid.columns(), cloth.grid.rows()});
    }

    void judge(const std::vector<Step>& steps, const std::vector<FieldPair>& fields) {
        const Step& step = steps.back();
        const StepBound& bound = bound_of(step);
        double units = 0;
        for (const Step& each : steps)
            if (!exact_) units += bound_of(each).units_of(each, longest_);
        std::size_t count = 0;
        for (const FieldPair& pair : fields) {
            const Difference difference = difference_of(pair, units);
            count += difference.count;
            const std::string where = shader_of(step) + " " + pair.name;
            double& most = most_[where];
            most = std::max(most, difference.units);
            const double turned = exact_ ? 0 : bound.may_turn(pair);
            if (static_cast<double>(difference.beyond) > turned)
                ADD_FAILURE() << fmt::format(
                    "{} in substep {}, iteration {}: {} of {} are off by more than {} units, the farthest by {}", where,
                    step.substep, step.iteration, difference.beyond, difference.count, units, difference.units);
        }
        counts_[step.kind] += count;
    }

    /// Every step was judged by something.
    void expect_all_judged() const {
        for (const auto& [kind, count] : counts_)
            EXPECT_TRUE(count > 0 || test::step_bounds()[static_cast<std::size_t>(kind)].is_judged_later())
                << step_rows()[static_cast<std::size_t>(kind)].kernels.front().shader;
    }
    void record() const {
        for (const auto& [where, units] : most_)
            if (units > 0) testing::Test::RecordProperty(where, fmt::format("{:.3g}", units));
    }

  private:
    bool exact_;
    std::uint32_t longest_ = 0;
    std::map<std::string, double> most_;
    std::map<StepKind, std::size_t> counts_;
};

class Conformance : public testing::TestWithParam<Case> {};

TEST_P(Conformance, EveryStep) {
    const auto& [scene, kernel] = GetParam();
    const vulkan::Device& device = test::gpu().device;
    Kernels kernels{kernel.kernel};
    kernels.group.subgroup = device.capabilities().subgroup;
    test::TwinWithCuts twin(scene->scene, kernels);
    Judge judge(twin.model(), device_kind(device.info()) == DeviceKind::cpu);
    for (std::uint32_t frame = 0; frame <= scene->lead; ++frame) twin.run_frame(frame);
    try {
        test::SingleSteps steps(device, twin.model(), kernels, twin.twin());
        steps.run_frame(scene->lead + 1, [&](const auto& taken, const auto& fields) { judge.judge(taken, fields); });
    } catch (const vulkan::VulkanError& error) {
        GTEST_SKIP() << error.what();
    }
    judge.expect_all_judged();
    judge.record();
}

INSTANTIATE_TEST_SUITE_P(From, Conformance, testing::ValuesIn(all_cases()), [](const auto& about) {
    return about.param.scene->name + "_" + std::string(about.param.kernel.name);
});

TEST(ConformanceScenes, HaveEveryShaderOfEveryKindOfStep) {
    std::set<std::string> shaders;
    for (const Case& each : all_cases())
        for (const Step& step : kernel_steps(SimulationModel(each.scene->scene), {each.kernel.kernel}))
            shaders.insert(shader_of(step));
    // Bodies write the colliders that later steps read, where single steps read what the host wrote: twin_bodies_test
    // compares whole frames of theirs.
    const std::set<std::string_view> compared_elsewhere{"body_meet.comp", "body_move.comp", "body_strike.comp"};
    for (const StepRow& row : step_rows())
        for (const KernelRow& kernel : row.kernels)
            EXPECT_NE(shaders.contains(std::string(kernel.shader)), compared_elsewhere.contains(kernel.shader))
                << kernel.shader;
}

TEST(StepBounds, AreByKindAndHaveAReason) {
    ASSERT_EQ(test::step_bounds().size(), step_rows().size());
    for (std::size_t k = 0; k < step_rows().size(); ++k) {
        EXPECT_EQ(test::step_bounds()[k].kind, step_rows()[k].kind) << step_rows()[k].kernels.front().shader;
        EXPECT_NE(test::step_bounds()[k].reason, "");
    }
}

TEST(StepBounds, CountUnitsOfTheLargestNumber) {
    const auto of = [](float device, float twin, double least_scale, double units) {
        return difference_of(FieldPair{"", {1, device}, {1, twin}, {}, {}, least_scale}, units);
    };
    EXPECT_EQ(of(0.5f, 0.5f, 0, 0).beyond, 0u);
    EXPECT_EQ(of(-0.0f, 0, 0, 0).beyond, 0u);
    EXPECT_EQ(of(0.5f + 0x1p-23f, 0.5f, 0, 0.5).beyond, 1u);
    EXPECT_EQ(of(0.5f + 0x1p-23f, 0.5f, 0, 1).beyond, 0u);
    EXPECT_EQ(of(0.5f + 0x1p-23f, 0.5f, 2, 0).units, 0.5);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(of(nan, 0.5f, 0, 1e6).beyond, 1u);
    EXPECT_EQ(difference_of(FieldPair{"", {}, {}, {1, 2}, {1, 3}}, 1e6).beyond, 1u);
}

}  // namespace
}  // namespace drape
