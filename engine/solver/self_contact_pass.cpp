#include "solver/self_contact_pass.h"

#include <fmt/format.h>

#include <algorithm>

#include "vulkan/api.h"

namespace drape {

namespace {

using graph::Access;
using graph::PassSetup;

/// Beyond it invocations take several places each.
constexpr std::size_t most_invocations = std::size_t{1} << 21;

/// A pass of all cloths together, or of one between its fields and the sheet.
graph::PassName pass_name(const std::string& label, const Step& step) {
    return {fmt::format("{} (substep {})", label, step.substep), "simulate", label};
}

template <class Push, class SetUp>
void add_pass(graph::Graph& graph, const graph::PassName& name, const Step& step,
              const vulkan::ComputePipeline& pipeline, glsl::ivec2 size, const SetUp& set_up) {
    graph.add_pass(name, set_up, [&pipeline, size, push = step.push<Push>()](graph::PassContext& context) {
        context.dispatch(pipeline, push, static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y));
    });
}

/// A pass over the sheet.
template <class SetUp>
void add_pass(graph::Graph& graph, const Step& step, const char* name, const vulkan::ComputePipeline& pipeline,
              int invocations, const SetUp& set_up) {
    add_pass<glsl::SelfContactPush>(graph, pass_name(name, step), step, pipeline, {invocations, 1}, set_up);
}

/// Invocations that go over the places on the sheet.
int over_sheet(const Pipelines& pipelines, const Step& step) {
    const glsl::ivec2 grid = step.push<glsl::SelfContactPush>().grid;
    const std::size_t each = pipelines.entries_each();
    return static_cast<int>(std::min((std::size_t(grid.x) * std::size_t(grid.y) + each - 1) / each, most_invocations));
}

/// Of a pass that looks up which cloth a place is of (shaders/include/self_cloths.h).
const vulkan::ComputePipeline& pipeline_of(Pipelines& pipelines, const std::string& module, const Step& step) {
    const int cloths = step.push<glsl::SelfContactPush>().cloth_count;
    return pipelines.get(module, {{"cloth_count", static_cast<std::uint32_t>(cloths)}});
}
/// Likewise of one that says how far those after it run (shaders/include/self_lists.h).
const vulkan::ComputePipeline& listing_pipeline(Pipelines& pipelines, const std::string& module, const Step& step) {
    const int cloths = step.push<glsl::SelfContactPush>().cloth_count;
    return pipelines.get(
        module, {{"cloth_count", static_cast<std::uint32_t>(cloths)}, {"entries_each", pipelines.entries_each()}});
}

/// Invocations of a pass between a cloth and the sheet.
glsl::ivec2 over_strips(const Pipelines& pipelines, const ClothState& cloth) {
    const auto [across, down] = pipelines.over_strips(cloth.model->grid.size());
    return {static_cast<int>(across), static_cast<int>(down)};
}

/// Whether some cloths started through each other.
bool crossed(const Step& step) { return step.push<glsl::SelfContactPush>().crossed_count > 0; }

void read(PassSetup& setup, const ClothState& contact, Field field, const char* name) {
    setup.read(contact[field], Access::compute_read, name);
}
void update_in_place(PassSetup& setup, ClothState& contact, Field field, const char* name) {
    drape::update_in_place(setup, contact[field], name);
}

void read_cloths(PassSetup& setup, const ClothState& contact) {
    read(setup, contact, Field::self_owners, "owners");
    read(setup, contact, Field::self_cloths, "cloths");
}
/// What shaders/include/self_sheet.h declares.
void read_sheet(PassSetup& setup, const ClothState& contact) {
    read(setup, contact, Field::self_positions, "positions");
    read(setup, contact, Field::self_displacements, "displacements");
    read_cloths(setup, contact);
}
/// Of a pass that moves particles.
void move_on_sheet(PassSetup& setup, ClothState& contact) {
    read(setup, contact, Field::self_positions, "positions");
    update(setup, contact[Field::self_displacements], "displacements");
    read_cloths(setup, contact);
    update(setup, contact[Field::self_before], "before");
}
void write(PassSetup& setup, ClothState& contact, Field field, const char* name) {
    contact[field] = setup.write(contact[field], Access::compute_write, name);
}

/// Entries of a list, which the passes after it go through.
void fill(PassSetup& setup, ClothState& contact, Field list, const char* name) {
    update_in_place(setup, contact, list, name);
    update_in_place(setup, contact, Field::self_record, "record");
    update_in_place(setup, contact, Field::self_sizes, "sizes");
}

/// A pass over the sheet, or through a list, as far as the passes before found something to do for it.
template <class SetUp>
void add_sized_pass(graph::Graph& graph, const ClothState& contact, const Step& step, const char* name,
                    const vulkan::ComputePipeline& pipeline, int size, const SetUp& set_up) {
    const graph::Handle sizes = contact[Field::self_sizes];
    graph.add_pass(
        pass_name(name, step),
        [&](PassSetup& setup) {
            setup.read(sizes, Access::indirect_read);
            set_up(setup);
        },
        [&pipeline, size, sizes, push = step.push<glsl::SelfContactPush>()](graph::PassContext& context) {
            context.dispatch_indirect(pipeline, push, sizes, static_cast<std::uint64_t>(size) * sizeof(glsl::uvec4));
        });
}

}  // namespace

