#include "ensemble_members.h"

#include <fmt/format.h>

#include <cstring>
#include <random>

#include "library_device.h"

namespace drape::test {

namespace {

constexpr const char* base = R"({
  "time": {"fps": 60, "frames": 30},
  "wind": {"velocity": [2, 0.3, -1], "gust": {"amplitude": 1, "period": 0.7, "seed": 3}},
  "cloths": [{"name": "sheet", "grid": [17, 12], "size": [0.8, 0.6],
              "placement": {"origin": [-0.4, 0.9, 0], "u": [1, 0, 0], "v": [0, -0.6, 0.8], "jitter": 0.001},
              "areal_density": 0.2, "stiffness": {"stretch": 400, "shear": 80, "bend": 1e-5}, "damping": 0.2,
              "pins": [{"corner": "top_left", "path": [{"t": 0}, {"t": 0.3, "translate": [0.1, 0.05, 0.1]}]},
                       {"corner": "top_right", "release": 0.06}]}],
  "colliders": {"spheres": [{"center": [0, 0.55, 0.1], "radius": 0.15,
                             "path": [{"t": 0}, {"t": 0.5, "translate": [0, 0.2, 0]}]}],
                "planes": [{"normal": [0, 1, 0], "offset": 0}]},
  "solver": {"method": "line", "substeps": 4}
})";

/// A scene by itself.
struct Alone {
    explicit Alone(const SceneDescription& scene)
        : simulation(scene, {.velocities = true, .normals = true, .keep_promises = false}, library_device()) {}
    Simulation simulation;
};

void expect_same_proof(const std::optional<SelfContactReport>& own, const std::optional<SelfContactReport>& other) {
    ASSERT_EQ(own.has_value(), other.has_value());
    if (!own) return;
    EXPECT_EQ(own->first_unproved, other->first_unproved);
    EXPECT_EQ(own->most_pairs, other->most_pairs);
    EXPECT_EQ(own->truncated, other->truncated);
    EXPECT_EQ(own->longest_lag, other->longest_lag);
    EXPECT_EQ(own->lag_limit, other->lag_limit);
    EXPECT_EQ(own->first_lagging, other->first_lagging);
    EXPECT_EQ(own->lagging_frames, other->lagging_frames);
}

}  // namespace

SceneDescription scene_of(const std::vector<std::string>& overrides) {
    SceneResult result = read_scene_text(base, "test", overrides);
    if (!result.scene) throw SceneFailure(std::move(result));
    return *result.scene;
}

SceneDescription scene_by(const std::string& method) {
    return scene_of(
        {method == "auto" ? R"(/solver={"method": "auto"})" : fmt::format("/solver/method=\"{}\"", method)});
}

std::vector<SceneDescription> drawn(const SceneDescription& scene, std::size_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
        return low + (high - low) * std::generate_canonical<double, 53>(random);
    };
    std::vector<SceneDescription> members(count, scene);
    for (SceneDescription& member : members) {
        member.gravity = {between(-1, 1), between(-10, -8), between(-1, 1)};
        member.wind.velocity = {between(-4, 4), between(-1, 1), between(1, 4)};
        member.wind.gust.seed = static_cast<std::uint32_t>(random());
        member.wind.drag = between(0.5, 1.5);
        for (Cloth& cloth : member.cloths) {
            cloth.size = {between(0.7, 0.9), between(0.5, 0.7)};
            cloth.areal_density = between(0.1, 0.4);
            cloth.stiffness.stretch = between(200, 600);
            cloth.stiffness.shear = between(40, 120);
            if (cloth.stiffness.bend.largest() > 0) cloth.stiffness.bend = between(1e-6, 1e-4);
            cloth.damping = between(0, 0.5);
            cloth.friction = between(0, 0.8);
            cloth.thickness = between(0.002, 0.01);
            cloth.velocity = {between(-1, 1), between(-1, 1), between(-1, 1)};
            cloth.placement.origin[1] += between(0, 0.1);
            cloth.placement.seed = static_cast<std::uint32_t>(random());
            for (Pin& pin : cloth.pins)
                if (pin.path.moves()) pin.path.keys[1].translate = {between(0, 0.1), between(0, 0.1), between(0, 0.1)};
        }
        for (Collider& collider : member.colliders) {
            collider.friction = between(0, 0.8);
            if (auto* sphere = std::get_if<Sphere>(&collider.shape)) sphere->radius = between(0.1, 0.2);
            if (collider.path.moves()) collider.path.keys[1].translate[1] = between(-0.1, 0.3);
        }
    }
    return members;
}

