// Cloth cut by an outline is the sheet that it is cut from: its elasticity is that of a disc in closed form, and it
// moves as the double-precision network does.
#include <gtest/gtest.h>

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "drape/scene_reader.h"
#include "reference/spring_network.h"
#include "reference/symplectic_reference.h"
#include "support/sheet_state.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {
namespace {

constexpr double radius = 0.5;

const char* const shapes[] = {
    "M-.5 0A.5.5 0 0 0 .5 0A.5.5 0 0 0-.5 0Z",
    "M-.5 0A.5.5 0 0 0 .5 0A.5.5 0 0 0-.5 0ZM-.2 0a.2.2 0 0 0 .4 0a.2.2 0 0 0-.4 0z",
    "M.2 0Q.5.16.8 0L1.1.25.98.38.8.3V1H.2V.3L.02.38-.1.25Z",
};

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

/// The primitives of a flat cloth that exist, as contact has them.
struct FlatPrimitives {
    std::vector<glsl::uvec4> points, edges;  ///< pairs that share no corner

    explicit FlatPrimitives(const ClothModel& model) {
        std::vector<std::array<glsl::uint, 3>> triangles;
        std::set<glsl::uint> corners;
        std::set<std::array<glsl::uint, 2>> sides;
        const std::vector<std::uint32_t> indices = model.grid.triangle_indices();
        const auto corner = [&](std::uint32_t k) {
            return glsl::self_corner({static_cast<int>(indices[k] % model.grid.columns()),
                                      static_cast<int>(indices[k] / model.grid.columns())});
        };
        for (std::uint32_t k = 0; k < indices.size(); k += 3) {
            triangles.push_back({corner(k), corner(k + 1), corner(k + 2)});
            for (std::uint32_t side = 0; side < 3; ++side) {
                const auto [low, high] = std::minmax(triangles.back()[side], triangles.back()[(side + 1) % 3]);
                corners.insert(low), sides.insert({low, high});
            }
            corners.insert(triangles.back().begin(), triangles.back().end());
        }
        const auto add = [](std::vector<glsl::uvec4>& to, bool is_edges, const glsl::uvec4& pair) {
            if (!glsl::self_shares_corner(is_edges, pair)) to.push_back(pair);
        };
        for (const glsl::uint point : corners)
            for (const auto& [b, c, d] : triangles) add(points, false, {point, b, c, d});
        for (const auto& [a, b] : sides)
            for (const auto& [c, d] : sides) add(edges, true, {a, b, c, d});
    }
};

/// Returns the least distance of a flat cloth's pairs over the thickness that contact keeps between them, however thick
/// the cloth is, of those that are at most four columns and rows apart.
double least_room(const SceneDescription& scene) {
    const SimulationModel model(scene);
    const ClothModel& cloth = model.cloths[0];
    const glsl::SelfCloth constants = model.self_contact->cloths[0];
    const FlatPrimitives all(cloth);
    double least = std::numeric_limits<double>::infinity();
    const auto look = [&](bool edges, const glsl::uvec4& pair) {
        const auto texel = [](glsl::uint corner) { return glsl::self_texel(corner); };
        const glsl::ivec2 from = texel(pair.x), to = texel(edges ? pair.z : pair.y);
        if (std::abs(from.x - to.x) > 4 || std::abs(from.y - to.y) > 4) return;
        const auto at = [&](glsl::uint corner) {
            const glsl::vec4& place = cloth.panel[cloth.grid.particle(static_cast<std::uint32_t>(texel(corner).x),
                                                                      static_cast<std::uint32_t>(texel(corner).y))];
            return glsl::vec3{place.x, place.y, 0};
        };
        const float kept = glsl::self_pair_thickness(1e3f, constants, constants, edges, texel(pair.x), texel(pair.y),
                                                     texel(pair.z), texel(pair.w));
        const glsl::SelfGap gap = glsl::self_gap(edges, {at(pair.x), at(pair.y), at(pair.z), at(pair.w)});
        least = std::min(least, static_cast<double>(gap.distance) / static_cast<double>(kept));
    };
    for (const glsl::uvec4& pair : all.points) look(false, pair);
    for (const glsl::uvec4& pair : all.edges) look(true, pair);
    return least;
}

TEST(OutlineContactTest, FlatClothHasRoomForTheThicknessThatContactKeeps) {
    for (const char* shape : shapes)
        for (const char* spacing : {"0.1", "0.063", "0.04"}) {
            const double room =
                least_room(parse_scene(std::string(R"({"cloths": [{"self_collision": {}, "outline": {"path": ")") +
                                       shape + R"(", "spacing": )" + spacing + "}}]}"));
            std::printf("[ measured ] %.20s at %s: flat pairs are %.2f thicknesses apart or more\n", shape, spacing,
                        room);
            EXPECT_GT(room, 1.99) << "half of the distance is kept";
            EXPECT_LT(room, 2.1) << "some pair decides";
        }
}

}  // namespace
}  // namespace drape