void add_self_gather(graph::Graph& graph, Pipelines& pipelines, const ClothState& cloth, ClothState& contact,
                     const Step& step) {
    const vulkan::ComputePipeline& pipeline = pipelines.get(
        vulkan::variant_name("self_gather.comp", {{"masked", cloth.masked()}, {"buffered", cloth.buffered}}),
        {{"strip_length", pipelines.strip_length()}});
    add_pass<glsl::SelfClothPush>(graph, cloth.step_name("self gather", step), step, pipeline,
                                  over_strips(pipelines, cloth), [&](PassSetup& setup) {
                                      read(setup, cloth, Field::position, "position");
                                      read(setup, cloth, Field::displacement, "displacement");
                                      if (cloth.masked()) read(setup, cloth, Field::cells, "existing");
                                      // Other cloths' places, and those of none, stay.
                                      update_in_place(setup, contact, Field::self_positions, "positions");
                                      update_in_place(setup, contact, Field::self_displacements, "displacements");
                                  });
}

void add_self_gather_again(graph::Graph& graph, Pipelines& pipelines, const ClothState& cloth, ClothState& contact,
                           const Step& step) {
    const vulkan::ComputePipeline& pipeline =
        pipelines.get(vulkan::variant_name("self_gather_again.comp", {{"buffered", cloth.buffered}}),
                      {{"strip_length", pipelines.strip_length()}});
    add_pass<glsl::SelfClothPush>(graph, cloth.step_name("self gather again", step), step, pipeline,
                                  over_strips(pipelines, cloth), [&](PassSetup& setup) {
                                      read(setup, cloth, Field::displacement, "displacement");
                                      update(setup, contact[Field::self_displacements], "displacements");
                                  });
}

void add_self_return(graph::Graph& graph, Pipelines& pipelines, ClothState& cloth, ClothState& contact,
                     const Step& step) {
    const bool history = cloth.model->plan.second_order;
    const vulkan::ComputePipeline& pipeline =
        pipelines.get(vulkan::variant_name("self_return.comp", {{"history", history}, {"buffered", cloth.buffered}}),
                      {{"strip_length", pipelines.strip_length()}});
    add_pass<glsl::SelfClothPush>(graph, cloth.step_name("self return", step), step, pipeline,
                                  over_strips(pipelines, cloth), [&](PassSetup& setup) {
                                      read(setup, contact, Field::self_displacements, "displacements");
                                      update(setup, contact[Field::self_before], "before");
                                      update(setup, cloth[Field::displacement], "displacement");
                                      if (!history) return;
                                      update_in_place(setup, cloth, Field::displacement_before, "displacement_before");
                                      update_in_place(setup, cloth, Field::line_control, "control");
                                  });
}

void add_self_common(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step) {
    const std::string module = vulkan::variant_name("self_common.comp", {{"crossed", crossed(step)}});
    add_pass(graph, step, "self common", pipelines.get(module), 1, [&](PassSetup& setup) {
        read(setup, contact, Field::self_displacements, "displacements");
        read(setup, contact, Field::self_cloths, "cloths");
        update_in_place(setup, contact, Field::self_record, "record");
        update_in_place(setup, contact, Field::self_sizes, "sizes");
        if (crossed(step)) write(setup, contact, Field::self_crossings, "crossings");
    });
}

void add_self_boxes(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step) {
    add_pass(graph, step, "self boxes", listing_pipeline(pipelines, "self_boxes.comp", step),
             over_sheet(pipelines, step), [&](PassSetup& setup) {
                 read_sheet(setup, contact);
                 write(setup, contact, Field::self_boxes, "boxes");
                 write(setup, contact, Field::self_corrections, "corrections");
                 write(setup, contact, Field::self_shares, "shares");
                 read(setup, contact, Field::self_record, "record");
                 write(setup, contact, Field::self_before, "before");
                 read(setup, contact, Field::self_kept, "kept");
                 update_in_place(setup, contact, Field::self_sizes, "sizes");
             });
}

