#include "solver/attempt_pass.h"

#include <cstring>

#include "cloth/difference.h"
#include "solver/cloth_constants.h"
#include "solver/compute_pass.h"
#include "vulkan/api.h"

namespace drape {

namespace {

graph::ImageDeclaration declaration_of(const graph::Graph& graph, graph::Handle image) {
    return graph.resources()[image.resource].seen(image);
}

/// Another image like the one of a field.
graph::Handle copy_of(graph::Graph& graph, const ClothState& state, Field field, const char* what) {
    const graph::ImageDeclaration image = declaration_of(graph, state[field]);
    return graph.image({image.name + what, image.format, image.width, image.height, VK_SAMPLE_COUNT_1_BIT,
                        graph::Lifetime::persistent});
}

struct Copy {
    graph::Handle from, to;
    std::uint32_t width, height;
};

/// Copies images of cloths together, of those that are present.
void add_copies_of_present(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const char* name,
                           std::vector<Copy>& copies) {
    for (Copy& copy : copies) {
        const VkFormat format = declaration_of(graph, copy.from).format;
        const auto value = [&](std::string_view constant) -> std::uint32_t {
            return format == (constant == "scalar" ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_R32_UINT);
        };
        const std::uint32_t height = copy.height / state.count();
        const glsl::GridPush push{{static_cast<int>(copy.width), static_cast<int>(height)}};
        add_compute_pass(graph, state.pass_name(name, "judge"), pipelines.get("copy_state.comp", value), push,
                         {copy.width, height, state.count()},
                         {&state,
                          nullptr,
                          {},
                          {{"source", &copy.from},
                           {"source_scalar", &copy.from},
                           {"source_integer", &copy.from},
                           {"target", &copy.to},
                           {"target_scalar", &copy.to},
                           {"target_integer", &copy.to}}});
    }
}

void add_copies(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const char* name,
                std::vector<Copy>& copies) {
    if (state.present.valid()) return add_copies_of_present(graph, pipelines, state, name, copies);
    // The execute function is made before set-up runs, so it holds the place where the handles will be.
    const auto recorded = std::make_shared<std::vector<Copy>>();
    graph.add_pass(
        state.pass_name(name, "judge"),
        [&](graph::PassSetup& setup) {
            for (Copy& copy : copies) {
                setup.read(copy.from, graph::Access::transfer_read);
                copy.to = setup.write(copy.to, graph::Access::transfer_write);
            }
            *recorded = copies;
        },
        [recorded](graph::PassContext& context) {
            for (const Copy& copy : *recorded) {
                const VkImageSubresourceLayers layers{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
                const VkImageCopy region{layers, {}, layers, {}, {copy.width, copy.height, 1}};
                vkCmdCopyImage(context.commands(), context.image(copy.from).handle(), VK_IMAGE_LAYOUT_GENERAL,
                               context.image(copy.to).handle(), VK_IMAGE_LAYOUT_GENERAL, 1, &region);
            }
        });
}

Copy copy_between(const graph::Graph& graph, graph::Handle from, graph::Handle to) {
    const graph::ImageDeclaration image = declaration_of(graph, from);
    return {from, to, image.width, image.height};
}

void add_state_copies(graph::Graph& graph, Pipelines& pipelines, ClothState& state, bool back) {
    std::vector<Copy> copies;
    std::vector<Field> fields;
    for (const FieldRow& row : cloth_fields()) {
        if (row.life != FieldLife::state || !state[row.field].valid()) continue;
        const graph::Handle kept = copy_of(graph, state, row.field, " kept"), live = state[row.field];
        copies.push_back(back ? copy_between(graph, kept, live) : copy_between(graph, live, kept));
        fields.push_back(row.field);
    }
    add_copies(graph, pipelines, state, back ? "restore" : "keep", copies);
    if (!back) return;
    for (std::size_t i = 0; i < fields.size(); ++i) state[fields[i]] = copies[i].to;
}

void add_disturb(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SimulationModel& run) {
    std::vector<Copy> copies;
    for (const FieldRow& row : cloth_fields()) {
        if (row.life != FieldLife::state || !state[row.field].valid()) continue;
        const graph::ImageDeclaration live = declaration_of(graph, state[row.field]);
        copies.push_back(copy_between(graph, graph.image(in_set(live, StateSet::companion)),
                                      graph.image(in_set(live, StateSet::disturbed))));
    }
    add_copies(graph, pipelines, state, "begin disturbed run", copies);
    static_assert(static_cast<int>(Field::position) == 0);
    graph::Handle from = copies.front().from, to = copies.front().to;
    const std::vector<graph::PushConstants> each = pushes_of(state, run, [](const ClothModel& cloth) {
        return graph::PushConstants(glsl::DisturbPush{cloth.grid.size(), disturbance(cloth), 0});
    });
    graph::Handle own = own_constants(graph, state, "disturb.comp", "disturb", each);
    add_compute_pass(graph, state.pass_name("disturb", "judge"), pipelines.get("disturb.comp", own.valid()),
                     each.front(), {state.model->grid.columns(), state.model->grid.rows(), state.count()},
                     {&state, nullptr, {}, {{"position", &from}, {"disturbed_position", &to}, {"constants", &own}}});
}

constexpr const char* coarse_run = " of the coarse run";

void add_remember(graph::Graph& graph, Pipelines& pipelines, ClothState& state) {
    const graph::Handle position = state[Field::position];
    std::vector<Copy> copies{copy_between(graph, position, copy_of(graph, state, Field::position, coarse_run))};
    if (const graph::Handle bodies = state[Field::bodies]; bodies.valid())
        copies.push_back(copy_between(graph, bodies, copy_of(graph, state, Field::bodies, coarse_run)));
    add_copies(graph, pipelines, state, "remember", copies);
}

void add_change_substep(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SceneInputs& inputs,
                        std::size_t first_change) {
    const vulkan::ComputePipeline& pipeline = pipelines.get(
        "change_substep.comp", [&](std::string_view) { return state.model->scheme.second_order ? 1u : 0u; });
    const glsl::ChangeSubstepPush push{state.model->grid.size(), static_cast<int>(first_change)};
    add_compute_pass(graph, state.pass_name("change substep", "judge"), pipeline, push,
                     {state.model->grid.columns(), state.model->grid.rows(), state.count()}, {&state, nullptr, inputs});
}

void add_compare(graph::Graph& graph, Pipelines& pipelines, ClothState& state, graph::Handle fine,
                 graph::Handle coarse) {
    const Grid& grid = state.model->grid;
    graph::Handle partials = graph.buffer<glsl::DifferenceRecord>(
        difference_readback_name(state.name), difference_count(grid) * state.count(), graph::Lifetime::host_output);
    constexpr auto rows = static_cast<std::uint32_t>(glsl::difference_rows);
    add_compute_pass(
        graph, state.pass_name("compare", "judge"), pipelines.get("difference.comp"), glsl::GridPush{grid.size()},
        {grid.columns(), (grid.rows() + rows - 1) / rows, state.count()},
        {&state, nullptr, {}, {{"position", &fine}, {"coarse_position", &coarse}, {"partials", &partials}}});
}

/// Compares the bodies that lie with a cloth, if there are any.
void add_compare_bodies(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SimulationModel& run,
                        graph::Handle fine, graph::Handle coarse) {
    if (!fine.valid()) return;
    const auto count = static_cast<std::uint32_t>(body_count(run));
    graph::Handle distances = graph.buffer<float>(body_distance_name(state.name), count, graph::Lifetime::host_output);
    add_compute_pass(graph, state.pass_name("compare bodies", "judge"), pipelines.get("body_difference.comp"),
                     glsl::GridPush{{static_cast<int>(count), 1}}, {count, 1, 1},
                     {&state, nullptr, {}, {{"bodies", &fine}, {"coarse_bodies", &coarse}, {"distances", &distances}}});
}

/// Returns the field of the state in another set; invalid where the state has none.
graph::Handle field_in(graph::Graph& graph, const ClothState& state, Field field, StateSet set) {
    if (!state[field].valid()) return {};
    return graph.image(in_set(declaration_of(graph, state[field]), set));
}

}  // namespace

void add_contact_attempt(graph::Graph& graph, ContactHandles& contact, StateStep step) {
    const bool back = step == StateStep::restore;
    if (!back && step != StateStep::keep && step != StateStep::disturb) return;
    for (const ContactRow& row : contact_fields()) {
        if (row.life != FieldLife::state) continue;
        const graph::BufferDeclaration live = graph.resources()[contact[row.field].resource].buffer;
        const bool begins = step == StateStep::disturb;
        const graph::Handle here = begins ? graph.buffer(in_set(live, StateSet::companion)) : contact[row.field];
        const graph::Handle kept =
            begins ? graph.buffer(in_set(live, StateSet::disturbed))
                   : graph.buffer({live.name + " kept", live.byte_count, graph::Lifetime::persistent});
        const graph::Handle from = back ? kept : here;
        const auto to = std::make_shared<graph::Handle>(back ? here : kept);
        const std::string name = back                      ? "restore contact"
                                 : step == StateStep::keep ? "keep contact"
                                                           : "disturb contact";
        graph.add_pass(
            {name, "judge", live.name + ": " + name},
            [&](graph::PassSetup& setup) {
                setup.read(from, graph::Access::transfer_read);
                *to = setup.write(*to, graph::Access::transfer_write);
            },
            [from, to, size = live.byte_count](graph::PassContext& context) {
                const VkBufferCopy region{0, 0, size};
                vkCmdCopyBuffer(context.commands(), context.buffer(from).handle(), context.buffer(*to).handle(), 1,
                                &region);
            });
        if (back) contact[row.field] = *to;
    }
}

std::string body_distance_name(const std::string& state) { return state + "/distances of bodies on the host"; }

std::string difference_readback_name(const std::string& state) { return state + "/differences on the host"; }

void add_attempt(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const SceneInputs& inputs,
                 const SimulationModel& run, StateStep step, std::size_t first_change) {
    switch (step) {
        case StateStep::keep:
            return add_state_copies(graph, pipelines, state, false);
        case StateStep::restore:
            return add_state_copies(graph, pipelines, state, true);
        case StateStep::change_substep:
            return add_change_substep(graph, pipelines, state, inputs, first_change);
        case StateStep::remember:
            return add_remember(graph, pipelines, state);
        case StateStep::compare:
            if (state[Field::bodies].valid())
                add_compare_bodies(graph, pipelines, state, run, state[Field::bodies],
                                   copy_of(graph, state, Field::bodies, coarse_run));
            return add_compare(graph, pipelines, state, state[Field::position],
                               copy_of(graph, state, Field::position, coarse_run));
        case StateStep::compare_companion:
            add_compare_bodies(graph, pipelines, state, run, state[Field::bodies],
                               field_in(graph, state, Field::bodies, StateSet::companion));
            return add_compare(graph, pipelines, state, state[Field::position],
                               field_in(graph, state, Field::position, StateSet::companion));
        case StateStep::disturb:
            return add_disturb(graph, pipelines, state, run);
        case StateStep::compare_disturbed:
            add_compare_bodies(graph, pipelines, state, run, field_in(graph, state, Field::bodies, StateSet::companion),
                               field_in(graph, state, Field::bodies, StateSet::disturbed));
            return add_compare(graph, pipelines, state, field_in(graph, state, Field::position, StateSet::companion),
                               field_in(graph, state, Field::position, StateSet::disturbed));
    }
}

std::vector<double> read_differences(const ClothLayout& layout, const graph::ResourcePool& pool, std::uint32_t slot) {
    std::vector<double> all;
    for (const auto bytes : layout.parts(pool, slot, difference_readback_name)) {
        std::vector<glsl::DifferenceRecord> partials(bytes.size() / sizeof(glsl::DifferenceRecord));
        std::memcpy(partials.data(), bytes.data(), bytes.size());
        all.push_back(difference_of(partials));
    }
    for (std::size_t cloth = 0; cloth < all.size(); ++cloth) {
        if (!has_bodies(layout.model, cloth)) continue;
        std::vector<float> distances(body_count(layout.model));
        const vulkan::Buffer& buffer = pool.buffer(body_distance_name(layout.state_name(cloth)), slot);
        std::memcpy(distances.data(), buffer.mapped().data(), distances.size() * sizeof(float));
        all[cloth] = difference_with_bodies(all[cloth], distances);
    }
    return all;
}

}  // namespace drape
