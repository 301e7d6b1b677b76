#include "passes/cut_pass.h"

#include <volk.h>

#include <memory>

#include "passes/declare.h"
#include "passes/struct_layouts.h"

namespace drape {

using graph::Access;

namespace {

constexpr vulkan::DescriptorDeclaration descriptors[] = {
    image_read(0, "position"),
    image_write(1, "cut_flags", VK_FORMAT_R32_UINT),
    image_write(2, "cut_fractions"),
    struct_buffer_read(3, "Cutters", &layouts::cutter_triangle),
    {4, "Count", vulkan::DescriptorKind::storage_buffer, vulkan::DescriptorAccess::read_write, VK_FORMAT_UNDEFINED,
     nullptr, sizeof(std::uint32_t)},
    image_read(5, "stiffness_image"),  // the masked variant only
    image_read(6, "cells", VK_FORMAT_R32_UINT),
};
const vulkan::ShaderInterface whole{"cut.comp", std::span(descriptors).first(5), &layouts::cut_push};
const vulkan::ShaderInterface masked{"cut_masked.comp", descriptors, &layouts::cut_push};

}  // namespace

std::string cut_count_name(const ClothModel& cloth) { return cloth.name + "/cut count"; }
std::string cut_flags_name(const ClothModel& cloth) { return cloth.name + "/cut flags"; }
std::string cut_fractions_name(const ClothModel& cloth) { return cloth.name + "/cut fractions"; }

graph::Handle declare_cutters(graph::Graph& graph, std::size_t cutter_count) {
    return graph.buffer({cutters_name, cutter_count * glsl::cutter_triangle_count * sizeof(glsl::CutterTriangle),
                         graph::Lifetime::host_input});
}

void add_cut(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, graph::Handle cutters,
             std::size_t cutter_count) {
    const ClothModel& model = *state.model;
    const Grid& grid = model.grid;
    const graph::Handle flags = graph.image({cut_flags_name(model), VK_FORMAT_R32_UINT, 2 * (grid.columns() - 1),
                                             grid.rows() - 1, VK_SAMPLE_COUNT_1_BIT, graph::Lifetime::persistent});
    const graph::Handle fractions =
        graph.image({cut_fractions_name(model), VK_FORMAT_R32G32B32A32_SFLOAT, grid.columns(), grid.rows(),
                     VK_SAMPLE_COUNT_1_BIT, graph::Lifetime::persistent});
    graph::Handle count = graph.buffer({cut_count_name(model), sizeof(std::uint32_t), graph::Lifetime::host_output});
    const auto cleared = std::make_shared<graph::Handle>();  // set by set-up, used when recorded
    graph.add_pass(
        state.pass_name("cut count clear", "cut"),
        [&](graph::PassSetup& setup) { *cleared = count = setup.write(count, Access::transfer_write); },
        [cleared](graph::PassContext& context) {
            vkCmdFillBuffer(context.commands(), context.buffer(*cleared).handle(), 0, VK_WHOLE_SIZE, 0);
        });
    const vulkan::ComputePipeline& pipeline = pipelines.get(model.masked ? masked : whole);
    graph.add_pass(
        state.pass_name("cut", "cut"),
        [&](graph::PassSetup& setup) {
            setup.read(state.position, Access::compute_read, 0);
            (void)setup.write(flags, Access::compute_write, 1);
            (void)setup.write(fractions, Access::compute_write, 2);
            setup.read(cutters, Access::compute_read, 3);
            setup.read(count, Access::compute_read);
            (void)setup.write(count, Access::compute_write, 4);
            if (!model.masked) return;
            setup.read(state.stiffness, Access::compute_read, 5);
            setup.read(state.cells, Access::compute_read, 6);
        },
        [&pipeline, push = glsl::CutPush{grid.size(), static_cast<int>(cutter_count) * glsl::cutter_triangle_count, 0}](
            graph::PassContext& context) {
            context.dispatch(pipeline, push, static_cast<std::uint32_t>(push.grid.x),
                             static_cast<std::uint32_t>(push.grid.y));
        });
}

CutFindings read_findings(const graph::ResourcePool& pool, const ClothModel& cloth) {
    CutFindings findings{std::vector<std::uint32_t>(cloth.grid.cells().size() * 2),
                         std::vector<glsl::vec4>(cloth.grid.particle_count())};
    vulkan::download(pool.device(), pool.image(cut_flags_name(cloth)),
                     std::as_writable_bytes(std::span(findings.triangle_flags)));
    vulkan::download(pool.device(), pool.image(cut_fractions_name(cloth)),
                     std::as_writable_bytes(std::span(findings.fractions)));
    return findings;
}

}  // namespace drape
