// Cloths sewn along sides of unlike numbers of particles, by the twin, against the network of both in double precision
// in which the finer side's particles are held between the coarser side's, and what nothing from outside can change.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "reference/spring_network.h"
#include "sewn_measures.h"
#include "world/seams.h"

namespace drape {
namespace {

using namespace test;

/// Two halves of a level sheet, of 1 m x 0.5 m, whose second one has other numbers of links; sewn across the load.
SceneDescription unlike_halves(std::uint32_t links, std::uint32_t other_links) {
    SceneDescription scene = halves(links, true);
    scene.cloths[1].grid = {other_links + 1, other_links / 2 + 1};
    return scene;
}

/// All particles of all cloths, of which some are free, and each is a mean of these: x = W q.
class TiedNetwork {
  public:
    explicit TiedNetwork(const SceneDescription& scene) {
        for (std::size_t cloth = 0; cloth < scene.cloths.size(); ++cloth) {
            networks_.emplace_back(scene, cloth);
            first_.push_back(means_.size());
            means_.resize(means_.size() + networks_.back().particle_count());
        }
        const Sewing sewing = sewing_of(scene);
        const auto at = [&](const SewnMember& member) -> std::vector<std::pair<std::size_t, double>>& {
            return means_[first_[member.cloth] + member.particle];
        };
        for (const auto& [group, close, rip] : sewing.stations) {
            for (const SewnMember& member : group) at(member) = {{free_count_, 1}};
            ++free_count_;
        }
        for (const SewnBetween& each : sewing.between)
            for (const SewnMember& member : each.group)
                for (std::size_t k = 0; k < 2; ++k) at(member).emplace_back(each.stations[k], each.weights[k]);
        for (auto& mean : means_)
            if (mean.empty()) mean = {{free_count_++, 1}};
        mass_.resize(free_count_), held_.resize(free_count_), q_.resize(free_count_), v_.resize(free_count_);
        for_all([&](std::size_t network, std::size_t i, const auto& mean) {
            const SpringNetwork& own = networks_[network];
            for (const auto& [to, weight] : mean) {
                mass_[to] += weight * own.mass[i];
                if (weight != 1) continue;
                held_[to] = held_[to] || own.pin_of[i] >= 0;
                q_[to] = own.rest_position[i];
            }
        });
    }

    /// Integrates by kicks and drifts of second order.
    void run(double seconds, double step) {
        const auto count = static_cast<int>(std::ceil(seconds / step));
        const double h = seconds / count;
        for (int k = 0; k < count; ++k) {
            kick(h / 2);
            for (std::size_t i = 0; i < free_count_; ++i) q_[i] = plus(q_[i], times(h, v_[i]));
            kick(h / 2);
        }
    }
    /// Returns where a cloth's particles are, m.
    std::vector<Vec3> places(std::size_t cloth) const {
        std::vector<Vec3> all;
        for (std::size_t i = 0; i < networks_[cloth].particle_count(); ++i) {
            Vec3 at{};
            for (const auto& [from, weight] : means_[first_[cloth] + i]) at = plus(at, times(weight, q_[from]));
            all.push_back(at);
        }
        return all;
    }

  private:
    template <class Visit>
    void for_all(const Visit& visit) const {
        for (std::size_t network = 0; network < networks_.size(); ++network)
            for (std::size_t i = 0; i < networks_[network].particle_count(); ++i)
                visit(network, i, means_[first_[network] + i]);
    }
    void kick(double h) {
        std::vector<Vec3> force(free_count_);
        std::vector<std::vector<Vec3>> gradients;
        for (std::size_t cloth = 0; cloth < networks_.size(); ++cloth)
            gradients.push_back(networks_[cloth].gradient(places(cloth)));
        for_all([&](std::size_t network, std::size_t i, const auto& mean) {
            for (const auto& [to, weight] : mean) force[to] = plus(force[to], times(-weight, gradients[network][i]));
        });
        for (std::size_t i = 0; i < free_count_; ++i)
            if (!held_[i] && mass_[i] > 0) v_[i] = plus(v_[i], times(h / mass_[i], force[i]));
    }

