// The figures of cloth/step_flops.h are those that the shaders' functions have on a type that counts.
#include "cloth/step_flops.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "cloth/frame_steps.h"
#include "support/sheets.h"

namespace drape::counting {

int operation_count = 0;

struct Counted {
    float value;
    Counted() = default;
    constexpr Counted(double number) : value(static_cast<float>(number)) {}
};

Counted count(double result) {
    ++operation_count;
    return result;
}
inline Counted operator+(Counted a, Counted b) { return count(double(a.value) + b.value); }
inline Counted operator-(Counted a, Counted b) { return count(double(a.value) - b.value); }
inline Counted operator*(Counted a, Counted b) { return count(double(a.value) * b.value); }
inline Counted operator/(Counted a, Counted b) { return count(double(a.value) / b.value); }
inline Counted operator-(Counted a) { return -double(a.value); }  // a sign is no operation
inline bool operator>(Counted a, Counted b) { return a.value > b.value; }
inline bool operator<(Counted a, Counted b) { return a.value < b.value; }
inline bool operator!=(Counted a, Counted b) { return a.value != b.value; }
inline Counted sqrt(Counted a) { return count(std::sqrt(double(a.value))); }
inline Counted abs(Counted a) { return std::fabs(a.value); }
inline std::uint32_t floatBitsToUint(Counted a) { return std::bit_cast<std::uint32_t>(a); }

using uint = std::uint32_t;
using glsl::ivec2;
using glsl::ivec4;
struct vec2 {
    Counted x, y;
};
struct vec3 {
    Counted x, y, z;
};
struct vec4 {
    Counted x, y, z, w;
};
inline vec3 operator+(vec3 a, vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline vec3 operator-(vec3 a, vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline vec3 operator*(vec3 a, Counted s) { return {a.x * s, a.y * s, a.z * s}; }
inline vec3 operator/(vec3 a, Counted s) { return {a.x / s, a.y / s, a.z / s}; }

const Counted line_violation_limit(glsl::line_violation_limit);
const auto line_hold_count = glsl::line_hold_count, line_hold_start = glsl::line_hold_start;

#define float Counted
#include "include/bdf2.h"
#include "include/explicit.h"
#include "include/line.h"
#include "include/spring.h"
#include "include/vector.h"
#include "include/verlet.h"
#undef float

template <class Work>
int operations(const Work& work) {
    operation_count = 0;
    work();
    return operation_count;
}

const vec3 a{.1, .2, .3}, b{.4, .1, .7}, c{.01, .02, -.01};
const vec4 reduced{.1, .2, .3, .4};
const Counted w{1.0}, s{.5};
constexpr int vector = 3;  // an operation on vectors

int compensated() {
    return operations([] { compensated_add(a, b, c); });
}
/// Every prediction ends with these operations.
int stepped() {
    return operations([] { dragged_increment(a, drag_loss(s, w, s)); }) + compensated();
}

TEST(StepFlops, OfPredictionsAreCounted) {
    EXPECT_EQ(kernel_flops.advance, compensated());
    EXPECT_EQ(kernel_flops.force, compensated() + operations([] { verlet_increment(a, b, c, w, s, s); }) + stepped());
    EXPECT_EQ(kernel_flops.predict, compensated() + stepped() + operations([] {
                                        bdf2_increment(a, b, velocity_excess(a, b), c, forced_step(a, b, w, s), s, s,
                                                       s);
                                        bdf2_drag(s);
                                    }));
    EXPECT_EQ(kernel_flops.explicit_particle,
              compensated() + operations([] { explicit_increment(a, b, c, a, w, s, s); }) + stepped());
}

TEST(StepFlops, OfSpringsAreCounted) {
    const int closing = vector, share = 1, other_end = vector;
    EXPECT_EQ(kernel_flops.explicit_spring, closing + share + other_end + operations([] {
                                                add_pull(a, spring_pull(spring_edge(a, b, c, c), c, w, s, s, s));
                                            }));
    EXPECT_EQ(kernel_flops.spring, operations([] {
                  const Counted first = dragged_weight(w, s), second = dragged_weight(w, s);
                  const SpringResult result = project_spring(spring_edge(a, b, c, c), first + second, s, w, s, s, s);
                  moved_by(a, result.correction, first);
                  moved_by(b, result.correction, second);
              }));
}

TEST(StepFlops, OfLinesAreCounted) {
    const LineSpring spring{{.6, .8, 0}, .9, .1};
    EXPECT_EQ(
        kernel_flops.line_tension, operations([&] {
            const Counted per_length = tension_per_length(tension_in_use(s, s), a - b, w);
            eliminate_particle({reduced, s}, a, s, spring_edge(a, b, c, c), geometric_stiffness(per_length, w, s), w);
            moved_by(a, substitute_particle(reduced, a), w);
            filtered_tension(per_length, spring);
        }));
    EXPECT_EQ(kernel_flops.line_spring, operations([&] {
                  line_spring(spring_edge(a, b, c, c), w);
                  eliminate_spring({.1, .2}, a, spring, b, dragged_weight(w, s), w, w, s, s, s);
                  substitute_spring({.1, .2}, s);
                  moved_by_both(a, b, line_correction(a, s, b, s), w);
                  stored_tension(changed_tension(s, s, s, s), s);
              }));
}

TEST(StepFlops, AreThoseOfAllParticlesAndSprings) {
    SceneDescription scene = test::sheet(5, 4, 1, 1, 2);
    const auto frame_flops = [&](SolverMethod method) {
        scene.solver.method = method;
        const SimulationModel model(scene);
        double sum = 0;
        for (const Step& step : frame_steps(model)) sum += step_flops(step, model.cloths[0]);
        return sum;
    };
    const double particles = 20, springs = 4 * 4 + 5 * 3 + 2 * 4 * 3;
    const KernelFlops& k = kernel_flops;
    EXPECT_EQ(frame_flops(SolverMethod::explicit_steps),
              2 * (particles * k.explicit_particle + springs * k.explicit_spring));
    EXPECT_EQ(frame_flops(SolverMethod::relax), 2 * (particles * k.force + springs * k.spring));
    EXPECT_EQ(frame_flops(SolverMethod::line), 2 * particles * (k.predict + 4 * (k.line_tension + k.line_spring)));
}

}  // namespace drape::counting
