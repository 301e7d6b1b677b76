// Scenes of cloths that close gas in.
#pragma once

#include <cmath>
#include <numbers>

#include "support/sheets.h"
#include "world/gas.h"

namespace drape::test {

/// Two squares of n x n particles, .4 m wide and sewn along all borders, that bulge by so much, m; the second one is
/// turned over where `turned`, so that its front is outside too. No gravity.
inline SceneDescription gas_cushion(SolverMethod method, std::uint32_t n, std::uint32_t substeps, double bulge,
                                    bool turned = false) {
    SceneDescription scene = sheet(n, n, 0.4, 0.4, substeps, 1);
    scene.solver.method = method;
    scene.gravity = {};
    Cloth& top = scene.cloths[0];
    top.name = "top";
    top.areal_density = 0.3;
    top.stiffness = {false, 800, 80, 1e-5};
    Cloth bottom = top;
    bottom.name = "bottom";
    bottom.areal_density = 0.2;
    scene.cloths.push_back(bottom);
    for (const double side : {1.0, -1.0}) {
        Cloth& cloth = scene.cloths[side > 0 ? 0 : 1];
        for (std::uint32_t row = 0; row < n; ++row)
            for (std::uint32_t column = 0; column < n; ++column) {
                const double u = column / (n - 1.0), v = row / (n - 1.0);
                const bool border = row == 0 || column == 0 || row == n - 1 || column == n - 1;
                const double high =
                    border ? 0 : bulge * std::sin(std::numbers::pi * u) * std::sin(std::numbers::pi * v);
                const double across = turned && side < 0 ? 1 - u : u;
                cloth.start.push_back({0.4 * across - 0.2, 0.3 + side * high, 0.4 * v - 0.2});
            }
        cloth.placement = {};
    }
    for (const auto& [of_top, of_bottom] :
         {std::pair{SeamEdge::left, turned ? SeamEdge::right : SeamEdge::left},
          std::pair{SeamEdge::right, turned ? SeamEdge::left : SeamEdge::right},
          std::pair{SeamEdge::top, SeamEdge::top}, std::pair{SeamEdge::bottom, SeamEdge::bottom}})
        scene.seams.push_back({{"top", of_top}, {"bottom", of_bottom}});
    // No pressure at the start.
    scene.gas = {{.cloths = {"top", "bottom"}, .volume = 0}};
    scene.gas[0].volume = start_volume(scene, gas_walls(scene, scene.gas[0]));
    return scene;
}

/// Lets the amount of gas of a scene go to so much, m^3, until a time, s.
inline void blow_up(SceneDescription& scene, double volume, double time) {
    Gas& gas = scene.gas[0];
    gas.volume_keys = {{0, *gas.volume}, {time, volume}};
    gas.volume = {};
}

}  // namespace drape::test