    std::vector<SpringNetwork> networks_;
    std::vector<std::size_t> first_;  ///< of each cloth's particles in means_
    std::vector<std::vector<std::pair<std::size_t, double>>> means_;
    std::size_t free_count_ = 0;
    std::vector<double> mass_;
    std::vector<bool> held_;
    std::vector<Vec3> q_, v_;
};

double distance_from(const TiedNetwork& exact, const Twin& twin, std::size_t cloths) {
    double squares = 0, count = 0;
    for (std::size_t cloth = 0; cloth < cloths; ++cloth) {
        const std::vector<Vec3> places = exact.places(cloth);
        for (std::size_t i = 0; i < places.size(); ++i, ++count) {
            const Vec3 way = minus(place_of(twin.cloth(cloth), i), places[i]);
            squares += dot(way, way);
        }
    }
    return std::sqrt(squares / count);
}

struct Convergence {
    SceneDescription scene;
    SolverMethod method;
    std::array<std::uint32_t, 3> substeps;
    double most;  ///< m with the most substeps
};

TEST(SeamBetween, MethodsConvergeToTheTiedNetwork) {
    constexpr std::uint32_t frames = 12;
    SceneDescription outer = unlike_halves(18, 24);  // the upper half leads
    SceneDescription inner = unlike_halves(24, 18);  // the lower one does
    SceneDescription small = unlike_halves(6, 8);
    for (const auto& [scene, method, substeps, most] : {Convergence{outer, SolverMethod::line, {8, 16, 32}, 2e-4},
                                                        {inner, SolverMethod::line, {8, 16, 32}, 2e-4},
                                                        {small, SolverMethod::relax, {64, 128, 256}, 1e-4}}) {
        TiedNetwork exact(scene);
        exact.run(frames / 60.0, 2e-5);
        double before = 1;
        for (const std::uint32_t each : substeps) {
            const SimulationModel model(with_method(scene, method, each));
            Twin twin(model);
            for (std::uint32_t frame = 1; frame <= frames; ++frame) twin.run_frame(frame);
            const double off = distance_from(exact, twin, 2);
            std::printf("[ measured ] %u to %u links by %s, %u substeps: %.3f mm\n", scene.cloths[0].grid[0] - 1,
                        scene.cloths[1].grid[0] - 1, std::string(named(method).name).c_str(), each, 1000 * off);
            EXPECT_LT(off, before / 1.5) << each;
            before = off;
        }
        EXPECT_LT(before, most) << "m";
    }
}

TEST(SeamBetween, ExplicitStepsAreThoseOfTheTiedNetwork) {
    const SceneDescription scene = with_method(unlike_halves(6, 8), SolverMethod::explicit_steps, 128);
    constexpr std::uint32_t frames = 12;
    TiedNetwork exact(scene);
    exact.run(frames / 60.0, 2e-5);
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= frames; ++frame) twin.run_frame(frame);
    const double off = distance_from(exact, twin, 2);
    std::printf("[ measured ] 6 to 8 links by explicit steps: %.2g m\n", off);
    EXPECT_LT(off, 1e-6);
}

TEST(SeamBetween, FreeClothKeepsItsMomentum) { expect_kept_momentum(unlike_halves(12, 16)); }

/// Returns the velocity, m/s, with which a free scene falls after half a second in which gravity grows from none to its
/// own in half of the time.
Vec3 fallen(SceneDescription scene, SolverMethod method) {
    scene = with_method(std::move(scene), method, method == SolverMethod::explicit_steps ? 64 : 16);
    scene.cloths[0].pins.clear();
    scene.gravity_keys = {{0, {0, 0, 0}}, {0.25, {0, -9.81, 0}}};
    const SimulationModel model(scene);
    Twin twin(model);
    for (std::uint32_t frame = 1; frame <= 30; ++frame) twin.run_frame(frame);
    const Momenta last = momenta_of(model, twin);
    return times(1 / last.mass, last.linear);
}

TEST(SeamBetween, GravityThatGrowsActsOnAllMassOnce) {
    for (const SolverMethod method : {SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps}) {
        const Vec3 plain = fallen(plain_sheet(12), method);
        // The velocity is that of a substep's length before the end at the earliest.
        EXPECT_NEAR(plain[1], -9.81 * 0.375, 9.81 / 60 / 16);
        for (SceneDescription scene : {unlike_halves(12, 16), halves(12, true)}) {
            scene.cloths[1].areal_density = 0.35;
            EXPECT_LT(length(minus(fallen(scene, method), plain)), 1e-5) << std::string(named(method).name);
        }
    }
}

/// Cloth never has more than the energy of its strained start and of its fall, whose most is that of a metre.
TEST(SeamBetween, FortyBadStartsDoNotBlowUp) {
    double most = 0;
    for (const SolverMethod method : {SolverMethod::line, SolverMethod::relax})
        for (const bool coarse_leads : {true, false})
            for (std::uint32_t seed = 0; seed < 10; ++seed) {
                SceneDescription scene =
                    with_method(coarse_leads ? unlike_halves(10, 16) : unlike_halves(14, 10), method, 2 + seed % 6);
                for (Cloth& cloth : scene.cloths) {
                    cloth.placement.jitter = 0.08;
                    cloth.placement.seed = seed + (&cloth == scene.cloths.data() ? 0 : 100);
                }
                const SimulationModel model(scene);
                Twin twin(model);
                double given = 0.2 * 9.81 * 1;
                for (std::size_t cloth = 0; cloth < 2; ++cloth) {
                    const SpringNetwork network(scene, cloth);
                    std::vector<Vec3> start;
                    for (std::size_t i = 0; i < network.particle_count(); ++i)
                        start.push_back(place_of(twin.cloth(cloth), i));
                    given += network.spring_energy(start) + network.bending_energy(start);
                }
                for (std::uint32_t frame = 1; frame <= 40; ++frame) {
                    twin.run_frame(frame);
                    const double part = kinetic_energy(model, twin) / given;
                    most = std::max(most, part);
                    ASSERT_LT(part, 1) << named(method).name << ", seed " << seed << ", frame " << frame;
                }
            }
    std::printf("[ measured ] 40 bad starts: at most %.2f of their energy is kinetic\n", most);
}

TEST(SeamBetween, AHeldPlaceBearsWhatLiesBesideIt) {
    for (const SolverMethod method : {SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps})
        for (const std::uint32_t other_links : {8u, 16u}) {
            SceneDescription scene =
                with_method(unlike_halves(12, other_links), method, method == SolverMethod::explicit_steps ? 64 : 8);
            const std::uint32_t row = scene.cloths[0].grid[1] - 1;
            scene.cloths[0].pins = {pin_box(0, row, 0, row)};
            const SimulationModel model(scene);
            Twin twin(model);
            const std::size_t corner = std::size_t{row} * scene.cloths[0].grid[0];
            const Vec3 start = place_of(twin.cloth(0), corner);
            for (std::uint32_t frame = 1; frame <= 6; ++frame) {
                twin.run_frame(frame);
                EXPECT_EQ(place_of(twin.cloth(0), corner), start) << frame;
                EXPECT_EQ(place_of(twin.cloth(1), 0), start) << frame;
            }
        }
}

/// Halves that start apart: as far, aslant, and turned about the seam.
SceneDescription open_halves(std::uint32_t other_links, double close) {
    SceneDescription scene = unlike_halves(12, other_links);
    scene.cloths[0].pins.clear();
    scene.cloths[1].placement.origin = {-0.45, 1.05, 0.6};
    scene.cloths[1].placement.v = {0, -0.6, 0.8};
    scene.cloths[1].areal_density = 0.35;
    scene.gravity = {};
    scene.seams[0].close = close;
    return scene;
}

Vec3 center_of(const SimulationModel& model, const Twin& twin) {
    Vec3 sum{};
    double all = 0;
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) {
        const std::vector<float> shares = mass_shares(model.cloths[cloth]);
        for (std::size_t i = 0; i < shares.size(); ++i) {
            const double mass = model.cloths[cloth].inner_mass * double{shares[i]};
            sum = plus(sum, times(mass, place_of(twin.cloth(cloth), i)));
            all += mass;
        }
    }
    return times(1 / all, sum);
}

