#include <algorithm>

#include "solver/step_row.h"
#include "solver/step_size.h"

namespace drape {

namespace contact_rows {
namespace {

using Place = const StepPlace&;
using glsl::SelfContactPush;

/// Returns the push constants of a step of all cloths, with the capacity of the lists.
graph::PushConstants contact_push(Place p) {
    SelfContactPush push = p.step.push<SelfContactPush>();
    push.pair_capacity = static_cast<int>(p.contact->capacity.pairs);
    push.near_capacity = static_cast<int>(p.contact->capacity.near);
    push.cell_capacity = static_cast<int>(p.contact->capacity.cells);
    push.touching_capacity = static_cast<int>(p.contact->capacity.touching);
    return push;
}

using vulkan::ComputePipeline;
DispatchSize over_sheet(Place p, const ComputePipeline&) {
    constexpr std::size_t most = std::size_t{1} << 21;  // beyond it invocations take several places each
    const glsl::ivec2 grid = p.step.push<SelfContactPush>().grid;
    const std::size_t each = p.device.entries_each();
    return {static_cast<std::uint32_t>(std::min((std::size_t(grid.x) * std::size_t(grid.y) + each - 1) / each, most))};
}
DispatchSize over_cloths(Place p, const ComputePipeline&) {
    return {static_cast<std::uint32_t>(p.step.push<SelfContactPush>().cloth_count)};
}
DispatchSize over_leaders(Place p, const ComputePipeline&) {
    const auto count = static_cast<std::uint32_t>(p.step.push<SelfContactPush>().sewn_count);
    return {(count + glsl::workgroup_width - 1) / glsl::workgroup_width};
}
DispatchSize over_parts(Place p, const ComputePipeline&) {
    const auto [across, down] = p.device.over_parts(p.model.self_contact->largest);
    return {across, down, static_cast<std::uint32_t>(p.step.push<SelfContactPush>().cloth_count)};
}
/// The size that the passes before wrote: as far as they found something to do.
DispatchSize of_slot(Place p, int slot) {
    return {.sizes = (*p.contact)[ContactField::sizes], .slot = static_cast<std::size_t>(slot)};
}
template <int slot>
DispatchSize found(Place p, const ComputePipeline&) {
    return of_slot(p, slot);
}
template <int first_slot>
DispatchSize found_in_round(Place p, const ComputePipeline&) {
    return of_slot(p, first_slot + p.step.push<SelfContactPush>().round);
}
std::string motions_alias(Place p, std::string_view name, bool) {
    return name == "displacements" && p.step.looks_back ? "last_motions" : std::string();
}
}  // namespace
}  // namespace contact_rows

std::vector<StepRow> contact_step_rows() {
    using namespace contact_rows;
    using enum Kernel;
    // A step between a cloth's fields and the sheet takes its own push constants.
    const auto of_cloth = [](StepKind kind, const char* label, const char* shader) {
        return StepRow{kind, label, {{plain, shader, over_strips}}};
    };
    const auto of_all = [](StepKind kind, const char* label, const char* shader, auto size) {
        return StepRow{kind, label, {{plain, shader, size}}, contact_push};
    };
    using enum StepKind;
    StepRow gathered = of_cloth(self_gather, "self gather", "self_gather.comp"),
            returned = of_cloth(self_return, "self return", "self_return.comp"),
            contact = of_all(self_contact, "self contact", "self_contact.comp", found<glsl::self_size_contact>),
            push = of_all(self_push, "self push", "self_push.comp", found<glsl::self_size_push>);
    StepRow turned = of_cloth(self_turn, "self turn", "self_turn.comp");
    gathered.alias = returned.alias = turned.alias = before_alias;
    contact.alias = push.alias = motions_alias;
    return {
        gathered,
        of_all(self_boxes, "self boxes", "self_boxes.comp", over_sheet),
        of_all(self_tree, "self tree", "self_tree.comp", found<glsl::self_size_tree>),
        of_all(self_blocks, "self blocks", "self_blocks.comp", found<glsl::self_size_blocks>),
        of_all(self_near, "self near", "self_near.comp", over_parts),
        of_all(self_crossings, "self crossings", "self_crossings.comp", found<glsl::self_size_primitives>),
        of_all(self_apart, "self apart", "self_apart.comp", over_cloths),
        of_all(self_primitives, "self primitives", "self_primitives.comp", found<glsl::self_size_primitives>),
        of_all(self_pairs, "self pairs", "self_pairs.comp", found<glsl::self_size_pairs>),
        of_all(self_begin, "self begin", "self_begin.comp", found<glsl::self_size_contact>),
        contact,
        push,
        of_cloth(self_impulses, "impulses of contact", "self_impulses.comp"),
        of_all(self_limit, "self limit", "self_limit.comp", found_in_round<glsl::self_size_limit>),
        returned,
        {self_couples, "self couples", {{plain, "self_couples.comp", over_torque_sums}}},
        turned,
        of_all(self_sew, "self sew", "self_sew.comp", over_leaders),
    };
}

}  // namespace drape
