// The members of `Cloth` as values, for rooms that must say what each of them means to them. Such a room switches over
// `ClothKey` without a `default`, so that a new member compiles neither here nor in any of these rooms before it is
// handled.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <utility>

#include "drape/scene.h"

namespace drape {

/// In the order of the members.
enum class ClothKey {
    name,
    grid,
    size,
    placement,
    start,
    rest,
    panel,
    areal_density,
    stiffness,
    stiffness_keys,
    damping,
    friction,
    thickness,
    contact,
    self_collision,
    velocity,
    velocities,
    holes,
    cell_stiffness,
    cell_density,
    tear,
    cell_tear,
    particle_friction,
    particle_thickness,
    pins,
    loads,
    appearance
};

/// The places of the members in a scene file, relative to a cloth.
inline constexpr std::string_view cloth_key_pointers[] = {
    "/name",           "/grid",          "/size",           "/placement",      "/start",         "/rest",
    "/outline",        "/areal_density", "/stiffness",      "/stiffness_keys", "/damping",       "/friction",
    "/thickness",      "/contact",       "/self_collision", "/velocity",       "/velocities",    "/holes",
    "/maps/stiffness", "/maps/density",  "/tear",           "/maps/tear",      "/maps/friction", "/maps/thickness",
    "/pins",           "/loads",         "/appearance"};
constexpr std::string_view pointer_of(ClothKey key) { return cloth_key_pointers[static_cast<std::size_t>(key)]; }

/// Returns references to all members, in their order. The binding names each member, so a new one does not compile.
inline auto members_of(const Cloth& cloth) {
    const auto& [name, grid, size, placement, start, rest, panel, areal_density, stiffness, stiffness_keys, damping,
                 friction, thickness, contact, self_collision, velocity, velocities, holes, cell_stiffness,
                 cell_density, tear, cell_tear, particle_friction, particle_thickness, pins, loads, appearance] = cloth;
    return std::tie(name, grid, size, placement, start, rest, panel, areal_density, stiffness, stiffness_keys, damping,
                    friction, thickness, contact, self_collision, velocity, velocities, holes, cell_stiffness,
                    cell_density, tear, cell_tear, particle_friction, particle_thickness, pins, loads, appearance);
}
inline constexpr std::size_t cloth_key_count = std::tuple_size_v<decltype(members_of(std::declval<Cloth>()))>;
static_assert(std::size(cloth_key_pointers) == cloth_key_count);
static_assert(static_cast<std::size_t>(ClothKey::appearance) + 1 == cloth_key_count, "a key has no value, or two");

inline constexpr auto cloth_keys = [] {
    std::array<ClothKey, cloth_key_count> keys{};
    for (std::size_t k = 0; k < keys.size(); ++k) keys[k] = static_cast<ClothKey>(k);
    return keys;
}();

/// Returns, by key, whether two cloths have different values.
inline std::array<bool, cloth_key_count> differences(const Cloth& one, const Cloth& other) {
    return [&]<std::size_t... member>(std::index_sequence<member...>) {
        return std::array{!(std::get<member>(members_of(one)) == std::get<member>(members_of(other)))...};
    }
    (std::make_index_sequence<cloth_key_count>());
}

}  // namespace drape
