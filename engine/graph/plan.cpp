#include "graph/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string_view>

#include "vulkan/error.h"
#include "vulkan/frame_slots.h"

namespace drape::graph {
namespace {

constexpr VkAccessFlags2 write_accesses =
    VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;

bool always_wanted(const Resource& resource) {
    return resource.lifetime == Lifetime::persistent || resource.lifetime == Lifetime::host_output;
}

/// Returns whether version 0 has contents, so that a pass may read it before this plan writes it.
bool has_initial_contents(const Resource& resource) {
    return resource.lifetime != Lifetime::transient && resource.lifetime != Lifetime::host_output;
}

/// Finds the passes that run. Going backwards, every reader of a version is seen before its writer; and since a write
/// keeps what it does not overwrite, wanting version v wants every version up to v.
class Culling {
  public:
    explicit Culling(const Graph& graph) : graph_(graph), alive_(graph.passes().size()) {
        std::vector<std::uint32_t> wanted(graph.resources().size(), 0);
        for (std::size_t r = 0; r < wanted.size(); ++r) {
            const Resource& resource = graph.resources()[r];
            if (always_wanted(resource)) wanted[r] = resource.version;
        }
        for (std::size_t p = alive_.size(); p-- > 0;) {
            const Pass& pass = graph.passes()[p];
            alive_[p] = std::any_of(pass.uses.begin(), pass.uses.end(), [&](const Use& use) {
                if (use.access == Access::host_read) return true;
                return is_write(use.access) && use.handle.version <= wanted[use.handle.resource];
            });
            if (!alive_[p]) continue;
            for (const Use& use : pass.uses) {
                if (is_write(use.access)) continue;
                wanted[use.handle.resource] = std::max(wanted[use.handle.resource], use.handle.version);
            }
        }
    }

    bool alive(std::size_t pass) const { return alive_[pass]; }

    void explain(std::vector<Remark>& skipped) const {
        // The culled passes that read each resource, so that the reason can name the end of a dead chain.
        std::vector<std::vector<std::uint32_t>> readers(graph_.resources().size());
        for (std::size_t p = 0; p < alive_.size(); ++p) {
            if (alive_[p]) continue;
            for (const Use& use : graph_.passes()[p].uses) {
                if (!is_write(use.access)) readers[use.handle.resource].push_back(static_cast<std::uint32_t>(p));
            }
        }
        for (std::size_t p = 0; p < alive_.size(); ++p) {
            if (!alive_[p]) skipped.push_back({graph_.passes()[p].name, reason(p, readers)});
        }
    }

  private:
    std::string reason(std::size_t p, const std::vector<std::vector<std::uint32_t>>& readers) const {
        std::string reason;
        for (const Use& use : graph_.passes()[p].uses) {
            if (!is_write(use.access)) continue;
            const std::string& name = graph_.resources()[use.handle.resource].name;
            const auto& later = readers[use.handle.resource];
            const auto reader = std::upper_bound(later.begin(), later.end(), static_cast<std::uint32_t>(p));
            if (!reason.empty()) reason += "; ";
            if (reader == later.end()) {
                reason += fmt::format("nothing reads {}", name);
            } else {
                reason +=
                    fmt::format("{} is read only by '{}', which is skipped", name, graph_.passes()[*reader].label);
            }
        }
        return reason.empty() ? "writes nothing" : reason;
    }

