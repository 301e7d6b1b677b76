#include "simulation/scene_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "drape/scene_reader.h"
#include "world/body_faults.h"
#include "world/cloth_keys.h"
#include "world/gas.h"
#include "world/mass_properties.h"
#include "world/overlap.h"
#include "world/panel.h"
#include "world/seams.h"
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
bool has_value(const NumberKey& key) { return std::isfinite(key.value); }
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

/// Returns whether the load at which a cloth's springs tear is one that they can reach.
bool bears(const Cloth& cloth) {
    const Tear& tear = *cloth.tear;
    const double limit = tear.strain.value_or(0) + tear.tension.value_or(0);
    return tear.strain.has_value() != tear.tension.has_value() && limit > 0 && std::isfinite(limit) &&
           !cloth.stiffness.rigid && cloth.stiffness.stretch.least() > 0;
}

bool is_positive(double x) { return x > 0 && std::isfinite(x); }
bool is_not_negative(double x) { return x >= 0 && std::isfinite(x); }
bool is_finite(const Vec3& vector) {
    return std::ranges::all_of(vector, [](double x) { return std::isfinite(x); });
}

bool can_be(const Stiffness& stiffness) {
    const WarpWeft& stretch = stiffness.stretch;
    const Rigidity& bend = stiffness.bend;
    const std::array numbers{stretch.warp, stretch.weft, stiffness.shear, bend.warp, bend.weft, bend.twist};
    return std::ranges::all_of(numbers, is_not_negative) && stiffness.compression >= 0 && stiffness.compression <= 1;
}

bool can_be(const SelfCollision& contact) {
    return is_positive(contact.thickness.value_or(1)) && is_not_negative(contact.friction.value_or(0));
}

bool can_change(const Cloth& cloth) {
    return cloth.stiffness_keys.empty() || (!cloth.stiffness.rigid && !(cloth.tear && cloth.tear->tension));
}

bool can_be(const Placement& placement) {
    return is_finite(placement.origin) && is_finite(placement.u) && is_finite(placement.v) &&
           std::ranges::all_of(placement.scale, [](double x) { return std::isfinite(x); }) &&
           is_not_negative(placement.jitter);
}

/// What is expected of a cloth's member, where it is not so, and the end of the member's pointer.
struct Fault {
    std::string expected, below = {};
};

Fault fault_unless(bool fits, const char* expected) { return {fits ? "" : expected}; }

Fault fault_of_boxes(const Cloth& cloth, std::size_t count, const auto& box) {
    for (std::size_t k = 0; k < count; ++k)
        if (!is_box_of(box(k), cloth)) return {"particles of the grid", fmt::format("/{}", k)};
    return {};
}

Fault fault_of_load(const Cloth& cloth, const Load& load) {
    if (!is_box_of(load.particles, cloth)) return {"particles of the grid"};
    if (!has_factors(std::size_t{cloth.grid[0]} * cloth.grid[1], load.factors, 0, 0x1p20f))
        return {"a factor of at least 0 for every particle"};
    if (!is_loaded(cloth, load)) return {"a particle with a cell and a factor above 0"};
    const bool pulls = load.force != Vec3{} || !load.force_keys.empty();
    return fault_unless(is_finite(load.force) && std::isfinite(load.pressure.value_or(0)) &&
                            are_keys(load.force_keys) && are_keys(load.pressure_keys) && !(pulls && load.presses()),
                        "either a finite force or a finite pressure, its keys at times that increase");
}

Fault fault_of_loads(const Cloth& cloth) {
    for (std::size_t k = 0; k < cloth.loads.size(); ++k)
        if (Fault fault = fault_of_load(cloth, cloth.loads[k]); !fault.expected.empty()) {
            fault.below = fmt::format("/{}", k);
            return fault;
        }
    return {};
}

