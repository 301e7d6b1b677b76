#include "passes/statistics_pass.h"

#include <algorithm>

#include "passes/declare.h"
#include "passes/struct_layouts.h"

namespace drape {

namespace {

constexpr vulkan::DescriptorDeclaration record_buffer_write(std::uint32_t binding, std::string_view name) {
    return {binding,
            name,
            vulkan::DescriptorKind::storage_buffer,
            vulkan::DescriptorAccess::write,
            VK_FORMAT_UNDEFINED,
            &layouts::statistics_record,
            0};
}

constexpr vulkan::DescriptorDeclaration position = image_read(0, "position"),
                                        displacement = image_read(1, "displacement"),
                                        partials = record_buffer_write(2, "Partials"),
                                        stiffness = image_read(3, "stiffness_image"),
                                        mass = image_read(4, "mass_image", VK_FORMAT_R32_SFLOAT),
                                        planes = struct_buffer_read(5, "Planes", &layouts::collider),
                                        spheres = struct_buffer_read(6, "Spheres", &layouts::collider),
                                        boxes = struct_buffer_read(7, "Boxes", &layouts::collider),
                                        ellipsoids = struct_buffer_read(8, "Ellipsoids", &layouts::collider),
                                        tension_row = image_read(9, "tension_row", VK_FORMAT_R32_SFLOAT),
                                        tension_column = image_read(10, "tension_column", VK_FORMAT_R32_SFLOAT);

constexpr vulkan::DescriptorDeclaration plain[] = {position, displacement, partials, tension_row, tension_column};
constexpr vulkan::DescriptorDeclaration masked[] = {position, displacement, partials,      stiffness,
                                                    mass,     tension_row,  tension_column};
constexpr vulkan::DescriptorDeclaration colliding[] = {position, displacement, partials,    planes,        spheres,
                                                       boxes,    ellipsoids,   tension_row, tension_column};
constexpr vulkan::DescriptorDeclaration both[] = {
    position, displacement, partials, stiffness, mass, planes, spheres, boxes, ellipsoids, tension_row, tension_column};

/// By [masked][colliding].
const vulkan::ShaderInterface interfaces[2][2] = {
    {{"statistics.comp", plain, &layouts::statistics_push},
     {"statistics_colliding.comp", colliding, &layouts::statistics_push}},
    {{"statistics_masked.comp", masked, &layouts::statistics_push},
     {"statistics_masked_colliding.comp", both, &layouts::statistics_push}}};

constexpr vulkan::DescriptorDeclaration sum_descriptors[] = {
    struct_buffer_read(0, "Partials", &layouts::statistics_record), record_buffer_write(1, "Result")};
const vulkan::ShaderInterface sum_interface{"statistics_sum.comp", sum_descriptors, &layouts::statistics_sum_push};

/// Rows of invocations.
std::uint32_t strip_count(const Grid& grid) {
    constexpr auto rows = static_cast<std::uint32_t>(glsl::statistics_rows);
    return (grid.rows() + rows - 1) / rows;
}

/// One record per workgroup.
std::uint32_t partial_count(const Grid& grid) {
    constexpr auto width = static_cast<std::uint32_t>(glsl::workgroup_width);
    return (grid.columns() + width - 1) / width * strip_count(grid);
}

graph::Handle add_partials(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const SceneInputs& inputs,
                           const SimulationModel& model) {
    const bool collides = model.collider_count > 0;
    std::vector<vulkan::SpecializationConstant> constants;
    if (collides)
        for (std::uint32_t kind = 0; kind < collider_kind_count; ++kind)
            constants.push_back({kind, inputs.colliders[kind].valid() ? 1u : 0u});
    const vulkan::ComputePipeline& pipeline = pipelines.get(interfaces[state.model->masked][collides], constants);
    graph::Handle records =
        graph.buffer({state.model->name + "/statistics of workgroups",
                      partial_count(state.model->grid) * sizeof(glsl::StatisticsRecord), graph::Lifetime::transient});
    graph.add_pass(
        state.pass_name("statistics", "statistics"),
        [&](graph::PassSetup& setup) {
            setup.read(state.position, graph::Access::compute_read, 0);
            setup.read(state.displacement, graph::Access::compute_read, 1);
            records = setup.write(records, graph::Access::compute_write, 2);
            setup.read(state.tension[0], graph::Access::compute_read, 9);
            setup.read(state.tension[1], graph::Access::compute_read, 10);
            if (state.model->masked) {
                setup.read(state.stiffness, graph::Access::compute_read, 3);
                setup.read(state.mass, graph::Access::compute_read, 4);
            }
            if (!collides) return;
            // A kind that the scene lacks borrows another kind's buffer: its count is 0, so nothing is read.
            const graph::Handle any = *std::ranges::find_if(inputs.colliders, &graph::Handle::valid);
            for (std::uint32_t kind = 0; kind < collider_kind_count; ++kind) {
                const graph::Handle buffer = inputs.colliders[kind];
                setup.read(buffer.valid() ? buffer : any, graph::Access::compute_read, 5 + kind);
            }
        },
        [&pipeline, push = statistics_push(model, *state.model),
         height = strip_count(state.model->grid)](graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x), height);
        });
    return records;
}

}  // namespace

std::string statistics_readback_name(const ClothModel& cloth) { return cloth.name + "/statistics on the host"; }

void add_statistics(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const SceneInputs& inputs,
                    const SimulationModel& model) {
    const graph::Handle records = add_partials(graph, pipelines, state, inputs, model);
    const graph::Handle result = graph.buffer(
        {statistics_readback_name(*state.model), sizeof(glsl::StatisticsRecord), graph::Lifetime::host_output});
    const vulkan::ComputePipeline& pipeline = pipelines.get(sum_interface);
    const glsl::StatisticsSumPush push{static_cast<int>(partial_count(state.model->grid))};
    graph.add_pass(
        state.pass_name("statistics sum", "statistics"),
        [&](graph::PassSetup& setup) {
            setup.read(records, graph::Access::compute_read, 0);
            static_cast<void>(setup.write(result, graph::Access::compute_write, 1));
        },
        [&pipeline, push](graph::PassContext& context) { context.dispatch(pipeline, push, 1, 1); });
}

}  // namespace drape