    const Graph& graph_;
    std::vector<bool> alive_;
};

/// The uses of one resource by one pass, merged.
struct Need {
    std::uint32_t resource = 0;
    std::uint32_t reads = 0;  ///< bits 1 << Access
    std::optional<Access> write;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};

std::uint32_t bit(Access access) { return 1u << static_cast<std::uint32_t>(access); }

struct Scope {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 accesses = 0;
    void add(Access access) {
        const AccessScope scope = access_scope(access);
        stages |= scope.stages;
        accesses |= scope.accesses;
    }
    void add_reads(std::uint32_t reads) {
        for (std::uint32_t a = 0; reads >> a != 0; ++a) {
            if (reads >> a & 1u) add(static_cast<Access>(a));
        }
    }
};

/// What is known of one resource after the passes planned so far.
struct State {
    enum class Phase : std::uint8_t {
        untouched,
        entry,   ///< only read so far: later readers join the entry barrier
        ordered  ///< written (or its layout changed) in this plan
    } phase = Phase::untouched;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    Scope last_write;           ///< no accesses: a layout change, which needs no further availability
    std::uint32_t visible = 0;  ///< read accesses for which the last write is visible
    VkPipelineStageFlags2 readers = 0;
    VkPipelineStageFlags2 available = 0;       ///< stages that wait until the last write is available
    bool reads_follow_write = false;           ///< waiting for `readers` also waits for the last write
    std::uint32_t entry_barrier = UINT32_MAX;  ///< index into the entry barriers
    std::uint32_t last_pass = UINT32_MAX;      ///< the pass of the last write or, in phase entry, of the last read
    Access last_access = Access::compute_read;
};

/// Derives barriers pass by pass. The waits for earlier submissions all stand before the first pass: they wait for
/// everything, and one wait at the start stalls less than many later ones.
class BarrierPlanner {
  public:
    explicit BarrierPlanner(const Graph& graph) : graph_(graph), states_(graph.resources().size()) {}

    void visit(std::uint32_t pass, Plan& plan) {
        PlannedPass planned{pass, {}};
        collect_needs(graph_.passes()[pass]);
        const auto position = static_cast<std::uint32_t>(plan.passes.size());
        for (const Need& need : needs_) {
            Lifespan& lifespan = plan.lifespans[need.resource];
            lifespan.first = std::min(lifespan.first, position);
            lifespan.last = position;
            satisfy(need, pass, planned.barriers);
        }
        plan.passes.push_back(std::move(planned));
    }

    void finish(Plan& plan) {
        for (std::uint32_t r = 0; r < states_.size(); ++r) leave(r, plan.final_barriers);
        if (plan.passes.empty()) return;
        auto& first = plan.passes.front().barriers;
        first.insert(first.begin(), std::make_move_iterator(entry_.begin()), std::make_move_iterator(entry_.end()));
    }

  private:
    void collect_needs(const Pass& pass) {
        needs_.clear();
        for (const Use& use : pass.uses) {
            auto need = std::find_if(needs_.begin(), needs_.end(),
                                     [&](const Need& n) { return n.resource == use.handle.resource; });
            if (need == needs_.end()) need = needs_.insert(needs_.end(), Need{use.handle.resource, 0, {}, {}});
            if (is_write(use.access)) {
                need->write = use.access;
            } else {
                need->reads |= bit(use.access);
                check_readable(pass, use);
            }
            if (graph_.resources()[use.handle.resource].is_image) need->layout = access_scope(use.access).layout;
        }
    }

    void check_readable(const Pass& pass, const Use& use) const {
        const Resource& resource = graph_.resources()[use.handle.resource];
        if (use.handle.version > 0 || has_initial_contents(resource)) return;
        throw GraphError(fmt::format("pass '{}', resource '{}': read of a {} resource that nobody wrote", pass.name,
                                     resource.name, lifetime_name(resource.lifetime)));
    }

    void satisfy(const Need& need, std::uint32_t pass, std::vector<Barrier>& barriers) {
        State& state = states_[need.resource];
        switch (state.phase) {
            case State::Phase::untouched:
                enter(need, state, pass);
                break;
            case State::Phase::entry:
                continue_entry(need, state, pass, barriers);
                break;
            case State::Phase::ordered:
                order(need, state, pass, barriers);
                break;
        }
        record(need, state, pass);
    }

    void enter(const Need& need, State& state, std::uint32_t pass) {
        const Resource& resource = graph_.resources()[need.resource];
        state.phase = State::Phase::entry;
        state.layout = need.layout;
        // A submit makes the host's writes visible, and nothing on the device writes a host input.
        if (resource.lifetime == Lifetime::host_input) return;
        Scope destination;
        destination.add_reads(need.reads);
        if (need.write) destination.add(*need.write);
        const bool forgotten = resource.lifetime == Lifetime::transient && !resource.image.stays_general();
        const VkImageLayout rest = forgotten ? VK_IMAGE_LAYOUT_UNDEFINED : VK_IMAGE_LAYOUT_GENERAL;
        state.entry_barrier = static_cast<std::uint32_t>(entry_.size());
        entry_.push_back({need.resource, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, destination.stages,
                          VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT, destination.accesses,
                          resource.is_image ? rest : VK_IMAGE_LAYOUT_UNDEFINED, state.layout,
                          fmt::format("{}: earlier submissions -> {}", resource.name, describe(need, pass))});
    }

