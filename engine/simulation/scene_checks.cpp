#include "simulation/scene_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "drape/scene_reader.h"
#include "world/overlap.h"
#include "world/start.h"
#include "world/start_crossings.h"

namespace drape {

namespace {

bool is_box_of(const IndexBox& box, const Cloth& cloth) {
    return box.first[0] <= box.last[0] && box.first[1] <= box.last[1] && box.last[0] < cloth.grid[0] &&
           box.last[1] < cloth.grid[1];
}

bool has_value(const VectorKey& key) {
    return std::ranges::all_of(key.value, [](double x) { return std::isfinite(x); });
}
bool has_value(const FactorKey& key) { return key.factor >= 0.001 && key.factor <= 1; }

template <class Key>
bool are_keys(const std::vector<Key>& keys) {
    const auto fits = [](const Key& key) { return std::isfinite(key.time) && has_value(key); };
    const auto not_before = [](const Key& a, const Key& b) { return a.time >= b.time; };
    return std::ranges::all_of(keys, fits) && std::ranges::adjacent_find(keys, not_before) == keys.end();
}

/// Returns whether there are no factors, or `count` of them between the two bounds.
bool has_factors(std::size_t count, const std::vector<float>& factors, float least, float most) {
    return factors.empty() || (factors.size() == count &&
                               std::ranges::all_of(factors, [&](float each) { return each >= least && each <= most; }));
}

/// Reports the maps of a cloth whose size does not match its grid, or whose values are out of range.
template <class Expect>
void check_maps(const Cloth& cloth, const std::string& at, const Expect& expect) {
    const std::size_t cells = std::size_t{cloth.grid[0] - 1} * (cloth.grid[1] - 1),
                      particles = std::size_t{cloth.grid[0]} * cloth.grid[1];
    expect(has_factors(cells, cloth.cell_stiffness, 0x1p-20f, 1), at + "/cell_stiffness",
           "a factor of at most 1, and not 0, for every cell");
    expect(has_factors(cells, cloth.cell_density, 1, 0x1p20f), at + "/cell_density",
           "a factor of at least 1 for every cell");
    expect(has_factors(cells, cloth.cell_tear, 0x1p-20f, 0x1p20f), at + "/cell_tear",
           "a factor above 0 for every cell");
    expect(has_factors(particles, cloth.particle_friction, 0, 0x1p20f), at + "/particle_friction",
           "a factor of at least 0 for every particle");
    expect(has_factors(particles, cloth.particle_thickness, 0, 1), at + "/particle_thickness",
           "a factor from 0 to 1 for every particle");
}

/// Returns whether the load at which a cloth's springs tear is one that they can reach.
bool bears(const Cloth& cloth) {
    const Tear& tear = *cloth.tear;
    const double limit = tear.strain.value_or(0) + tear.tension.value_or(0);
    return tear.strain.has_value() != tear.tension.has_value() && limit > 0 && std::isfinite(limit) &&
           !cloth.stiffness.rigid && cloth.stiffness.stretch.least() > 0;
}

}  // namespace

const SceneDescription& checked_scene(const SceneDescription& scene) {
    SceneResult result;
    const auto expect = [&result](bool fits, const std::string& pointer, const char* what) {
        if (!fits) result.errors.push_back({"scene", 0, 0, pointer, fmt::format("expected {}", what)});
    };
    std::uint64_t particle_count = 0;
    std::set<std::string_view> names;
    expect(!scene.cloths.empty(), "/cloths", "a cloth");
    for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
        const Cloth& cloth = scene.cloths[i];
        const std::string at = fmt::format("/cloths/{}", i);
        particle_count += std::uint64_t{cloth.grid[0]} * cloth.grid[1];
        expect(std::min(cloth.grid[0], cloth.grid[1]) >= 2 && particle_count <= scene_particle_limit, at + "/grid",
               "at least 2 x 2 particles and no more than a scene may have");
        expect(names.insert(cloth.name).second && !cloth.name.empty(), at + "/name", "a name no other cloth has");
        for (const double side : cloth.size) expect(side > 0 && std::isfinite(side), at + "/size", "lengths above 0");
        expect(cloth.areal_density > 0 && std::isfinite(cloth.areal_density), at + "/areal_density", "a mass above 0");
        for (std::size_t pin = 0; pin < cloth.pins.size(); ++pin)
            expect(is_box_of(cloth.pins[pin].particles, cloth), fmt::format("{}/pins/{}", at, pin),
                   "particles of the grid");
        for (std::size_t hole = 0; hole < cloth.holes.size(); ++hole)
            expect(is_box_of(cloth.holes[hole], cloth), fmt::format("{}/holes/{}", at, hole), "particles of the grid");
    }
    expect(are_keys(scene.gravity_keys), "/gravity_keys", "numbers at times that increase");
    expect(are_keys(scene.wind.keys), "/wind/keys", "numbers at times that increase");
    for (std::size_t i = 0; i < scene.cloths.size() && result.errors.empty(); ++i) {
        const Cloth& cloth = scene.cloths[i];
        const std::string at = fmt::format("/cloths/{}", i);
        if (!cloth.start.empty()) expect(start_fault(cloth).empty(), at + "/start", start_fault(cloth).c_str());
        if (!cloth.velocities.empty())
            expect(velocities_fault(cloth).empty(), at + "/velocities", velocities_fault(cloth).c_str());
        expect(
            are_keys(cloth.stiffness_keys) &&
                (cloth.stiffness_keys.empty() || (!cloth.stiffness.rigid && !(cloth.tear && cloth.tear->tension))),
            at + "/stiffness_keys",
            "factors from 0.001 to 1 at times that increase, of springs that are neither rigid nor torn by a tension");
        check_maps(cloth, at, expect);
        expect(!cloth.tear || bears(cloth), at + "/tear",
               "either a strain or a tension above 0, of springs that are not rigid");
    }
    expect(scene.time.frame_count > 0 && scene.time.fps > 0 && std::isfinite(scene.time.fps), "/time", "frames");
    expect(scene.solver.substeps > 0 && scene.solver.iterations > 0, "/solver", "at least one substep and iteration");
    expect(std::ranges::min(scene.image.size) > 0 && (scene.image.samples == 1 || scene.image.samples == 4), "/image",
           "pixels, of 1 or 4 samples");
    expect(scene.lights.size() <= 4, "/lights", "at most 4 lights");
    for (std::size_t i = 0; i < scene.cloths.size() && result.errors.empty(); ++i)
        expect(leaves_a_cell(scene.cloths[i]), fmt::format("/cloths/{}/holes", i), "holes that leave a cell");
    if (result.errors.empty() && scene.overlap == Overlap::refuse)
        for (const StartOverlap& overlap : start_overlaps(scene))
            expect(false, fmt::format("/cloths/{}", overlap.cloth),
                   ("a start outside all colliders: " + overlap_text(scene, overlap)).c_str());
    if (result.errors.empty() && cloths_meet(scene))
        for (const StartCrossing& crossing : start_crossings(scene))
            expect(!is_refused(scene, crossing), fmt::format("/cloths/{}", crossing.second),
                   ("cloths that start apart: " + crossing_text(scene, crossing)).c_str());
    if (!result.errors.empty()) throw SceneFailure(std::move(result));
    return scene;
}

}  // namespace drape
