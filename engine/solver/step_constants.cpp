#include <algorithm>
#include <stdexcept>

#include "cloth/cyclic_lines.h"
#include "cloth/directions.h"
#include "cloth/kernel_steps.h"
#include "solver/step_size.h"

namespace drape {

namespace {

using Place = const StepPlace&;

std::uint32_t direction_bits(Place p) {
    std::uint32_t bits = 0;
    for (int d = 0; d < static_cast<int>(spring_directions.size()); ++d)
        if (has_direction(p.step.push<glsl::AllSpringsPush>(), d)) bits |= 1u << d;
    return bits;
}

glsl::ivec2 group_of_lines(Place p) { return cyclic_group(p.step.push<glsl::LinePush>().particle_count); }

std::uint32_t group_width(Place p) {
    if (p.step.kind == StepKind::nested) return nested_group(p);
    if (p.step.kernel == Kernel::line_parts)
        return parts_group(p.step.push<glsl::LinePush>().particle_count, p.step.subgroup);
    return static_cast<std::uint32_t>(group_of_lines(p).x);
}

struct ConstantRow {
    std::string_view name;
    std::uint32_t (*value)(Place);
};

constexpr ConstantRow constant_rows[] = {
    {"advance", [](Place p) { return p.step.substep > 0 ? 1u : 0u; }},
    {"again", [](Place p) { return p.step.after_edges ? 1u : 0u; }},
    {"cloth_count", [](Place p) { return static_cast<std::uint32_t>(p.model.cloths.size()); }},
    {"member_count", [](Place p) { return static_cast<std::uint32_t>(p.model.member_count); }},
    {vulkan::subgroup_constant, [](Place p) { return p.step.subgroup; }},
    {"directions", direction_bits},
    {"entries_each", [](Place p) { return p.device.entries_each(); }},
    {"first_iteration", [](Place p) { return p.step.iteration == 0 ? 1u : 0u; }},
    {"halo", [](Place p) { return tile_of(p.step.kind, p.cloth->model->grid).halo; }},
    {"has_bend", [](Place p) { return p.step.push<glsl::ExplicitPush>().twist > 0 ? 1u : 0u; }},
    {"has_shear", [](Place p) { return p.step.push<glsl::ExplicitPush>().relative_stiffness.z > 0 ? 1u : 0u; }},
    {"has_skin", [](Place p) { return (*p.cloth)[Field::skin].valid() ? 1u : 0u; }},
    {"has_skins", [](Place p) { return (*p.contact)[ContactField::skins].valid() ? 1u : 0u; }},
    {"local_size_x", group_width},
    {"local_size_y", [](Place p) { return static_cast<std::uint32_t>(group_of_lines(p).y); }},
    {"own_rest", [](Place p) { return p.cloth->own_rest(); }},
    {"steps", [](Place p) { return p.step.count; }},
    {"strip_columns", [](Place p) { return p.device.strip_columns(); }},
    {"strip_length", [](Place p) { return p.device.strip_length(); }},
    {"strip_rows", [](Place p) { return p.device.strip_rows(step_rounds(p)); }},
    {"weighs", [](Place p) { return p.model.weighs ? 1u : 0u; }},
    {"turns", [](Place p) { return p.step.turns ? 1u : 0u; }},
};

}  // namespace

std::optional<std::uint32_t> scene_constant(const SimulationModel& model, std::string_view name) {
    if (name == "leaves_out") return model.options.skip ? 1u : 0u;
    if (name == "round_count") return model.collision_rounds();
    const auto ends = kind_ends(model.scene.colliders);
    for (std::size_t kind = 0; kind < ends.size(); ++kind)
        if (name == std::string(collider_lists[kind]) + "_end") return ends[kind];
    return std::nullopt;
}

std::uint32_t step_constant(const StepPlace& place, std::string_view name) {
    const auto row = std::ranges::find(constant_rows, name, &ConstantRow::name);
    if (row != std::end(constant_rows)) return row->value(place);
    if (const auto value = scene_constant(place.model, name)) return *value;
    throw std::logic_error("nobody gives constant '" + std::string(name) + "' a value");
}

}  // namespace drape