    void continue_entry(const Need& need, State& state, std::uint32_t pass, std::vector<Barrier>& barriers) {
        if (need.write || need.layout != state.layout) {
            order(need, state, pass, barriers);
            return;
        }
        if (state.entry_barrier == UINT32_MAX) return;
        Scope destination;
        destination.add_reads(need.reads & ~state.visible);
        entry_[state.entry_barrier].destination_stages |= destination.stages;
        entry_[state.entry_barrier].destination_accesses |= destination.accesses;
    }

    void order(const Need& need, State& state, std::uint32_t pass, std::vector<Barrier>& barriers) {
        const bool new_layout = need.layout != state.layout;
        Scope destination;
        destination.add_reads(new_layout ? need.reads : need.reads & ~state.visible);
        if (need.write) destination.add(*need.write);
        if (destination.stages == 0) return;
        const Scope source = need.write || new_layout ? after_readers(state) : after_write(state);
        // This waits for a reader at the writer's stage too, so later waits for this use include that reader.
        if (!need.write) state.readers &= ~source.stages;
        state.available |= destination.stages;
        const Resource& resource = graph_.resources()[need.resource];
        barriers.push_back({need.resource, source.stages, destination.stages, source.accesses, destination.accesses,
                            state.layout, need.layout,
                            fmt::format("{}: {} by {} -> {}", resource.name, access_name(state.last_access),
                                        graph_.passes()[state.last_pass].label, describe(need, pass))});
        if (new_layout) {
            state.last_write = {destination.stages & (~destination.stages + 1), 0};  // one stage is enough
            state.visible = 0;
            state.readers = 0;
            state.phase = State::Phase::ordered;
            state.layout = need.layout;
        }
    }

    /// Returns the source of a barrier for a reader of the last write.
    static Scope after_write(const State& state) {
        // The write is already available if a reader at the writer's stage came in between.
        const bool available = (state.last_write.stages & state.available) != 0;
        return {state.last_write.stages, available ? 0 : state.last_write.accesses & write_accesses};
    }

    /// Returns the source of a barrier for the next write. Readers of the last write come between the two writes:
    /// waiting for them is enough, and the last write is already available.
    static Scope after_readers(const State& state) {
        if (state.reads_follow_write) return {state.readers, 0};
        return {state.last_write.stages | state.readers, state.last_write.accesses & write_accesses};
    }

    /// Updates the state after the pass and its barriers.
    void record(const Need& need, State& state, std::uint32_t pass) {
        Scope reads;
        reads.add_reads(need.reads);
        if (!need.write) {
            state.visible |= need.reads;
            state.readers |= reads.stages;
            state.reads_follow_write = true;
        } else {
            state.last_write = {};
            state.last_write.add(*need.write);
            state.available = 0;
            state.visible = 0;
            state.readers = reads.stages & ~state.last_write.stages;
            state.reads_follow_write = false;
            state.phase = State::Phase::ordered;
        }
        state.last_pass = pass;
        state.last_access = need.write ? *need.write : first_access(need.reads);
    }