void add_self_search(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step) {
    add_sized_pass(graph, contact, step, "self search",
                   pipelines.get("self_search.comp", {{"entries_each", pipelines.entries_each()}}),
                   glsl::self_size_search, [&](PassSetup& setup) {
                       update_in_place(setup, contact, Field::self_record, "record");
                       update_in_place(setup, contact, Field::self_sizes, "sizes");
                   });
}

void add_self_kept(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step) {
    add_sized_pass(graph, contact, step, "self kept", pipeline_of(pipelines, "self_kept.comp", step),
                   glsl::self_size_kept, [&](PassSetup& setup) {
                       read(setup, contact, Field::self_boxes, "boxes");
                       read(setup, contact, Field::self_displacements, "displacements");
                       read(setup, contact, Field::self_owners, "owners");
                       read(setup, contact, Field::self_record, "record");
                       update_in_place(setup, contact, Field::self_kept, "kept");
                   });
}

void add_self_levels(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step) {
    add_sized_pass(graph, contact, step, "self levels", pipelines.get("self_levels.comp"),
                   glsl::self_size_levels + step.push<glsl::SelfContactPush>().level - 1,
                   [&](PassSetup& setup) { update_in_place(setup, contact, Field::self_kept, "boxes"); });
}

void add_self_blocks(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step) {
    add_sized_pass(graph, contact, step, "self blocks", listing_pipeline(pipelines, "self_blocks.comp", step),
                   glsl::self_size_blocks, [&](PassSetup& setup) {
                       read(setup, contact, Field::self_kept, "boxes");
                       read_cloths(setup, contact);
                       read(setup, contact, Field::self_meetings, "meetings");
                       fill(setup, contact, Field::self_cells, "blocks");
                   });
}

void add_self_cells(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step) {
    add_sized_pass(graph, contact, step, "self cells", listing_pipeline(pipelines, "self_cells.comp", step),
                   glsl::self_size_cells, [&](PassSetup& setup) {
                       read(setup, contact, Field::self_kept, "boxes");
                       read_cloths(setup, contact);
                       read(setup, contact, Field::self_cells, "blocks");
                       fill(setup, contact, Field::self_candidates, "candidates");
                   });
}

void add_self_near(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step) {
    add_sized_pass(graph, contact, step, "self near", listing_pipeline(pipelines, "self_near.comp", step),
                   glsl::self_size_near, [&](PassSetup& setup) {
                       read(setup, contact, Field::self_boxes, "boxes");
                       read(setup, contact, Field::self_candidates, "candidates");
                       read_cloths(setup, contact);
                       fill(setup, contact, Field::self_cells, "cells");
                   });
}

void add_self_bent(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, glsl::ivec2 largest,
                   const Step& step) {
    const auto cloths = static_cast<std::uint32_t>(step.push<glsl::SelfContactPush>().cloth_count);
    const vulkan::ComputePipeline& pipeline =
        pipelines.get("self_bent.comp", {{"cloth_count", cloths},
                                         {"entries_each", pipelines.entries_each()},
                                         {"strip_rows", pipelines.strip_rows()},
                                         {"strip_columns", pipelines.strip_columns()}});
    graph.add_pass(
        pass_name("self bent", step),
        [&](PassSetup& setup) {
            read(setup, contact, Field::self_positions, "positions");
            read(setup, contact, Field::self_displacements, "displacements");
            read(setup, contact, Field::self_cloths, "cloths");
            read(setup, contact, Field::self_meetings, "meetings");
            fill(setup, contact, Field::self_cells, "cells");
        },
        [&pipeline, push = step.push<glsl::SelfContactPush>(), cloths, over = pipelines.over_parts(largest)](
            graph::PassContext& context) { context.dispatch(pipeline, push, over[0], over[1], cloths); });
}

void add_self_crossings(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step) {
    add_sized_pass(graph, contact, step, "self crossings", pipeline_of(pipelines, "self_crossings.comp", step),
                   glsl::self_size_primitives, [&](PassSetup& setup) {
                       read(setup, contact, Field::self_positions, "positions");
                       read(setup, contact, Field::self_displacements, "displacements");
                       read(setup, contact, Field::self_owners, "owners");
                       read(setup, contact, Field::self_cells, "cells");
                       read(setup, contact, Field::self_record, "record");
                       read(setup, contact, Field::self_meetings, "meetings");
                       read(setup, contact, Field::self_crossed, "crossed");
                       update_in_place(setup, contact, Field::self_crossings, "crossings");
                   });
}

void add_self_apart(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step) {
    add_pass(graph, step, "self apart", pipelines.get("self_apart.comp", {{"entries_each", pipelines.entries_each()}}),
             step.push<glsl::SelfContactPush>().cloth_count, [&](PassSetup& setup) {
                 read(setup, contact, Field::self_crossed, "crossed");
                 read(setup, contact, Field::self_crossings, "crossings");
                 write(setup, contact, Field::self_led, "led");
                 update_in_place(setup, contact, Field::self_record, "record");
                 update_in_place(setup, contact, Field::self_sizes, "sizes");
             });
}

