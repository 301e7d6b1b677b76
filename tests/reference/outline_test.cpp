// Cloth cut by an outline is the sheet that it is cut from: its elasticity is that of a disc in closed form, and it
// moves as the double-precision network does.
#include <gtest/gtest.h>

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>

#include "drape/scene_reader.h"
#include "reference/spring_network.h"
#include "reference/symplectic_reference.h"
#include "support/sheet_state.h"
#include "twin/twin.h"

namespace drape {
namespace {

constexpr double radius = 0.5;

SceneDescription disc(std::uint32_t across, const std::string& cloth = "", const std::string& rest = "") {
    return parse_scene(R"({"cloths": [{"outline": {"path": "M-.5 0A.5.5 0 0 0 .5 0A.5.5 0 0 0-.5 0Z", "spacing": )" +
                       std::to_string(1.0 / across) + "}" + cloth + "}]" + rest + "}");
}

/// Returns the mean radial displacement of the rim of a disc that turns at `omega` (1/s), m, by the linear equations of
/// its network in the frame that turns along.
double rim_displacement(const SpringNetwork& network, double omega, double density) {
    const std::size_t count = network.particle_count();
    std::vector<Eigen::Triplet<double>> entries;
    for (const NetworkSpring& spring : network.springs) {
        const Vec3 &a = network.rest_position[spring.first], &b = network.rest_position[spring.second];
        const double way[2] = {b[0] - a[0], b[1] - a[1]}, size = std::hypot(way[0], way[1]);
        EXPECT_NEAR(size, spring.rest_length, 1e-12) << "the flat disc is at rest";
        for (int i = 0; i < 2; ++i)
            for (int k = 0; k < 2; ++k) {
                const double stiffness = spring.stiffness * way[i] * way[k] / (size * size);
                const int p = 2 * static_cast<int>(spring.first) + i, q = 2 * static_cast<int>(spring.second) + i;
                const int r = 2 * static_cast<int>(spring.first) + k, s = 2 * static_cast<int>(spring.second) + k;
                entries.emplace_back(p, r, stiffness);
                entries.emplace_back(q, s, stiffness);
                entries.emplace_back(p, s, -stiffness);
                entries.emplace_back(q, r, -stiffness);
            }
    }
    Eigen::VectorXd force = Eigen::VectorXd::Zero(2 * static_cast<int>(count));
    for (std::size_t p = 0; p < count; ++p)
        for (int k = 0; k < 2; ++k) {
            const int row = 2 * static_cast<int>(p) + k;
            force[row] = network.mass[p] * omega * omega * network.rest_position[p][static_cast<std::size_t>(k)];
            entries.emplace_back(row, row,
                                 network.mass[p] > 0 ? 1e-6 : 1);  // holds what could turn or drift as a whole
        }
    Eigen::SparseMatrix<double> stiffness(2 * static_cast<int>(count), 2 * static_cast<int>(count));
    stiffness.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd moved = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(stiffness).solve(force);
    double sum = 0, on_rim = 0, mass = 0;
    for (std::size_t p = 0; p < count; ++p) {
        mass += network.mass[p];
        const double r = std::hypot(network.rest_position[p][0], network.rest_position[p][1]);
        if (network.mass[p] == 0 || r < radius * (1 - 1e-4)) continue;
        const int row = 2 * static_cast<int>(p);
        sum += (moved[row] * network.rest_position[p][0] + moved[row + 1] * network.rest_position[p][1]) / r;
        ++on_rim;
    }
    EXPECT_NEAR(mass, density * std::numbers::pi * radius * radius, 0.02 * mass);
    return sum / on_rim;
}

/// A disc of a sheet that is as stiff in every direction (stretch = 2 shear: Poisson's ratio 1/3) and turns has at its
/// rim u = (1 - nu) density omega^2 R^3/(4 E) (Timoshenko and Goodier, "Theory of Elasticity", 32), E the modulus of
/// the sheet, N/m: (stretch + shear)(1 - nu^2).
TEST(OutlineReference, ADiscThatTurnsGrowsByTheClosedForm) {
    constexpr double shear = 100, density = 0.2, omega = 3, poisson = 1.0 / 3;
    const double modulus = 3 * shear * (1 - poisson * poisson);
    const double expected = (1 - poisson) * density * omega * omega * radius * radius * radius / (4 * modulus);
    for (const std::uint32_t across : {16u, 32u, 33u, 64u, 128u}) {
        const SceneDescription scene =
            disc(across, R"(, "placement": {"v": [0, 1, 0]}, "stiffness": {"stretch": 200, "shear": 100})");
        const double grown = rim_displacement(SpringNetwork(scene, 0), omega, density);
        std::printf("[ measured ] %u cells across: the rim grows by %.3f %% more than the closed form\n", across,
                    100 * (grown / expected - 1));
        EXPECT_NEAR(grown / expected, 1, 0.2 / across) << across;
    }
}

constexpr SolverMethod all_methods[] = {SolverMethod::relax, SolverMethod::explicit_steps, SolverMethod::line};

/// A disc that hangs by two points of its rim, from a flat start: the network's motion is each method's limit.
TEST(OutlineReference, EveryMethodConvergesToTheNetworksMotion) {
    const std::string cloth =
        R"(, "placement": {"u": [1, 0, 0], "v": [0, 0, 1]}, "stiffness": {"stretch": 500, "shear": 100}, "damping": 1,
           "pins": [{"point": [-0.35, -0.36]}, {"point": [0.35, -0.36]}])";
    SceneDescription scene = disc(16, cloth);
    const SpringNetwork network(scene, 0);
    const std::uint32_t frames = 20;
    const double times[] = {frames / scene.time.fps};
    const NetworkState exact = run_symplectic(network, times).states.at(0);
    for (const SolverMethod method : all_methods) {
        double before = INFINITY;
        const std::uint32_t finest = method == SolverMethod::relax ? 1024 : 128;  // relaxation settles slowly
        for (const std::uint32_t substeps : {32u, finest}) {
            scene.solver.method = method;
            scene.solver.substeps = substeps;
            const SimulationModel model(scene);
            Twin twin(model);
            for (std::uint32_t frame = 1; frame <= frames; ++frame) twin.run_frame(frame);
            double squared = 0, count = 0;
            for (std::size_t p = 0; p < network.particle_count(); ++p) {
                if (network.mass[p] == 0) continue;
                const Vec3 at = test::position_of(twin.cloth(0), p);
                for (std::size_t k = 0; k < 3; ++k) squared += std::pow(at[k] - exact.position[p][k], 2);
                ++count;
            }
            const double error = std::sqrt(squared / count);
            std::printf("[ measured ] method %d, %u substeps: RMS error %.2e m\n", static_cast<int>(method), substeps,
                        error);
            EXPECT_LT(error, before / 2);
            before = error;
        }
        EXPECT_LT(before, method == SolverMethod::relax ? 5e-3 : 5e-4);
    }
}

/// Bending, too, is at rest in the flat disc, whatever its rim.
TEST(OutlineReference, AFlatDiscStaysFlat) {
    for (const SolverMethod method : all_methods) {
        SceneDescription scene =
            disc(24, R"(, "stiffness": {"stretch": 500, "shear": 100, "bend": 1e-3})", R"(, "gravity": [0, 0, 0])");
        scene.solver.method = method;
        scene.solver.substeps = 32;
        const SimulationModel model(scene);
        Twin twin(model);
        for (std::uint32_t frame = 1; frame <= 30; ++frame) twin.run_frame(frame);
        double largest = 0;
        const std::vector<glsl::vec4>& start = model.cloths[0].position;
        for (std::size_t p = 0; p < start.size(); ++p) {
            const Vec3 at = test::position_of(twin.cloth(0), p);
            largest = std::max(largest, std::hypot(at[0] - double{start[p].x}, at[1] - double{start[p].y},
                                                   at[2] - double{start[p].z}));
        }
        EXPECT_LT(largest, 2e-6) << static_cast<int>(method);
    }
}

}  // namespace
}  // namespace drape