    /// Adds the barriers after which the next plan, or the host, can use a resource.
    void leave(std::uint32_t r, std::vector<Barrier>& barriers) {
        const State& state = states_[r];
        const Resource& resource = graph_.resources()[r];
        if (state.phase != State::Phase::ordered) return;
        if (resource.lifetime == Lifetime::host_output && !(state.visible & bit(Access::host_read))) {
            const Scope source = after_write(state);
            barriers.push_back({r, source.stages, VK_PIPELINE_STAGE_2_HOST_BIT, source.accesses,
                                VK_ACCESS_2_HOST_READ_BIT, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_UNDEFINED,
                                fmt::format("{}: {} by {} -> read by the host", resource.name,
                                            access_name(state.last_access), graph_.passes()[state.last_pass].label)});
        }
        if (resource.lifetime == Lifetime::persistent && resource.is_image && state.layout != VK_IMAGE_LAYOUT_GENERAL) {
            const Scope source = after_readers(state);
            // Its destination is all stages, so that the entry barrier of any plan that follows can wait for it.
            barriers.push_back({r, source.stages, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, source.accesses, 0,
                                state.layout, VK_IMAGE_LAYOUT_GENERAL,
                                fmt::format("{}: back to its layout of rest", resource.name)});
        }
    }

    static Access first_access(std::uint32_t reads) { return static_cast<Access>(__builtin_ctz(reads)); }

    std::string describe(const Need& need, std::uint32_t pass) const {
        const std::string& label = graph_.passes()[pass].label;
        if (!need.write) return fmt::format("{} by {}", access_name(first_access(need.reads)), label);
        if (need.reads == 0) return fmt::format("{} by {}", access_name(*need.write), label);
        return fmt::format("{} and {} by {}", access_name(first_access(need.reads)), access_name(*need.write), label);
    }

    const Graph& graph_;
    std::vector<State> states_;
    std::vector<Need> needs_;  ///< of the current pass; a member to reuse its memory
    std::vector<Barrier> entry_;
};

std::uint64_t total_bytes(const Graph& graph, const Plan& plan) {
    std::uint64_t total = 0;
    for (std::size_t r = 0; r < graph.resources().size(); ++r) {
        if (!plan.lifespans[r].used()) continue;
        const Resource& resource = graph.resources()[r];
        std::uint64_t bytes = 0;
        if (__builtin_mul_overflow(resource.byte_count(), std::uint64_t{copy_count(resource)}, &bytes) ||
            __builtin_add_overflow(total, bytes, &total)) {
            throw vulkan::VulkanError(fmt::format("resource '{}': the plan's sizes exceed 64 bits", resource.name));
        }
    }
    return total;
}

}  // namespace

std::uint32_t copy_count(const Resource& resource) {
    const bool per_slot = resource.lifetime == Lifetime::host_input || resource.lifetime == Lifetime::host_output;
    return per_slot ? vulkan::frame_slot_count : 1;
}

AccessScope access_scope(Access access) {
    constexpr auto storage_read = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
    switch (access) {
        case Access::compute_read:
            return {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, storage_read, VK_IMAGE_LAYOUT_GENERAL};
        case Access::compute_write:
            return {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                    VK_IMAGE_LAYOUT_GENERAL};
        case Access::vertex_read:
            return {VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, storage_read, VK_IMAGE_LAYOUT_GENERAL};
        case Access::fragment_read:
            return {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, storage_read, VK_IMAGE_LAYOUT_GENERAL};
        case Access::index_read:
            return {VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT, VK_IMAGE_LAYOUT_UNDEFINED};
        case Access::indirect_read:
            return {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT,
                    VK_IMAGE_LAYOUT_UNDEFINED};
        case Access::color_write:
            return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        case Access::depth_write:
            return {VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
                    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL};
        case Access::resolve_write:
            return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
                    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
        case Access::transfer_read:
            return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, VK_IMAGE_LAYOUT_GENERAL};
        case Access::transfer_write:
            return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL};
        case Access::host_read:
            return {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT, VK_IMAGE_LAYOUT_UNDEFINED};
    }
    throw GraphError("access_scope: no such access");
}

Plan make_plan(const Graph& graph) {
    Plan plan;
    plan.lifespans.resize(graph.resources().size());
    plan.skipped = graph.skipped();
    const Culling culling(graph);
    BarrierPlanner planner(graph);
    for (std::uint32_t p = 0; p < graph.passes().size(); ++p) {
        if (culling.alive(p)) planner.visit(p, plan);
    }
    planner.finish(plan);
    culling.explain(plan.skipped);
    plan.byte_count = total_bytes(graph, plan);
    return plan;
}

}  // namespace drape::graph