void add_self_primitives(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step) {
    const std::string module = vulkan::variant_name("self_primitives.comp", {{"crossed", crossed(step)}});
    add_sized_pass(graph, contact, step, "self primitives", listing_pipeline(pipelines, module, step),
                   glsl::self_size_primitives, [&](PassSetup& setup) {
                       read_sheet(setup, contact);
                       read(setup, contact, Field::self_cells, "cells");
                       fill(setup, contact, Field::self_near, "near");
                       if (!crossed(step)) return;
                       read(setup, contact, Field::self_meetings, "meetings");
                       read(setup, contact, Field::self_crossings, "crossings");
                   });
}

void add_self_pairs(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step) {
    add_sized_pass(graph, contact, step, "self pairs", listing_pipeline(pipelines, "self_pairs.comp", step),
                   glsl::self_size_pairs, [&](PassSetup& setup) {
                       read_sheet(setup, contact);
                       read(setup, contact, Field::self_cells, "cells");
                       read(setup, contact, Field::self_near, "near");
                       fill(setup, contact, Field::self_pairs, "pairs");
                   });
}

void add_self_contact(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step) {
    const std::string module = vulkan::variant_name("self_contact.comp", {{"wide", pipelines.wide_atomics()}});
    add_sized_pass(graph, contact, step, "self contact", listing_pipeline(pipelines, module, step),
                   glsl::self_size_contact + step.push<glsl::SelfContactPush>().round, [&](PassSetup& setup) {
                       read_sheet(setup, contact);
                       read(setup, contact, Field::self_pairs, "pairs");
                       read(setup, contact, Field::self_record, "record");
                       update_in_place(setup, contact, Field::self_corrections, "corrections");
                       update_in_place(setup, contact, Field::self_sizes, "sizes");
                   });
}

void add_self_push(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step) {
    const std::string module = vulkan::variant_name(
        "self_push.comp",
        {{"wide", pipelines.wide_atomics()}, {"crossed", crossed(step)}, {"buffered", contact.buffered}});
    add_sized_pass(graph, contact, step, "self push", pipeline_of(pipelines, module, step),
                   glsl::self_size_push + step.push<glsl::SelfContactPush>().round, [&](PassSetup& setup) {
                       move_on_sheet(setup, contact);
                       update(setup, contact[Field::self_corrections], "corrections");
                       read(setup, contact, Field::self_record, "record");
                       if (crossed(step)) read(setup, contact, Field::self_led, "led");
                   });
}

void add_self_room(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step) {
    add_sized_pass(graph, contact, step, "self room", listing_pipeline(pipelines, "self_room.comp", step),
                   glsl::self_size_room + step.push<glsl::SelfContactPush>().round, [&](PassSetup& setup) {
                       read_sheet(setup, contact);
                       read(setup, contact, Field::self_pairs, "pairs");
                       update_in_place(setup, contact, Field::self_record, "record");
                       read(setup, contact, Field::self_before, "before");
                       update_in_place(setup, contact, Field::self_shares, "shares");
                       update_in_place(setup, contact, Field::self_sizes, "sizes");
                   });
}

void add_self_move(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step) {
    const std::string module = vulkan::variant_name("self_move.comp", {{"buffered", contact.buffered}});
    add_pass(graph, step, "self move", pipeline_of(pipelines, module, step), over_sheet(pipelines, step),
             [&](PassSetup& setup) {
                 move_on_sheet(setup, contact);
                 read(setup, contact, Field::self_shares, "shares");
                 update_in_place(setup, contact, Field::self_record, "record");
             });
}

void add_self_readback(graph::Graph& graph, const ClothState& contact) {
    const graph::Handle empty =
        graph.buffer({self_readback_name, sizeof(glsl::SelfRecord), graph::Lifetime::host_output});
    const auto target = std::make_shared<graph::Handle>();  // set by set-up, used when recorded
    graph.add_pass(
        {"self record readback", "simulate", "self record readback"},
        [&](PassSetup& setup) {
            setup.read(contact[Field::self_record], Access::transfer_read);
            *target = setup.write(empty, Access::transfer_write);
        },
        [record = contact[Field::self_record], target](graph::PassContext& context) {
            const VkBufferCopy whole{0, 0, sizeof(glsl::SelfRecord)};
            vkCmdCopyBuffer(context.commands(), context.buffer(record).handle(), context.buffer(*target).handle(), 1,
                            &whole);
        });
}

}  // namespace drape
