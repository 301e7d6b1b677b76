#include "passes/self_contact_pass.h"

#include "cloth/self_contact.h"
#include "vulkan/api.h"

namespace drape {

namespace {

using graph::Access;
using graph::PassSetup;

/// A pass of `pipeline` over `width` x `height` invocations.
template <class SetUp>
void add_pass(graph::Graph& graph, const ClothState& state, const Step& step, const char* name,
              const vulkan::ComputePipeline& pipeline, glsl::ivec2 size, const SetUp& set_up) {
    graph.add_pass(state.step_name(name, step), set_up,
                   [&pipeline, size, push = step.push<glsl::SelfContactPush>()](graph::PassContext& context) {
                       context.dispatch(pipeline, push, static_cast<std::uint32_t>(size.x),
                                        static_cast<std::uint32_t>(size.y));
                   });
}

/// An invocation per particle, or per share of the pairs.
glsl::ivec2 in_a_row(const ClothState& state) { return {static_cast<int>(state.model->grid.particle_count()), 1}; }

void read_state(PassSetup& setup, const ClothState& state) {
    setup.read(state[Field::position], Access::compute_read, "position");
    setup.read(state[Field::displacement], Access::compute_read, "displacement");
}

/// Of a pass that moves particles.
std::string touching(const char* shader, const ClothState& state) {
    return vulkan::variant_name(shader, {{"history", state.model->plan.second_order}, {"buffered", state.buffered}});
}
void touch(PassSetup& setup, ClothState& state) {
    setup.read(state[Field::position], Access::compute_read, "position");
    update(setup, state[Field::displacement], "displacement");
    if (!state.model->plan.second_order) return;
    update_in_place(setup, state[Field::displacement_before], "displacement_before");
    update_in_place(setup, state[Field::line_control], "control");
}

}  // namespace

void add_self_common(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    add_pass(graph, state, step, "self common", pipelines.get("self_common.comp"), {1, 1}, [&](PassSetup& setup) {
        setup.read(state[Field::displacement], Access::compute_read, "displacement");
        update_in_place(setup, state[Field::self_record], "record");
    });
}

void add_self_boxes(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const auto& push = step.push<glsl::SelfContactPush>();
    const bool leaves = push.level == 0;
    const vulkan::ComputePipeline& pipeline =
        pipelines.get(vulkan::variant_name("self_boxes.comp", {{"leaves", leaves}}));
    const int count =
        push.last > push.level ? glsl::workgroup_width : static_cast<int>(self_tree_boxes_of(push.grid, push.level));
    add_pass(
        graph, state, step, leaves ? "self boxes" : "self boxes above", pipeline, {count, 1}, [&](PassSetup& setup) {
            if (leaves) {
                read_state(setup, state);
                state[Field::self_boxes] = setup.write(state[Field::self_boxes], Access::compute_write, "boxes");
                state[Field::self_corrections] =
                    setup.write(state[Field::self_corrections], Access::compute_write, "corrections");
                state[Field::self_shares] = setup.write(state[Field::self_shares], Access::compute_write, "shares");
                setup.read(state[Field::self_record], Access::compute_read, "record");
            } else {
                update_in_place(setup, state[Field::self_boxes], "boxes");
                update_in_place(setup, state[Field::self_record], "record");
            }
        });
}

void add_self_blocks(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const auto& push = step.push<glsl::SelfContactPush>();
    add_pass(graph, state, step, "self blocks", pipelines.get("self_blocks.comp"),
             {static_cast<int>(self_tree_boxes_of(push.grid, 1)), 1}, [&](PassSetup& setup) {
                 setup.read(state[Field::self_boxes], Access::compute_read, "boxes");
                 update_in_place(setup, state[Field::self_cells], "blocks");
                 update_in_place(setup, state[Field::self_record], "record");
             });
}

void add_self_cells(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    add_pass(graph, state, step, "self cells", pipelines.get("self_cells.comp"), in_a_row(state),
             [&](PassSetup& setup) {
                 setup.read(state[Field::self_boxes], Access::compute_read, "boxes");
                 setup.read(state[Field::self_cells], Access::compute_read, "blocks");
                 update_in_place(setup, state[Field::self_candidates], "candidates");
                 update_in_place(setup, state[Field::self_record], "record");
             });
}

void add_self_near(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    add_pass(graph, state, step, "self near", pipelines.get("self_near.comp"), in_a_row(state), [&](PassSetup& setup) {
        read_state(setup, state);
        setup.read(state[Field::self_boxes], Access::compute_read, "boxes");
        setup.read(state[Field::self_candidates], Access::compute_read, "candidates");
        update_in_place(setup, state[Field::self_cells], "cells");
        update_in_place(setup, state[Field::self_record], "record");
    });
}

void add_self_pairs(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const vulkan::ComputePipeline& pipeline =
        pipelines.get(vulkan::variant_name("self_pairs.comp", {{"masked", state.masked()}}));
    add_pass(graph, state, step, "self pairs", pipeline, in_a_row(state), [&](PassSetup& setup) {
        read_state(setup, state);
        setup.read(state[Field::self_cells], Access::compute_read, "cells");
        update_in_place(setup, state[Field::self_pairs], "pairs");
        update_in_place(setup, state[Field::self_record], "record");
        if (state.masked()) setup.read(state[Field::cells], Access::compute_read, "existing");
    });
}

void add_self_contact(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    add_pass(graph, state, step, "self contact", pipelines.get("self_contact.comp"), in_a_row(state),
             [&](PassSetup& setup) {
                 read_state(setup, state);
                 setup.read(state[Field::self_pairs], Access::compute_read, "pairs");
                 setup.read(state[Field::self_record], Access::compute_read, "record");
                 update_in_place(setup, state[Field::self_corrections], "corrections");
             });
}

void add_self_push(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const vulkan::ComputePipeline& pipeline = pipelines.get(touching("self_push.comp", state));
    add_pass(graph, state, step, "self push", pipeline, state.model->grid.size(), [&](PassSetup& setup) {
        touch(setup, state);
        update_in_place(setup, state[Field::self_corrections], "corrections");
        update_in_place(setup, state[Field::self_before], "before");
    });
}

void add_self_room(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    add_pass(graph, state, step, "self room", pipelines.get("self_room.comp"), in_a_row(state), [&](PassSetup& setup) {
        read_state(setup, state);
        setup.read(state[Field::self_pairs], Access::compute_read, "pairs");
        update_in_place(setup, state[Field::self_record], "record");
        setup.read(state[Field::self_before], Access::compute_read, "before");
        update_in_place(setup, state[Field::self_shares], "shares");
    });
}

void add_self_move(graph::Graph& graph, PipelineCache& pipelines, ClothState& state, const Step& step) {
    const vulkan::ComputePipeline& pipeline = pipelines.get(touching("self_move.comp", state));
    add_pass(graph, state, step, "self move", pipeline, state.model->grid.size(), [&](PassSetup& setup) {
        touch(setup, state);
        setup.read(state[Field::self_shares], Access::compute_read, "shares");
        setup.read(state[Field::self_before], Access::compute_read, "before");
        update_in_place(setup, state[Field::self_record], "record");
    });
}

std::string self_readback_name(const ClothModel& cloth) { return cloth.name + "/self record on the host"; }

void add_self_readback(graph::Graph& graph, const ClothState& state) {
    const graph::Handle empty =
        graph.buffer({self_readback_name(*state.model), sizeof(glsl::SelfRecord), graph::Lifetime::host_output});
    const auto target = std::make_shared<graph::Handle>();  // set by set-up, used when recorded
    graph.add_pass(
        state.pass_name("self record readback", "simulate"),
        [&](PassSetup& setup) {
            setup.read(state[Field::self_record], Access::transfer_read);
            *target = setup.write(empty, Access::transfer_write);
        },
        [record = state[Field::self_record], target](graph::PassContext& context) {
            const VkBufferCopy whole{0, 0, sizeof(glsl::SelfRecord)};
            vkCmdCopyBuffer(context.commands(), context.buffer(record).handle(), context.buffer(*target).handle(), 1,
                            &whole);
        });
}

}  // namespace drape
