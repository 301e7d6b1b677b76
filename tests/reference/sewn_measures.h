// Sewn sheets, and what is measured of their runs by the twin.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "base/vectors.h"
#include "cloth/cloth_statistics.h"
#include "support/sheets.h"
#include "twin/twin.h"

namespace drape::test {

inline std::string name_of(SolverMethod method) { return std::string(named(method).name); }

inline SceneDescription with_method(SceneDescription scene, SolverMethod method, std::uint32_t substeps) {
    scene.solver.method = method;
    scene.solver.substeps = substeps;
    return scene;
}

/// A level sheet of so many links a side and 1 m, held by its top row.
inline SceneDescription plain_sheet(std::uint32_t links) {
    SceneDescription scene = sheet(links + 1, links + 1, 1, 1, 8);
    Cloth& cloth = scene.cloths[0];
    cloth.placement = {{-0.5, 1, 0}, {1, 0, 0}, {0, 0, 1}};
    cloth.stiffness = {false, 1000, 100, 1e-4};
    cloth.pins = {pin_top(cloth)};
    return scene;
}

/// The same of two halves, sewn across the load or along it.
inline SceneDescription halves(std::uint32_t links, bool across) {
    SceneDescription scene = plain_sheet(links);
    Cloth& one = scene.cloths[0];
    one.name = "one";
    const std::size_t axis = across ? 1 : 0;
    one.grid[axis] = links / 2 + 1;
    one.size[axis] = 0.5;
    one.pins = {pin_box(0, 0, one.grid[0] - 1, 0)};
    Cloth other = one;
    other.name = "other";
    other.placement.origin[across ? 2 : 0] += 0.5;
    if (across) other.pins.clear();
    scene.cloths.push_back(other);
    scene.seams = {across ? Seam{{"one", SeamEdge::bottom}, {"other", SeamEdge::top}}
                          : Seam{{"one", SeamEdge::right}, {"other", SeamEdge::left}}};
    return scene;
}

inline Vec3 place_of(const TwinCloth& cloth, std::size_t i) {
    const glsl::vec4& at = cloth[Field::position][i];
    return {double{at.x}, double{at.y}, double{at.z}};
}

/// The momenta of all cloths about the origin, by the masses of their own cells, and their mass.
struct Momenta {
    double mass = 0;
    Vec3 linear{}, angular{};
};

inline Momenta momenta_of(const SimulationModel& model, const Twin& twin) {
    Momenta all;
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) {
        const ClothModel& own = model.cloths[cloth];
        const std::vector<float> shares = mass_shares(own);
        for (std::size_t i = 0; i < shares.size(); ++i) {
            const double mass = own.inner_mass * double{shares[i]};
            const glsl::vec4& moved = twin.cloth(cloth)[Field::displacement][i];
            const Vec3 velocity =
                times(1 / own.substep_length, Vec3{double{moved.x}, double{moved.y}, double{moved.z}});
            all.mass += mass;
            all.linear = plus(all.linear, times(mass, velocity));
            all.angular = plus(all.angular, cross(place_of(twin.cloth(cloth), i), times(mass, velocity)));
        }
    }
    return all;
}

inline double kinetic_energy(const SimulationModel& model, const Twin& twin) {
    double all = 0;
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) {
        const ClothModel& own = model.cloths[cloth];
        const std::vector<float> shares = mass_shares(own);
        for (std::size_t i = 0; i < shares.size(); ++i) {
            const glsl::vec4& moved = twin.cloth(cloth)[Field::displacement][i];
            const Vec3 way{double{moved.x}, double{moved.y}, double{moved.z}};
            all += own.inner_mass * double{shares[i]} * dot(way, way) / 2;
        }
    }
    return all / (model.cloths[0].substep_length * model.cloths[0].substep_length);
}

/// Lets two sewn cloths of 0.5 m² go, whose masses and velocities differ, and holds their momenta after half a second
/// against those of the first frame, by every method.
inline void expect_kept_momentum(const SceneDescription& sewn) {
    for (const SolverMethod method : {SolverMethod::line, SolverMethod::relax, SolverMethod::explicit_steps}) {
        SceneDescription scene = with_method(sewn, method, method == SolverMethod::explicit_steps ? 64 : 16);
        scene.gravity = {};
        scene.cloths[0].pins.clear();
        scene.cloths[0].velocity = {0, 1, 0.2};
        scene.cloths[1].velocity = {0.3, -1, 0};
        scene.cloths[1].areal_density = 0.35;
        scene.cloths[0].placement.jitter = scene.cloths[1].placement.jitter = 0.005;
        const SimulationModel model(scene);
        Twin twin(model);
        twin.run_frame(1);
        const Momenta first = momenta_of(model, twin);
        for (std::uint32_t frame = 2; frame <= 30; ++frame) twin.run_frame(frame);
        const Momenta last = momenta_of(model, twin);
        EXPECT_NEAR(first.mass, 0.5 * 0.2 + 0.5 * 0.35, 1e-6) << "mass at the seam counts once";
        const double linear = length(minus(last.linear, first.linear)) / first.mass,
                     angular = length(minus(last.angular, first.angular)) / first.mass;
        std::printf("[ measured ] %s: momentum changes by %.1e, angular by %.1e of mass times 1 m/s\n",
                    std::string(named(method).name).c_str(), linear, angular);
        EXPECT_LT(linear, 2e-6);
        EXPECT_LT(angular, 5e-3);
    }
}

}  // namespace drape::test