TEST(SeamBetween, ClosingKeepsTheCentreOfMassAndMomentum) {
    for (const SolverMethod method : {SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps})
        for (const std::uint32_t other_links : {12u, 16u}) {
            const SimulationModel model(
                with_method(open_halves(other_links, 0.25), method, method == SolverMethod::explicit_steps ? 64 : 16));
            Twin twin(model);
            const Vec3 start = center_of(model, twin);
            for (std::uint32_t frame = 1; frame <= 24; ++frame) twin.run_frame(frame);
            const Momenta last = momenta_of(model, twin);
            const double moved = length(minus(center_of(model, twin), start)), speed = length(last.linear) / last.mass;
            std::printf("[ measured ] %s, 12 to %u links: the centre moved by %.1e m, and moves by %.1e m/s\n",
                        std::string(named(method).name).c_str(), other_links, moved, speed);
            EXPECT_LT(moved, 2e-6);
            EXPECT_LT(speed, 2e-6);
        }
}

/// Returns the largest distance between a seam's particles and their places.
double widest(const SimulationModel& model, const Twin& twin) {
    const Sewing sewing = sewing_of(model.scene);
    const auto place = [&](const SewnMember& member) { return place_of(twin.cloth(member.cloth), member.particle); };
    double most = 0;
    for (const auto& [group, close, rip] : sewing.stations)
        for (const SewnMember& member : group) most = std::max(most, length(minus(place(member), place(group[0]))));
    for (const SewnBetween& each : sewing.between)
        for (const SewnMember& member : each.group) {
            const Vec3 at = plus(times(each.weights[0], place(sewing.stations[each.stations[0]].group[0])),
                                 times(each.weights[1], place(sewing.stations[each.stations[1]].group[0])));
            most = std::max(most, length(minus(place(member), at)));
        }
    return most;
}

TEST(SeamBetween, ASeamClosesSmoothlyAndIsThenSewn) {
    for (const std::uint32_t other_links : {12u, 16u}) {
        const SimulationModel model(with_method(open_halves(other_links, 0.2), SolverMethod::line, 8));
        Twin twin(model);
        const double start = widest(model, twin);
        EXPECT_GT(start, 0.1);
        for (std::uint32_t frame = 1; frame <= 20; ++frame) {
            twin.run_frame(frame);
            // Places are means of what is still apart: the gap is that of the schedule.
            EXPECT_NEAR(widest(model, twin) / start, opening_at(frame / 60.0, 0.2), 1e-4) << frame;
            EXPECT_LT(widest(model, twin), frame > 12 ? 2e-7 : 1) << frame;
        }
    }
}

}  // namespace
}  // namespace drape