/// Factors of every cell or particle, between two bounds.
struct Map {
    ClothKey key;
    std::vector<float> Cloth::*factors;
    bool of_cells;
    float least, most;
    const char* expected;
};
constexpr Map maps[] = {
    {ClothKey::cell_stiffness, &Cloth::cell_stiffness, true, 0x1p-20f, 1,
     "a factor of at most 1, and not 0, for every cell"},
    {ClothKey::cell_density, &Cloth::cell_density, true, 1, 0x1p20f, "a factor of at least 1 for every cell"},
    {ClothKey::cell_tear, &Cloth::cell_tear, true, 0x1p-20f, 0x1p20f, "a factor above 0 for every cell"},
    {ClothKey::particle_friction, &Cloth::particle_friction, false, 0, 0x1p20f,
     "a factor of at least 0 for every particle"},
    {ClothKey::particle_thickness, &Cloth::particle_thickness, false, 0, 1, "a factor from 0 to 1 for every particle"}};

Fault fault_of_map(const Cloth& cloth, ClothKey key) {
    const Map& map = *std::ranges::find(maps, key, &Map::key);
    const std::uint32_t less = map.of_cells ? 1 : 0;
    const std::size_t count = std::size_t{cloth.grid[0] - less} * (cloth.grid[1] - less);
    return fault_unless(has_factors(count, cloth.*map.factors, map.least, map.most), map.expected);
}

/// Explicit steps are chosen for the stiffness and the density that the cloth says, so no cell's shape may exceed them.
Fault fault_of_panel(const Cloth& cloth) {
    if (cloth.panel.empty()) return {};
    if (std::string fault = panel_fault(cloth); !fault.empty()) return {std::move(fault)};
    constexpr double rounding = 1e-5;
    const double stiffness = cloth.cell_stiffness.empty() ? 1 : std::ranges::max(cloth.cell_stiffness),
                 density = cloth.cell_density.empty() ? 1 : std::ranges::min(cloth.cell_density);
    const bool fits = (cloth.stiffness.rigid || stiffness * stiffest_shape(cloth) <= 1 + rounding) &&
                      density * std::ranges::min(cell_areas(cloth)) >= 1 - rounding && cloth.rest == Rest::flat;
    return fault_unless(fits, "cells no stiffer and no lighter than the cloth says, and a cloth that rests flat");
}

/// Judges one member of a cloth with a right grid. A new member of Cloth does not compile until it is judged here.
Fault fault_of(const Cloth& cloth, ClothKey key) {
    switch (key) {
        case ClothKey::name:
            return fault_unless(!cloth.name.empty(), "a name");
        case ClothKey::size:
            return fault_unless(std::ranges::all_of(cloth.size, is_positive), "lengths above 0");
        case ClothKey::placement:
            return fault_unless(can_be(cloth.placement), "finite lengths");
        case ClothKey::start:
            return {cloth.start.empty() ? "" : start_fault(cloth)};
        case ClothKey::panel:
            return fault_of_panel(cloth);
        case ClothKey::areal_density:
            return fault_unless(is_positive(cloth.areal_density), "a mass above 0");
        case ClothKey::stiffness:
            return fault_unless(can_be(cloth.stiffness),
                                "finite numbers of at least 0, and a compression of at most 1");
        case ClothKey::stiffness_keys:
            return fault_unless(are_keys(cloth.stiffness_keys) && can_change(cloth),
                                "factors from 0.001 to 1 at times that increase, of springs that are neither rigid nor "
                                "torn by a tension");
        case ClothKey::damping:
            return fault_unless(is_not_negative(cloth.damping), "a rate of at least 0");
        case ClothKey::friction:
            return fault_unless(is_not_negative(cloth.friction), "a coefficient of at least 0");
        case ClothKey::thickness:
            return fault_unless(is_not_negative(cloth.thickness), "a length of at least 0");
        case ClothKey::self_collision:
            return fault_unless(!cloth.self_collision || can_be(*cloth.self_collision),
                                "a thickness above 0 and a coefficient of at least 0");
        case ClothKey::velocity:
            return fault_unless(is_finite(cloth.velocity), "a finite velocity");
        case ClothKey::velocities:
            return {cloth.velocities.empty() ? "" : velocities_fault(cloth)};
        case ClothKey::holes: {
            const Fault fault =
                fault_of_boxes(cloth, cloth.holes.size(), [&](std::size_t k) { return cloth.holes[k]; });
            return fault.expected.empty() ? fault_unless(leaves_a_cell(cloth), "holes that leave a cell") : fault;
        }
        case ClothKey::cell_stiffness:
        case ClothKey::cell_density:
        case ClothKey::cell_tear:
        case ClothKey::particle_friction:
        case ClothKey::particle_thickness:
            return fault_of_map(cloth, key);
        case ClothKey::tear:
            return fault_unless(!cloth.tear || bears(cloth),
                                "either a strain or a tension above 0, of springs that are not rigid");
        case ClothKey::pins:
            return fault_of_boxes(cloth, cloth.pins.size(), [&](std::size_t k) { return cloth.pins[k].particles; });
        case ClothKey::loads:
            return fault_of_loads(cloth);
        // The grid was judged before; of the others every value is right.
        case ClothKey::grid:
        case ClothKey::rest:
        case ClothKey::contact:
        case ClothKey::appearance:
            return {};
    }
    return {};
}

