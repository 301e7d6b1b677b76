#include "cloth/cloth_geometry.h"

#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "cloth/loads.h"
#include "cloth/tear.h"
#include "cloth/texels.h"
#include "world/contact_shape.h"
#include "world/start.h"
#include "world/weather.h"

namespace drape {

ClothGeometry::ClothGeometry(const SceneDescription& scene, const Cloth& cloth, bool keeps_masks,
                             const ClothActions& actions)
    : name(cloth.name),
      grid(cloth),
      stiffens(!cloth.stiffness_keys.empty()),
      start_stiffness(static_cast<float>(stiffness_factor(scene, cloth, 0))),
      starts_masked(!grid.whole() || stiffens || keeps_masks || cloth.rest == Rest::start || !cloth.panel.empty()),
      placement(cloth.placement),
      is_given(!cloth.start.empty()),
      start_strain(drape::start_strain(cloth)),
      spacing(grid_spacing(cloth)),
      inner_mass(cloth.areal_density * spacing[0] * spacing[1]),
      damping(cloth.damping),
      velocity(cloth.velocity),
      velocities(cloth.velocities),
      start_speed(drape::start_speed(cloth)),
      rigid(cloth.stiffness.rigid),
      compression(static_cast<float>(cloth.stiffness.compression)),
      bend(cloth.stiffness.bend.largest()),
      stiffness_constant(stiffness_constants(cloth.stiffness, spacing)),
      shows_crumbs(std::ranges::any_of(scene.cutters, &Cutter::crumbs)) {
    // An axis of two particles has no bending elements, so explicit steps may ignore their stiffness.
    if (grid.columns() < 3) stiffness_constant.bend[0] = 0;
    if (grid.rows() < 3) stiffness_constant.bend[1] = 0;
    place(cloth);
    sew(sewn_particles(scene, cloth));
    if (cloth.rest == Rest::start || !cloth.panel.empty())
        for (const std::array<double, 4>& ratio : rest_ratios(cloth))
            rest_scales.push_back({static_cast<float>(ratio[0]), static_cast<float>(ratio[1]),
                                   static_cast<float>(ratio[2]), static_cast<float>(ratio[3])});
    for (const std::array<double, 2>& at : cloth.panel)
        panel.push_back({static_cast<float>(at[0]), static_cast<float>(at[1]), 0, 0});
    hold_pins(cloth.pins);
    for (const Sewn& each : sewn)
        if (each.held) position[each.particle].w = 0;
    has_release = has_release || (actions.holds && has_motion);
    add_hands(actions.hands);
    if (bend == 0) skipped.push_back({name + "/bending", "zero rigidity"});
    if (scene.solver.tethers) set_tethers(scene, cloth);
    load_depth = drape::load_depth(cloth);
    loads = load_texels(cloth, grid);
    if (cloth.tear) tear_limits = drape::tear_limits(cloth, grid);
    if (has_skin(cloth))
        for (std::size_t particle = 0; particle < position.size(); ++particle)
            skin.push_back({static_cast<float>(cloth.thickness * double{thickness_factor(cloth, particle)}),
                            static_cast<float>(std::sqrt(cloth.friction * double{friction_factor(cloth, particle)}))});
}

Vec3 ClothGeometry::start_direction(std::uint32_t particle, std::size_t axis) const {
    const Vec3& placed = axis == 0 ? placement.u : placement.v;
    if (!is_given) return placed;
    const std::uint32_t place = axis == 0 ? particle % grid.columns() : particle / grid.columns();
    const std::uint32_t step = axis == 0 ? 1 : grid.columns();
    const std::uint32_t first = place > 0 ? particle - step : particle, last = first + step;
    const glsl::vec4 &from = position[first], &to = position[last];
    const Vec3 way{double(to.x) - from.x, double(to.y) - from.y, double(to.z) - from.z};
    const double size = length(way);
    return size > 0 ? times(1 / size, way) : placed;
}

float ClothGeometry::rest_length(float flat, std::size_t particle, std::size_t direction) const {
    return rest_scales.empty() ? flat : flat * component(rest_scales[particle], direction);
}

float ClothGeometry::reach() const {
    float largest = 1;
    for (const glsl::vec4& scales : rest_scales) largest = std::max({largest, scales.x, scales.y});
    return largest * static_cast<float>(std::hypot(spacing[0] * (grid.columns() - 1), spacing[1] * (grid.rows() - 1)));
}

double ClothGeometry::start_bending() const {
    if (bend == 0 || !is_given || (rests_bent() && panel.empty())) return 0;
    const auto at = [this](std::uint32_t column, std::uint32_t row) {
        const glsl::vec4& texel = position[grid.particle(column, row)];
        return Vec3{double{texel.x}, double{texel.y}, double{texel.z}};
    };
    double doubled = 0;
    const auto add = [&](double constant, const Vec3& difference) {
        doubled += constant * dot(difference, difference);
    };
    for (std::uint32_t row = 0; row < grid.rows(); ++row)
        for (std::uint32_t column = 0; column < grid.columns(); ++column) {
            const Vec3 here = at(column, row);
            if (column > 1)
                add(stiffness_constant.bend[0], minus(plus(here, at(column - 2, row)), times(2, at(column - 1, row))));
            if (row > 1)
                add(stiffness_constant.bend[1], minus(plus(here, at(column, row - 2)), times(2, at(column, row - 1))));
            if (column > 0 && row > 0)
                add(stiffness_constant.twist,
                    minus(plus(here, at(column - 1, row - 1)), plus(at(column - 1, row), at(column, row - 1))));
        }
    return doubled / 2;
}

void ClothGeometry::place(const Cloth& cloth) {
    const std::vector<Vec3> start = start_positions(cloth);
    for (std::uint32_t row = 0; row < grid.rows(); ++row)
        for (std::uint32_t column = 0; column < grid.columns(); ++column) {
            free_weight.push_back(grid.relative_inverse_mass(column, row));
            position.push_back(texel(start[grid.particle(column, row)], free_weight.back()));
        }
    if (!starts_masked)
        skipped.push_back({name + "/spring shares",
                           "no holes, maps, cuts or stiffness keys: the grid's extent gives every stiffness"});
}

void ClothGeometry::sew(std::vector<Sewn> particles) {
    sewn = std::move(particles);
    const auto differs = [this](const Sewn& each) {
        return each.velocity != (velocities.empty() ? velocity : velocities[each.particle]);
    };
    if (std::ranges::any_of(sewn, differs)) velocities.resize(position.size(), velocity);
    for (const Sewn& each : sewn) {
        free_weight[each.particle] = each.sewn.weights.y;
        position[each.particle] = texel(each.start, free_weight[each.particle]);
        if (!velocities.empty()) velocities[each.particle] = each.velocity;
        start_speed = std::max(start_speed, length(each.velocity));
    }
}

void ClothGeometry::set_tethers(const SceneDescription& scene, const Cloth& cloth) {
    if (cloth.pins.empty()) return skipped.push_back({name + "/tethers", "no pins to hold on to"});
    tethers = find_tethers(grid, spacing, cloth.pins, tether_give(cloth, strongest_gravity(scene)), rest_scales);
    if (scene.comes_apart())
        skipped.push_back(
            {name + "/tethers after a cut", "what was cut off hangs on nothing: the first cut ends them"});
}

void ClothGeometry::hold_pins(const std::vector<Pin>& pins) {
    // A later pin overrides an earlier one on the particles that they share.
    std::vector<int> owner(grid.particle_count(), -1);
    for (std::size_t pin = 0; pin < pins.size(); ++pin) {
        const IndexBox& box = pins[pin].particles;
        for (std::uint32_t row = box.first[1]; row <= box.last[1]; ++row)
            for (std::uint32_t column = box.first[0]; column <= box.last[0]; ++column)
                owner[grid.particle(column, row)] = static_cast<int>(pin);
    }
    std::vector<int> dynamic_index(pins.size(), -1);
    std::vector<std::vector<std::uint32_t>> held(pins.size());
    for (std::uint32_t particle = 0; particle < owner.size(); ++particle) {
        if (owner[particle] < 0) continue;
        position[particle].w = 0;
        held[static_cast<std::size_t>(owner[particle])].push_back(particle);
    }
    for (std::size_t index = 0; index < pins.size(); ++index) {
        const Pin& pin = pins[index];
        const bool moves = !pin.path.keys.empty();
        if ((!moves && !pin.release) || held[index].empty()) continue;
        has_motion = has_motion || moves;
        has_release = has_release || pin.release.has_value();
        Vec3 centroid{};
        for (const std::uint32_t particle : held[index]) {
            centroid[0] += static_cast<double>(position[particle].x) / static_cast<double>(held[index].size());
            centroid[1] += static_cast<double>(position[particle].y) / static_cast<double>(held[index].size());
            centroid[2] += static_cast<double>(position[particle].z) / static_cast<double>(held[index].size());
        }
        for (const std::uint32_t particle : held[index]) {
            const glsl::vec4 at = position[particle];
            pinned.push_back({{at.x, at.y, at.z, free_weight[particle]},
                              {static_cast<int>(particle % grid.columns()), static_cast<int>(particle / grid.columns()),
                               static_cast<int>(dynamic_pins.size()), 0}});
        }
        dynamic_pins.push_back({pin.path, pin.pivot.value_or(centroid), pin.release, index});
    }
}

void ClothGeometry::add_hands(const std::vector<std::size_t>& hands) {
    for (const std::size_t hand : hands) {
        for (std::uint32_t particle = 0; particle < position.size(); ++particle) {
            const glsl::vec4 at = position[particle];
            if (free_weight[particle] > 0)
                pinned.push_back(
                    {{at.x, at.y, at.z, free_weight[particle]},
                     {static_cast<int>(particle % grid.columns()), static_cast<int>(particle / grid.columns()),
                      static_cast<int>(dynamic_pins.size()), 0}});
        }
        dynamic_pins.push_back(
            {.path = {}, .pivot = {}, .release = -1, .number = 0, .hand = hand, .held = no_particles});
        has_motion = has_release = true;
    }
    if (!has_motion) skipped.push_back({name + "/pin motion", "no pin has a path"});
    if (!has_release) skipped.push_back({name + "/pin release", "no pin is released"});
}

}  // namespace drape
