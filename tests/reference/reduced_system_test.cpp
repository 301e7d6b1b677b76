// Cyclic reduction of the lines' two systems (shaders/include/cyclic.h) agrees with elimination in double precision,
// and with the lines that are walked.
#include "twin/reduced_system.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "cloth/cyclic_lines.h"
#include "cloth/kernel_steps.h"
#include "support/sheet_state.h"
#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

using namespace glsl;

/// A tridiagonal system in double precision; `below` and `above` the diagonal are subtracted.
struct DoubleSystem {
    std::vector<double> diagonal, below, above, right;

    std::vector<double> solution() const {
        const std::size_t count = diagonal.size();
        std::vector<double> upper(count), value(count);
        for (std::size_t i = 0; i < count; ++i) {
            const double pivot = diagonal[i] - (i > 0 ? below[i] * upper[i - 1] : 0);
            upper[i] = above[i] / pivot;
            value[i] = (right[i] + (i > 0 ? below[i] * value[i - 1] : 0)) / pivot;
        }
        for (std::size_t i = count - 1; i-- > 0;) value[i] += upper[i] * value[i + 1];
        return value;
    }
};

/// Returns the largest error of x components, over the largest component.
double relative_error(const std::vector<vec3>& found, const DoubleSystem& exact) {
    const std::vector<double> expected = exact.solution();
    double error = 0, largest = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        error = std::max(error, std::abs(found[i].x - expected[i]));
        largest = std::max(largest, std::abs(expected[i]));
    }
    return error / largest;
}

struct ReducedSystem : testing::TestWithParam<std::size_t> {
    std::mt19937 random{17};
    float between(float least, float most) { return std::uniform_real_distribution<float>(least, most)(random); }
};

/// The first system of a line whose springs have up to `stiffest`, with every seventh particle held or all free.
struct TensionSystem {
    std::vector<CyclicRow> rows;
    std::vector<EliminatedParticle> eliminated;
    DoubleSystem exact;

    TensionSystem(ReducedSystem& test, std::size_t count, float stiffest, bool held) {
        vec3 edge_before{0, 0, 0};
        float before = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const bool is_last = i + 1 == count;
            const float after = is_last ? 0 : stiffest * test.between(0.9f, 1.1f);
            const float weight = held && i % 7 == 3 ? 0.0f : test.between(0.9f, 1.1f);
            const vec3 edge{is_last ? 0 : test.between(0.9f, 1.1f), 0, 0};
            rows.push_back(particle_row(edge_before, before, edge, after, weight));
            eliminated.push_back(eliminate_particle(i > 0 ? eliminated.back() : unmoved_start(), edge_before, before,
                                                    edge, after, weight));
            exact.below.push_back(double(weight) * before);
            exact.above.push_back(double(weight) * after);
            exact.diagonal.push_back(1 + exact.below.back() + exact.above.back());
            exact.right.push_back(exact.above.back() * edge.x - exact.below.back() * edge_before.x);
            edge_before = edge;
            before = after;
        }
    }
    std::vector<vec3> walked() const {
        std::vector<vec3> solution(eliminated.size());
        vec3 after{0, 0, 0};
        for (std::size_t i = solution.size(); i-- > 0;)
            after = solution[i] = substitute_particle(eliminated[i].row, after);
        return solution;
    }
};

using Rows = std::vector<CyclicRow>;
/// An invocation per row, and in parts, by subgroups of the default device and of GPUs.
constexpr std::array<std::vector<vec3> (*)(const Rows&), 3> solutions{
    [](const Rows& rows) { return reduced(rows); }, [](const Rows& rows) { return reduced_in_parts(rows, 8); },
    [](const Rows& rows) { return reduced_in_parts(rows, 32); }};

/// The springs' pull is rounded, which all ways begin with, so neither has more digits than it leaves.
TEST_P(ReducedSystem, OfTensionIsAsExactAsALineThatIsWalked) {
    for (const float stiffest : {1e-3f, 1.0f, 1e3f, 1e6f})
        for (const bool held : {false, true}) {
            double walked = 0;
            std::array<double, solutions.size()> errors{};
            for (int sample = 0; sample < 20; ++sample) {
                const TensionSystem system(*this, GetParam(), stiffest, held);
                walked = std::max(walked, relative_error(system.walked(), system.exact));
                for (std::size_t k = 0; k < solutions.size(); ++k)
                    errors[k] = std::max(errors[k], relative_error(solutions[k](system.rows), system.exact));
            }
            for (const double error : errors)
                EXPECT_LT(error, 3 * walked + 3e-7) << "stiffness " << stiffest << ", held " << held;
        }
}

