#include "solver/step_size.h"

#include <algorithm>

#include "cloth/cyclic_lines.h"
#include "cloth/kernel_steps.h"
#include "cloth/nested_boxes.h"
#include "shared/parts_types.h"
#include "shared/residual_types.h"
#include "shared/stream_types.h"

namespace drape {

namespace {

std::uint32_t whole(int value) { return static_cast<std::uint32_t>(value); }
std::uint32_t parts(std::uint32_t size, std::uint32_t each) { return (size - 1) / each + 1; }

glsl::ivec2 grid_of(const StepPlace& place) { return place.cloth->model->grid.size(); }

DispatchSize of_cloths(const StepPlace& place, std::uint32_t width, std::uint32_t height) {
    return {width, height, place.cloth->count()};
}

/// An invocation loops over this much for contact of its particle with one collider of a kind.
struct KindLoops {
    std::size_t newton;  ///< rounds of the root that its distance is
    bool edges;          ///< the pass of edges looks at it
};
/// In the order of the kinds: plane, sphere, box, ellipsoid, capsule, mesh.
constexpr KindLoops kind_loops[] = {{0, false}, {0, false}, {0, true}, {24, false}, {0, false}, {0, true}};
static_assert(std::size(kind_loops) == std::variant_size_v<ColliderShape>);

/// Returns the sum over the model's colliders.
template <class Count>
std::size_t sum_of(const SimulationModel& model, Count KindLoops::*count) {
    std::size_t sum = 0;
    for (const Collider& collider : model.scene.colliders) sum += kind_loops[collider.shape.index()].*count;
    return sum;
}

std::span<const glsl::ivec4> nested_pins(const StepPlace& place, const ClothModel& cloth) {
    const std::span<const glsl::ivec4> table = cloth.scheme.nested_table;
    const auto first = static_cast<std::size_t>(place.step.push<glsl::NestedPush>().first_pin);
    return table.subspan(first, static_cast<std::size_t>(table[first].z));
}

/// Invocations of strips of `width` columns that overlap by `halo` on either side, times bands of rows.
DispatchSize over_stream(const StepPlace& place, int width, int halo) {
    const glsl::ivec2 grid = grid_of(place);
    const int own = width - 2 * halo;
    const int strips = grid.x <= width ? 1 : (grid.x - 2 * halo + own - 1) / own;
    return of_cloths(place, whole(strips * glsl::stream_lanes), whole(std::max(1, grid.y / glsl::stream_band)));
}

}  // namespace

std::size_t step_rounds(const StepPlace& place) {
    if (place.step.kind == StepKind::collide) {
        // Each round goes over all colliders: twice over each that is not among the early ones, and twice over what
        // Newton's method needs.
        const std::size_t count = place.model.scene.colliders.size();
        return place.model.collision_rounds() * (1 + 2 * count + 2 * sum_of(place.model, &KindLoops::newton)) + count;
    }
    // One finds whether the particle is near each box or mesh, then each is met by each triangle around it.
    constexpr std::size_t triangles = 6;
    if (place.step.kind == StepKind::collider_edges)
        return 2 + sum_of(place.model, &KindLoops::edges) * (2 + triangles);
    return 1;
}

std::uint32_t nested_group(const StepPlace& place) {
    constexpr int subgroup = 8, most = glsl::nested_group_width;
    int width = place.cloth->buffered ? subgroup : most;
    const auto takes_too_many = [&](std::size_t index) {
        const ClothModel& cloth = place.model.cloths[index];
        return std::ranges::any_of(nested_pins(place, cloth), [&](const glsl::ivec4& pin) {
            return nested_rounds(cloth.scheme, place.step.push<glsl::NestedPush>(), {pin.x, pin.y}, width) >
                   most_loop_rounds;
        });
    };
    while (width < most && std::ranges::any_of(place.cloth->cloths, takes_too_many)) width *= 2;
    return whole(width);
}

DispatchSize one_invocation(const StepPlace& place, const ComputePipeline&) {
    return {1, 1, place.cloth ? place.cloth->count() : 1};
}

DispatchSize one_workgroup(const StepPlace& place, const ComputePipeline&) {
    return of_cloths(place, glsl::workgroup_width, 1);
}

DispatchSize over_bodies(const StepPlace& place, const ComputePipeline&) {
    return {static_cast<std::uint32_t>(body_count(place.model))};
}

DispatchSize one_workgroup_of_bodies(const StepPlace&, const ComputePipeline&) { return {glsl::workgroup_width}; }

DispatchSize over_particles(const StepPlace& place, const ComputePipeline&) {
    return of_cloths(place, whole(grid_of(place).x), whole(grid_of(place).y));
}

DispatchSize over_strips(const StepPlace& place, const ComputePipeline&) {
    const auto [across, down] = place.device.over_strips(grid_of(place));
    return of_cloths(place, across, down);
}

DispatchSize over_columns(const StepPlace& place, const ComputePipeline&) {
    return of_cloths(place, whole(grid_of(place).x),
                     parts(whole(grid_of(place).y), place.device.strip_rows(step_rounds(place))));
}

DispatchSize over_wide_columns(const StepPlace& place, const ComputePipeline& pipeline) {
    DispatchSize size = over_columns(place, pipeline);
    size.width = parts(size.width, place.device.strip_columns());
    return size;
}

DispatchSize over_pins(const StepPlace& place, const ComputePipeline&) {
    return {static_cast<std::uint32_t>(place.cloth->pinned_count)};  // the list is of all cloths together
}

DispatchSize over_sewn_particles(const StepPlace& place, const ComputePipeline&) {
    return {whole(place.step.push<glsl::SeamPush>().particle_count)};
}

DispatchSize over_springs(const StepPlace& place, const ComputePipeline&) {
    const glsl::ivec2 count = place.step.push<glsl::SpringPush>().pair_count;
    return of_cloths(place, whole(count.x), whole(count.y));
}

DispatchSize over_bends(const StepPlace& place, const ComputePipeline&) {
    const glsl::ivec2 count = place.step.push<glsl::BendPush>().element_count;
    return of_cloths(place, whole(count.x), whole(count.y));
}

DispatchSize over_twists(const StepPlace& place, const ComputePipeline&) {
    const glsl::ivec2 count = place.step.push<glsl::TwistPush>().element_count;
    return of_cloths(place, whole(count.x), whole(count.y));
}

DispatchSize over_lines(const StepPlace& place, const ComputePipeline&) {
    return of_cloths(place, whole(place.step.push<glsl::LinePush>().line_count), 1);
}

DispatchSize over_line_particles(const StepPlace& place, const ComputePipeline&) {
    const auto& push = place.step.push<glsl::LinePush>();
    return of_cloths(place, whole(cyclic_group(push.particle_count).x), whole(push.line_count));
}

DispatchSize over_line_parts(const StepPlace& place, const ComputePipeline& pipeline) {
    const auto& push = place.step.push<glsl::LinePush>();
    return of_cloths(place, pipeline.local_size()[0], parts(whole(push.line_count), glsl::part_lines));
}

DispatchSize over_nested_pins(const StepPlace& place, const ComputePipeline& pipeline) {
    return of_cloths(
        place, static_cast<std::uint32_t>(nested_pins(place, *place.cloth->model).size()) * pipeline.local_size()[0],
        1);
}

DispatchSize over_gas_sums(const StepPlace& place, const ComputePipeline&) {
    return of_cloths(place, gas_sum_count(*place.cloth->model) * glsl::workgroup_width, 1);
}

DispatchSize over_torque_sums(const StepPlace& place, const ComputePipeline&) {
    return of_cloths(place, torque_count(place.cloth->model->grid) * glsl::workgroup_width, 1);
}

DispatchSize over_explicit_stream(const StepPlace& place, const ComputePipeline&) {
    return over_stream(place, glsl::stream_width, static_cast<int>(place.step.count));
}

DispatchSize over_spring_stream(const StepPlace& place, const ComputePipeline&) {
    return over_stream(place, glsl::spring_stream_width, glsl::spring_stream_halo);
}

DispatchSize over_twist_stream(const StepPlace& place, const ComputePipeline&) {
    return over_stream(place, glsl::twist_width, glsl::twist_halo);
}

DispatchSize over_tiles(const StepPlace& place, const ComputePipeline&) {
    const Tile tile = tile_of(place.step.kind, place.cloth->model->grid);
    return of_cloths(place, tile_invocations(whole(grid_of(place).x), tile),
                     tile_invocations(whole(grid_of(place).y), tile));
}

DispatchSize over_residual_strips(const StepPlace& place, const ComputePipeline&) {
    return of_cloths(place, whole(grid_of(place).x), residual_strip_count(place.cloth->model->grid));
}

}  // namespace drape
