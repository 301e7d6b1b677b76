#include "cloth/members.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <type_traits>

#include "world/cloth_keys.h"
#include "world/weather.h"

namespace drape {

namespace {

using Difference = std::optional<std::string>;

/// On a CPU a dispatch costs as much as the contact of a few hundred particles, and in a shared dispatch each
/// invocation has to find out whose particle it has.
constexpr std::size_t most_meeting_particles = std::size_t{24} * 24;

template <class Value>
Difference differ(const std::string& pointer, const Value& first, const std::type_identity_t<Value>& other) {
    if (first == other) return std::nullopt;
    return fmt::format("{} is {}, not {}", pointer, other, first);
}

std::string kinds(const std::vector<Collider>& colliders) {
    std::vector<std::string> names;
    for (const Collider& collider : colliders)
        names.push_back(std::string(collider_lists[collider.shape.index()]) + (collider.mass ? " (with a mass)" : ""));
    std::ranges::sort(names);
    return names.empty() ? "none" : fmt::format("{}", fmt::join(names, " "));
}

std::string controls(const SceneDescription& scene) {
    if (!scene.actions) return "none";
    std::string text = fmt::format("hands of cloths [{}]", fmt::join(scene.actions->controls.hands, " "));
    for (const auto& control : control_spellings)
        if (scene.actions->controls.*control.value) text += fmt::format(", {}", control.name);
    return text;
}

std::string boxes(const std::vector<IndexBox>& boxes) {
    std::string text;
    for (const IndexBox& box : boxes)
        text += fmt::format("{}{}-{}", text.empty() ? "" : ", ", fmt::join(box.first, " "), fmt::join(box.last, " "));
    return text.empty() ? "none" : text;
}

Difference map_difference(const std::string& pointer, const std::vector<float>& first,
                          const std::vector<float>& other) {
    if (first.empty() || other.empty())
        return differ(pointer, first.empty() ? "absent" : "there", other.empty() ? "absent" : "there");
    return first == other ? std::nullopt : Difference(pointer + " has other values");
}

std::string pins(const std::vector<Pin>& pins) {
    std::vector<IndexBox> held;
    std::string moves;
    for (const Pin& pin : pins) {
        held.push_back(pin.particles);
        moves += fmt::format(" {}{}", pin.path.keys.empty() ? "at rest" : "moving", pin.release ? ", released" : "");
    }
    return boxes(held) + moves;
}

std::string loads(const std::vector<Load>& loads) {
    std::vector<IndexBox> loaded;
    std::string kinds;
    for (const Load& load : loads) {
        loaded.push_back(load.particles);
        kinds += load.presses() ? " pressed" : " pulled";
    }
    return boxes(loaded) + kinds;
}

std::string gases(const SceneDescription& scene) {
    std::string text;
    for (const Gas& gas : scene.gas)
        text += fmt::format("{}in [{}]", text.empty() ? "" : ", ", fmt::join(gas.cloths, " "));
    return text.empty() ? "none" : text;
}

/// Returns how two cloths differ in shape by one key.
Difference cloth_difference(ClothKey key, const std::string& at, const Cloth& first, const Cloth& other) {
    const std::string pointer = fmt::format("{}{}", at, pointer_of(key));
    const auto grid = [](const Cloth& cloth) { return fmt::format("{} x {}", cloth.grid[0], cloth.grid[1]); };
    const auto text = [](bool is) { return std::string(is ? "true" : "false"); };
    const auto there = [](bool is) { return std::string(is ? "there" : "absent"); };
    switch (key) {
        case ClothKey::name:
            return differ(pointer, first.name, other.name);
        case ClothKey::grid:
            return differ(pointer, grid(first), grid(other));
        case ClothKey::holes:
            return differ(pointer, boxes(first.holes), boxes(other.holes));
        case ClothKey::cell_stiffness:
            return map_difference(pointer, first.cell_stiffness, other.cell_stiffness);
        case ClothKey::cell_density:
            return map_difference(pointer, first.cell_density, other.cell_density);
        case ClothKey::particle_friction:
            return map_difference(pointer, first.particle_friction, other.particle_friction);
        case ClothKey::particle_thickness:
            return map_difference(pointer, first.particle_thickness, other.particle_thickness);
        case ClothKey::pins:
            return differ(pointer, pins(first.pins), pins(other.pins));
        case ClothKey::loads:
            return differ(pointer, loads(first.loads), loads(other.loads));
        case ClothKey::stiffness_keys:
            return differ(pointer, there(!first.stiffness_keys.empty()), there(!other.stiffness_keys.empty()));
        case ClothKey::stiffness:
            return differ(pointer + "/rigid", text(first.stiffness.rigid), text(other.stiffness.rigid));
        case ClothKey::panel:
            return differ(pointer, there(!first.panel.empty()), there(!other.panel.empty()));
        case ClothKey::rest:
            return differ(pointer, spelling(rest_spellings, first.rest), spelling(rest_spellings, other.rest));
        case ClothKey::contact:
            return differ(pointer, spelling(contact_spellings, first.contact),
                          spelling(contact_spellings, other.contact));
        case ClothKey::self_collision:
            return differ(pointer, there(first.self_collision.has_value()), there(other.self_collision.has_value()));
        // Each member has its own values of these.
        case ClothKey::size:
        case ClothKey::placement:
        case ClothKey::start:
        case ClothKey::areal_density:
        case ClothKey::damping:
        case ClothKey::friction:
        case ClothKey::thickness:
        case ClothKey::velocity:
        case ClothKey::velocities:
        case ClothKey::appearance:
        // sharing_obstacle handles scenes that tear.
        case ClothKey::tear:
        case ClothKey::cell_tear:
            return std::nullopt;
    }
    return std::nullopt;
}

Difference solver_difference(const SolverSettings& first, const SolverSettings& other) {
    for (const Difference& found :
         {differ("/solver/method", named(first.method).name, named(other.method).name),
          differ("/solver/substeps", first.substeps, other.substeps),
          differ("/solver/iterations", first.iterations, other.iterations),
          differ("/solver/tolerance", first.tolerance, other.tolerance),
          differ("/solver/collide", spelling(collide_spellings, first.collide),
                 spelling(collide_spellings, other.collide)),
          differ("/solver/tethers", first.tethers, other.tethers),
          differ("/solver/estimate_error", first.estimate_error.value_or(false), other.estimate_error.value_or(false))})
        if (found) return found;
    return std::nullopt;
}

}  // namespace

std::optional<std::string> shape_difference(const SceneDescription& first, const SceneDescription& other) {
    const auto blows = [](const SceneDescription& scene) {
        return std::string(scene.wind.blows() ? "blowing" : "none");
    };
    const auto forces = [](const SceneDescription& scene) {
        return std::string(scene.force_fields   ? "fields"
                           : scene.worst_forces ? "worst"
                           : scene.forces       ? "true"
                                                : "false");
    };
    const auto weight = [](const SceneDescription& scene) {
        return std::string(gravity_changes(scene) ? "changing" : "steady");
    };
    if (auto found = differ("/cloths", fmt::format("a list of {}", first.cloths.size()),
                            fmt::format("a list of {}", other.cloths.size())))
        return found;
    for (std::size_t k = 0; k < first.cloths.size(); ++k)
        for (const ClothKey key : cloth_keys)
            if (auto found = cloth_difference(key, fmt::format("/cloths/{}", k), first.cloths[k], other.cloths[k]))
                return found;
    for (const Difference& found :
         {differ("/time/fps", first.time.fps, other.time.fps), differ("/forces", forces(first), forces(other)),
          differ("/colliders", kinds(first.colliders), kinds(other.colliders)),
          differ("/actions", controls(first), controls(other)), differ("/wind", blows(first), blows(other)),
          differ("/gravity_keys", weight(first), weight(other)),
          differ("/seams", fmt::format("a list of {}", first.seams.size()),
                 fmt::format("a list of {}", other.seams.size())),
          differ("/gas", gases(first), gases(other)),
          differ("/cutters", fmt::format("a list of {}", first.cutters.size()),
                 fmt::format("a list of {}", other.cutters.size()))})
        if (found) return found;
    return solver_difference(first.solver, other.solver);
}

std::optional<std::string> sharing_obstacle(const SimulationModel& model) {
    if (model.sewn_count > 0) return "sewn cloths take turns";
    if (model.closed_loop() && model.self_contact)
        return "method auto does a frame again where lists of contact are too short, in each member by itself";
    if (model.closed_loop() && body_count(model) > 0)
        return "method auto does frames of one member again, and bodies that cloth moves are moved in all at once";
    if (model.has_companions() && !model.closed_loop()) return "companion runs estimate the error of each member";
    const auto is_large = [](const ClothModel& cloth) { return cloth.grid.particle_count() > most_meeting_particles; };
    if (model.self_contact && model.options.device == DeviceKind::cpu && std::ranges::any_of(model.cloths, is_large))
        return "on a CPU, contact of cloths so large takes as long one after the other";
    if (model.self_contact && !model.self_contact->crossed.empty())
        return "cloths that start through each other are worked apart, in each member as long as it takes";
    if (model.scene.comes_apart()) return "cuts and tears make the members' cloths differ";
    if (!model.mesh_fields.empty()) return "distances to meshes are known as far as each member's contact asks";
    if (std::ranges::any_of(model.cloths, &ClothModel::stiffens))
        return "a stiffness that changes is given to one cloth at a time";
    if (model.adaptive()) return "iterations end by the tolerance, in each member after a number of its own";
    return std::nullopt;
}

void join_inputs(const SimulationModel& all, const std::vector<FrameInputs>& members, FrameInputs& joined) {
    joined.wind.clear();
    joined.colliders.clear();
    joined.body_actions.clear();
    joined.pins.resize(all.cloths.size());
    auto pins = joined.pins.begin();
    for (const FrameInputs& one : members) {
        joined.wind.insert(joined.wind.end(), one.wind.begin(), one.wind.end());
        joined.body_actions.insert(joined.body_actions.end(), one.body_actions.begin(), one.body_actions.end());
        pins = std::ranges::copy(one.pins, pins).out;
    }
    const std::uint32_t sets = all.colliders_move ? all.scene.solver.substeps : 1;
    for (std::uint32_t set = 0; set < sets; ++set)
        for (const FrameInputs& one : members) {
            const auto count = static_cast<std::ptrdiff_t>(one.colliders.size() / one.collider_sets);
            const auto first = one.colliders.begin() + (one.collider_sets > 1 ? set * count : 0);
            joined.colliders.insert(joined.colliders.end(), first, first + count);
        }
}

}  // namespace drape