bool is_body(const Collider& body) {
    return is_positive(*body.mass) && std::ranges::all_of(body.inertia.value_or(Vec3{1, 1, 1}), is_positive) &&
           is_finite(body.velocity) && is_finite(body.angular_velocity) && body.path.keys.empty() &&
           surface_area(body.shape) > 0;
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
        particle_count += std::uint64_t{cloth.grid[0]} * cloth.grid[1];
        expect(std::min(cloth.grid[0], cloth.grid[1]) >= 2 && particle_count <= scene_particle_limit,
               fmt::format("/cloths/{}/grid", i), "at least 2 x 2 particles and no more than a scene may have");
        expect(names.insert(cloth.name).second, fmt::format("/cloths/{}/name", i), "a name no other cloth has");
    }
    expect(are_keys(scene.gravity_keys), "/gravity_keys", "numbers at times that increase");
    expect(are_keys(scene.wind.keys), "/wind/keys", "numbers at times that increase");
    for (std::size_t i = 0; i < scene.cloths.size() && result.errors.empty(); ++i)
        for (const ClothKey key : cloth_keys) {
            const Fault fault = fault_of(scene.cloths[i], key);
            expect(fault.expected.empty(), fmt::format("/cloths/{}{}{}", i, pointer_of(key), fault.below),
                   fault.expected.c_str());
        }
    expect(scene.time.frame_count > 0 && scene.time.fps > 0 && std::isfinite(scene.time.fps), "/time", "frames");
    expect(scene.solver.substeps > 0 && scene.solver.iterations > 0, "/solver", "at least one substep and iteration");
    expect(std::ranges::min(scene.image.size) > 0 && (scene.image.samples == 1 || scene.image.samples == 4), "/image",
           "pixels, of 1 or 4 samples");
    expect(scene.lights.size() <= 4, "/lights", "at most 4 lights");
    for (std::size_t i = 0; i < scene.colliders.size(); ++i)
        if (const Collider& body = scene.colliders[i]; body.mass)
            expect(is_body(body), fmt::format("/colliders/{}/mass", i),
                   "a mass above 0 of a collider that is no plane and has no path");
    if (const std::optional<BodyFault> fault = body_fault(scene))
        expect(false, fmt::format("/colliders/{}/mass", fault->collider), fault->expected.c_str());
    if (result.errors.empty() && scene.overlap == Overlap::refuse)
        for (const StartOverlap& overlap : start_overlaps(scene))
            expect(false, fmt::format("/cloths/{}", overlap.cloth),
                   ("a start outside all colliders: " + overlap_text(scene, overlap)).c_str());
    if (result.errors.empty() && cloths_meet(scene))
        for (const StartCrossing& crossing : start_crossings(scene))
            expect(!is_refused(scene, crossing), fmt::format("/cloths/{}", crossing.second),
                   ("cloths that start apart: " + crossing_text(scene, crossing)).c_str());
    if (result.errors.empty())
        for (const SeamFault& fault : seam_faults(scene))
            result.errors.push_back({"scene", 0, 0, "/seams" + fault.below, fault.text});
    if (result.errors.empty())
        for (const GasFault& fault : gas_faults(scene))
            result.errors.push_back({"scene", 0, 0, "/gas" + fault.below, fault.text});
    if (!result.errors.empty()) throw SceneFailure(std::move(result));
    return scene;
}

}  // namespace drape