/// The rows of springs are spring_row's, and the same system is eliminate_spring's in double precision.
TEST_P(ReducedSystem, OfSpringsIsWhatIsEliminatedInDoublePrecision) {
    for (const float compliance : {1e-4f, 1e-2f, 1.0f}) {
        const std::size_t count = GetParam();
        std::vector<LineSpring> springs;
        std::vector<float> weights, shares;
        for (std::size_t e = 0; e <= count; ++e) {
            const vec3 edge{0.01f, between(-0.004f, 0.004f), between(-0.004f, 0.004f)};
            springs.push_back(line_spring(edge, 0.0105f));
            weights.push_back(e % 9 == 2 ? 0.0f : between(0.5f, 2));
            shares.push_back(e % 11 == 5 ? 0.0f : between(0.4f, 1));
        }
        std::vector<CyclicRow> rows;
        DoubleSystem exact;
        const vec3 none{0, 0, 0};
        constexpr double compression = 0.3;
        for (std::size_t e = 0; e < count; ++e) {
            const vec3 before = e > 0 ? springs[e - 1].normal : none,
                       after = e + 1 < count ? springs[e + 1].normal : none;
            rows.push_back(spring_row(before, springs[e], after, weights[e], weights[e + 1], shares[e],
                                      float(compression), compliance, 1e-3f));
            const auto dot = [](vec3 a, vec3 b) { return double(a.x) * b.x + double(a.y) * b.y + double(a.z) * b.z; };
            const bool pushed = springs[e].excess<0, there = shares[e]> 0;
            const double acting = shares[e] * (pushed ? compression : 1);
            const double balance = springs[e].excess * (pushed ? compression : 1);
            exact.below.push_back(there ? acting * weights[e] * dot(before, springs[e].normal) : 0);
            exact.above.push_back(there ? acting * weights[e + 1] * dot(springs[e].normal, after) : 0);
            exact.diagonal.push_back(there ? acting * (double(weights[e]) + weights[e + 1]) + compliance : 1);
            exact.right.push_back(there ? -(shares[e] * (balance - 1e-3f)) : 0);
        }
        for (const auto& solved : solutions)
            EXPECT_LT(relative_error(solved(rows), exact), 2e-5) << "compliance " << compliance;
    }
}

// The lengths are one spring, whole powers of two and one beside them, and the longest that a workgroup takes.
INSTANTIATE_TEST_SUITE_P(Rows, ReducedSystem, testing::Values(2, 3, 4, 31, 32, 33, 257, 1024));

TEST(Parts, AreOfLinesThatAWorkgroupHoldsAndThatDoNotBend) {
    const auto longest = [](const GroupLimits& limits) {
        LinePush push{};
        push.particle_count = 1;
        while (can_part(push, limits)) ++push.particle_count;
        return push.particle_count - 1;
    };
    EXPECT_EQ(longest({}), 128);
    EXPECT_EQ(longest({1024, 32768, 32}), 2048);
    EXPECT_EQ(longest({1024, 16384, 32}), 1664);
    EXPECT_EQ(longest({128, 16384, 32}), 512);
    EXPECT_EQ(parts_group(1024, 32), 256u);
    EXPECT_EQ(parts_group(1025, 32), 288u);
    LinePush bending{};
    bending.particle_count = 64;
    bending.bend = 1e-6f;
    EXPECT_FALSE(can_part(bending, {}));
}

TEST(Parts, AreTakenForLongLines) {
    const auto kernel_of_rows = [](std::uint32_t columns, float bend) {
        SceneDescription scene = test::sheet(columns, 2, 1, 0.1, 1);
        scene.solver.method = SolverMethod::line;
        scene.cloths[0].stiffness.bend = bend;
        Kernels kernels{Kernel::line_parts, Kernel::line_cyclic};
        kernels.group.subgroup = 32;
        const auto steps = kernel_steps(SimulationModel(scene), kernels);
        return std::ranges::find_if(steps,
                                    [&](const Step& step) {
                                        return step.kind == StepKind::line &&
                                               step.push<LinePush>().particle_count == static_cast<int>(columns);
                                    })
            ->kernel;
    };
    EXPECT_EQ(kernel_of_rows(256, 0), Kernel::line_cyclic);
    EXPECT_EQ(kernel_of_rows(257, 0), Kernel::line_parts);
    EXPECT_EQ(kernel_of_rows(2048, 0), Kernel::line_parts);
    EXPECT_EQ(kernel_of_rows(2049, 0), Kernel::plain);
    EXPECT_EQ(kernel_of_rows(257, 1e-12f), Kernel::line_cyclic);
}

class ReducedLines : public testing::TestWithParam<KernelName> {};

TEST_P(ReducedLines, MoveASheetAsWalkedLinesDoUpToRounding) {
    SceneDescription scene = test::sheet(49, 49, 1, 1, 6);
    scene.solver.method = SolverMethod::line;
    scene.cloths[0].placement.v = {0, 0, 1};
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 0), test::pin_box(48, 0, 48, 0)};
    const SimulationModel model(scene);
    Twin walked(model), reduced(model, {GetParam().kernel});
    double distance = 0;
    for (std::uint32_t frame = 1; frame <= 12; ++frame) {
        walked.run_frame(frame);
        reduced.run_frame(frame);
        for (std::size_t i = 0; i < model.cloths[0].grid.particle_count(); ++i)
            distance = std::max(distance, test::distance(test::position_of(walked.cloth(0), i),
                                                         test::position_of(reduced.cloth(0), i)));
    }
    EXPECT_GT(distance, 0) << "nothing was reduced";
    EXPECT_LT(distance, 2e-5);
}

INSTANTIATE_TEST_SUITE_P(By, ReducedLines,
                         testing::Values(KernelName{"line_parts", Kernel::line_parts},
                                         KernelName{"line_cyclic", Kernel::line_cyclic}),
                         [](const auto& kernel) { return std::string(kernel.param.name); });

}  // namespace
}  // namespace drape
