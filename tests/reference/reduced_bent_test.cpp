// Cyclic reduction of lines that bend (shaders/include/cyclic_bent.h) agrees with elimination in double precision, and
// moves a sheet as the lines that are walked do.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "cloth/kernel_steps.h"
#include "shared/cyclic_types.h"
#include "support/sheet_state.h"
#include "support/sheets.h"
#include "twin/reduced_system.h"
#include "twin/twin.h"

namespace drape {
namespace {

using namespace glsl;

/// A line whose edges point along x.
struct BendingLine {
    std::vector<BentSpring> springs;
    std::vector<float> weights;
    float bend;

    BentSpring spring(std::size_t e) const { return e < springs.size() ? springs[e] : BentSpring({0, 0, 0}, 0, 0); }
    std::vector<vec3> reduced_changes() const {
        std::vector<BentRow> rows;  // places before the first spring wrap around to beyond the last
        for (std::size_t p = 0; p < weights.size(); ++p)
            rows.push_back(bent_row(spring(p - 2), spring(p - 1), spring(p), spring(p + 1),
                                    BentTargets({0, 0, 0}, {0, 0, 0}, {0, 0, 0}), bend, weights[p], p % 2 != 0));
        return reduced(rows);
    }
    std::vector<double> exact_changes() const;
};

/// Five diagonals in double precision, eliminated from the first row on.
struct Pentadiagonal {
    std::vector<std::array<double, 5>> rows;
    std::vector<double> right;

    explicit Pentadiagonal(std::size_t count) : rows(count), right(count) {
        for (auto& row : rows) row[2] = 1;
    }
    /// An element of so many particles from `first` on, which resists the sum of `coefficients` times what they are at.
    template <std::size_t count>
    void add(const std::vector<float>& weights, std::size_t first, const std::array<double, count>& coefficients,
             double stiffness, double start) {
        for (std::size_t i = 0; i < count; ++i) {
            const double pull = stiffness * double(weights[first + i]) * coefficients[i];
            for (std::size_t j = 0; j < count; ++j) rows[first + i][2 + j - i] += pull * coefficients[j];
            right[first + i] -= pull * start;
        }
    }
    std::vector<double> solution() {
        const std::size_t count = right.size();
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = i + 1; j < std::min(i + 3, count); ++j) {
                const double factor = rows[j][2 + i - j] / rows[i][2];
                for (std::size_t k = i; k < std::min(i + 3, count); ++k)
                    rows[j][2 + k - j] -= factor * rows[i][2 + k - i];
                right[j] -= factor * right[i];
            }
        for (std::size_t i = count; i-- > 0;) {
            for (std::size_t k = i + 1; k < std::min(i + 3, count); ++k) right[i] -= rows[i][2 + k - i] * right[k];
            right[i] /= rows[i][2];
        }
        return right;
    }
};

std::vector<double> BendingLine::exact_changes() const {
    Pentadiagonal system(weights.size());
    for (std::size_t e = 0; e < springs.size(); ++e)
        system.add(weights, e, std::array{-1.0, 1.0}, double(springs[e].stiffness), double(springs[e].edge.x));
    for (std::size_t e = 1; e < springs.size(); ++e)
        system.add(weights, e - 1, std::array{1.0, -2.0, 1.0},
                   double(element_bend(bend, springs[e - 1].share, springs[e].share)),
                   double(springs[e].edge.x) - double(springs[e - 1].edge.x));
    return system.solution();
}

struct ReducedBentLine : testing::TestWithParam<std::size_t> {
    std::mt19937 random{17};
    float between(float least, float most) { return std::uniform_real_distribution<float>(least, most)(random); }

    /// A line of springs of length 1 in which no two are alike; every seventh particle is held and every thirteenth
    /// spring missing, or none.
    BendingLine line(float stiffness, float bend, bool broken) {
        BendingLine line;
        line.bend = bend;
        for (std::size_t p = 0; p < GetParam(); ++p) {
            line.weights.push_back(broken && p % 7 == 3 ? 0.0f : between(0.9f, 1.1f));
            if (p + 1 == GetParam()) break;
            const bool is_missing = broken && p % 13 == 5;
            line.springs.push_back({{between(0.9f, 1.1f), 0, 0},
                                    is_missing ? 0 : stiffness * between(0.9f, 1.1f),
                                    is_missing ? 0 : between(0.4f, 1)});
        }
        return line;
    }
};

/// The pulls are rounded, of a spring's tension and of an element, by an ULP of each. Where three particles hang
/// together alone, the two rows of a block are nearly one, which costs the stiffest their digits once more.
TEST_P(ReducedBentLine, IsAsExactAsThePullsAreRounded) {
    constexpr float half_ulp = 6e-8f;
    for (const float bend : {1e-5f, 1e-3f, 0.1f, 1.0f, 10.0f, cyclic_most_bend})
        for (const float stiffness : {0.0f, 1.0f, 1e3f, 1e6f})
            for (const bool broken : {false, true}) {
                double error = 0;
                for (int sample = 0; sample < 20; ++sample) {
                    const BendingLine line = this->line(stiffness, bend, broken);
                    const std::vector<double> exact = line.exact_changes();
                    const std::vector<vec3> found = line.reduced_changes();
                    for (std::size_t p = 0; p < exact.size(); ++p)
                        error = std::max(error, std::abs(double(found[p].x) - exact[p]));
                }
                EXPECT_LT(error, half_ulp * (1 + stiffness + bend) * (6 + bend / 3))
                    << "bend " << bend << ", stiffness " << stiffness << ", broken " << broken;
            }
}

// One block, one particle more or less, whole powers of two and one beside them, and the longest that a workgroup
// takes.
INSTANTIATE_TEST_SUITE_P(Lines, ReducedBentLine, testing::Values(2, 3, 4, 5, 7, 31, 32, 33, 257, 896));

class ReducedBentSheet : public testing::TestWithParam<double> {};

TEST_P(ReducedBentSheet, MovesAsWalkedLinesDoUpToRounding) {
    SceneDescription scene = test::sheet(49, 48, 1, 1, 6);
    scene.solver.method = SolverMethod::line;
    scene.cloths[0].stiffness.bend = GetParam();
    scene.cloths[0].placement.v = {0, 0, 1};
    scene.cloths[0].pins = {test::pin_box(0, 0, 0, 0), test::pin_box(48, 0, 48, 0)};
    const SimulationModel model(scene);
    for (const Step& step : kernel_steps(model, cyclic_kernels))
        ASSERT_EQ(step.kernel == Kernel::line_cyclic, step.kind == StepKind::line);
    Twin walked(model), reduced(model, cyclic_kernels);
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

INSTANTIATE_TEST_SUITE_P(Bends, ReducedBentSheet, testing::Values(1e-5, 1e-3, 0.1));

}  // namespace
}  // namespace drape