std::vector<float> of_member(const MemberArray& array, std::size_t member) {
    const float* const first = array.data + member * array.member_stride;
    return {first, first + 4 * array.rows * array.columns};
}

bool same_bytes(std::span<const float> one, std::span<const float> other) {
    return one.size() == other.size() && std::memcmp(one.data(), other.data(), one.size_bytes()) == 0;
}

void expect_each_as_alone(const std::vector<SceneDescription>& scenes, std::uint32_t frames, bool together) {
    Ensemble ensemble(scenes, {.normals = true}, library_device());
    EXPECT_EQ(ensemble.sharing_obstacle().has_value(), !together) << ensemble.sharing_obstacle().value_or("");
    std::vector<Alone> alone(scenes.begin(), scenes.end());
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        if (frame > 0) ensemble.step();
        for (std::size_t k = 0; k < scenes.size(); ++k) {
            ASSERT_TRUE(alone[k].simulation.step());
            const FinishedFrame& one = alone[k].simulation.frame();
            const std::string where = fmt::format("frame {}, member {}", frame, k);
            ASSERT_EQ(ensemble.frame(k), frame);
            ASSERT_EQ(ensemble.failure(k).has_value(), one.failure.has_value()) << where;
            for (std::size_t cloth = 0; cloth < scenes[k].cloths.size(); ++cloth) {
                ASSERT_TRUE(same_bytes(of_member(ensemble.positions(cloth), k), one.positions[cloth])) << where;
                ASSERT_TRUE(same_bytes(of_member(ensemble.velocities(cloth), k), one.velocities[cloth])) << where;
                ASSERT_TRUE(same_bytes(of_member(ensemble.normals(cloth), k), one.normals[cloth])) << where;
                const ClothStatistics &own = ensemble.statistics(k)[cloth], &other = one.statistics[cloth];
                ASSERT_EQ(own.kinetic_energy, other.kinetic_energy) << where;
                ASSERT_EQ(own.potential_energy, other.potential_energy) << where;
                ASSERT_EQ(own.stretch_error_rms, other.stretch_error_rms) << where;
                ASSERT_EQ(own.penetration, other.penetration) << where;
                ASSERT_EQ(own.forces.size(), other.forces.size()) << where;
                for (std::size_t by = 0; by < own.forces.size(); ++by) {
                    ASSERT_EQ(own.forces[by].by, other.forces[by].by) << where;
                    ASSERT_EQ(own.forces[by].force, other.forces[by].force) << where << ", " << own.forces[by].by;
                    ASSERT_EQ(own.forces[by].moment, other.forces[by].moment) << where << ", " << own.forces[by].by;
                }
            }
            SCOPED_TRACE(where);
            if (!one.failure) expect_same_proof(ensemble.self_contact(k), alone[k].simulation.self_contact());
        }
    }
}

void expect_reset_and_restored(const std::vector<SceneDescription>& members) {
    Ensemble fresh(members, {}, library_device()), ensemble(members, {}, library_device());
    std::vector<std::vector<std::vector<float>>> frames;  // by frame and member
    const auto keep = [](const Ensemble& from) {
        std::vector<std::vector<float>> all;
        for (std::size_t k = 0; k < from.size(); ++k) {
            all.push_back(of_member(from.positions(0), k));
            const std::vector<float> velocities = of_member(from.velocities(0), k);
            all.back().insert(all.back().end(), velocities.begin(), velocities.end());
        }
        return all;
    };
    frames.push_back(keep(fresh));
    for (int frame = 1; frame < 10; ++frame) {
        fresh.step();
        frames.push_back(keep(fresh));
    }
    for (int frame = 0; frame < 3; ++frame) ensemble.step();
    const SimulationState saved = ensemble.save(3);
    ensemble.step();
    const std::size_t two[] = {1, 4}, three[] = {3};
    ensemble.reset(two);
    ensemble.restore(three, std::span(&saved, 1));
    for (int further = 0; further < 4; ++further) {
        const std::vector<std::vector<float>> now = keep(ensemble);
        for (std::size_t k = 0; k < members.size(); ++k) {
            const std::uint32_t frame = ensemble.frame(k);
            EXPECT_EQ(frame, std::uint32_t(further) + (k == 1 || k == 4 ? 0u : k == 3 ? 3u : 4u));
            EXPECT_TRUE(same_bytes(now[k], frames[frame][k])) << "member " << k << ", frame " << frame;
        }
        ensemble.step();
    }
}

}  // namespace drape::test
