#include "hazard_checker.h"

#include <array>
#include <optional>
#include <set>

namespace drape::graph {
namespace {

constexpr std::array<VkPipelineStageFlags2, 10> all_stages = {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                                                              VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT,
                                                              VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT,
                                                              VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT,
                                                              VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                                              VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                                                              VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                                              VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                                              VK_PIPELINE_STAGE_2_TRANSFER_BIT,
                                                              VK_PIPELINE_STAGE_2_HOST_BIT};

constexpr VkAccessFlags2 all_reads = VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT |
                                     VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT |
                                     VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_TRANSFER_READ_BIT |
                                     VK_ACCESS_2_HOST_READ_BIT;
constexpr VkAccessFlags2 all_writes = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
                                      VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;

VkPipelineStageFlags2 expand_stages(VkPipelineStageFlags2 stages) {
    if (!(stages & VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT)) return stages;
    for (const auto stage : all_stages) {
        if (stage != VK_PIPELINE_STAGE_2_HOST_BIT) stages |= stage;
    }
    return stages;
}

VkAccessFlags2 expand_accesses(VkAccessFlags2 accesses) {
    if (accesses & VK_ACCESS_2_MEMORY_READ_BIT) accesses |= all_reads;
    if (accesses & VK_ACCESS_2_MEMORY_WRITE_BIT) accesses |= all_writes;
    return accesses;
}

/// A use of the resource or a barrier, in submission order.
struct Event {
    std::string name;
    std::size_t command = 0;  ///< uses of one pass share it: nothing can be put between them
    bool is_barrier = false, from_host = false;
    VkPipelineStageFlags2 stages = 0;  ///< stages of a use
    VkAccessFlags2 accesses = 0;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    Barrier barrier{};  ///< expanded
    bool changes_layout() const { return is_barrier && barrier.old_layout != barrier.new_layout; }
    VkAccessFlags2 writes() const { return accesses & all_writes; }
};

Event use_event(Access access, std::string name, std::size_t command) {
    Event event;
    event.name = std::move(name);
    event.command = command;
    event.layout = VK_IMAGE_LAYOUT_GENERAL;
    const auto set = [&](VkPipelineStageFlags2 stages, VkAccessFlags2 accesses) {
        event.stages = stages;
        event.accesses = accesses;
    };
    switch (access) {
        case Access::compute_read:
            set(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
            break;
        case Access::compute_write:
            set(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
            break;
        case Access::vertex_read:
            set(VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
            break;
        case Access::fragment_read:
            set(VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
            break;
        case Access::index_read:
            set(VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT);
            break;
        case Access::indirect_read:
            set(VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
            break;
        case Access::color_write:
            set(VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
            event.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
            break;
        case Access::depth_write:
            set(VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT);
            event.layout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
            break;
        case Access::resolve_write:
            set(VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
            event.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
            break;
        case Access::transfer_read:
            set(VK_PIPELINE_STAGE_2_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
            break;
        case Access::transfer_write:
            set(VK_PIPELINE_STAGE_2_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT);
            break;
        case Access::host_read:
            set(VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
            event.from_host = true;
            break;
    }
    return event;
}

/// Follows one earlier access (one stage, at most one kind of write; or a layout change, available by itself) through
/// the barriers that come after it.
class Track {
  public:
    Track(VkPipelineStageFlags2 stage, VkAccessFlags2 write) : stage_(stage), write_(write) {}
    explicit Track(const Barrier& layout_change) : write_(all_writes) {
        ordered_ = available_ = layout_change.destination_stages;
        see(layout_change);
    }

    void pass(const Barrier& barrier) {
        const bool available = available_at(barrier);
        if (ordered_at(barrier)) ordered_ |= barrier.destination_stages;
        if (!available) return;
        available_ |= barrier.destination_stages;
        see(barrier);
    }

    std::optional<std::string> problem_of_use(const Event& later) const {
        if (write_ == 0 && later.writes() == 0) return {};
        for (std::size_t s = 0; s < all_stages.size(); ++s) {
            if (!(later.stages & all_stages[s])) continue;
            if (!(ordered_ & all_stages[s])) return "no execution dependency";
            if (write_ != 0 && (later.accesses & ~visible_[s]) != 0) return "not made visible";
        }
        return {};
    }

    std::optional<std::string> problem_of_layout_change(const Barrier& barrier) const {
        if (!ordered_at(barrier)) return "layout changed without execution dependency";
        if (write_ != 0 && !available_at(barrier)) return "layout changed before the write is available";
        return {};
    }

  private:
    bool ordered_at(const Barrier& barrier) const { return (barrier.source_stages & (stage_ | ordered_)) != 0; }
    bool available_at(const Barrier& barrier) const {
        const bool directly = (barrier.source_stages & stage_) != 0 && (barrier.source_accesses & write_) != 0;
        return directly || (barrier.source_stages & available_) != 0;
    }
    void see(const Barrier& barrier) {
        for (std::size_t s = 0; s < all_stages.size(); ++s) {
            if (barrier.destination_stages & all_stages[s]) visible_[s] |= barrier.destination_accesses;
        }
    }

    VkPipelineStageFlags2 stage_ = 0;
    VkAccessFlags2 write_ = 0;
    VkPipelineStageFlags2 ordered_ = 0;    ///< work that starts here starts after the access
    VkPipelineStageFlags2 available_ = 0;  ///< work that starts here starts after the write is available
    std::array<VkAccessFlags2, all_stages.size()> visible_{};
};

std::vector<Track> tracks_of(const Event& event) {
    std::vector<Track> tracks;
    if (event.is_barrier) {
        tracks.emplace_back(event.barrier);
        return tracks;
    }
    for (const auto stage : all_stages) {
        if (event.stages & stage) tracks.emplace_back(stage, event.writes());
    }
    return tracks;
}

class History {
  public:
    History(std::span<const Execution> sequence, std::string resource) : name_(std::move(resource)) {
        for (const Execution& execution : sequence) add(execution);
    }

    void find(std::vector<Hazard>& hazards) {
        hazards.insert(hazards.end(), layout_hazards_.begin(), layout_hazards_.end());
        for (std::size_t x = 0; x < events_.size(); ++x) {
            const Event& earlier = events_[x];
            // A host read ends before the next submit begins, so nothing on the device has to wait for it.
            if (earlier.from_host || (earlier.is_barrier && !earlier.changes_layout())) continue;
            for (Track& track : tracks_of(earlier)) follow(x, track, hazards);
        }
    }

  private:
    void follow(std::size_t x, Track& track, std::vector<Hazard>& hazards) const {
        for (std::size_t y = x + 1; y < events_.size(); ++y) {
            const Event& later = events_[y];
            std::optional<std::string> problem;
            if (!later.is_barrier) {
                if (later.command != events_[x].command) problem = track.problem_of_use(later);
            } else {
                if (later.changes_layout()) problem = track.problem_of_layout_change(later.barrier);
                track.pass(later.barrier);
            }
            if (problem) hazards.push_back({name_, events_[x].name, later.name, *problem});
        }
    }

    void add(const Execution& execution) {
        const auto& resources = execution.graph->resources();
        std::uint32_t r = 0;
        while (r < resources.size() && resources[r].name != name_) ++r;
        if (r == resources.size()) return;
        const Lifetime lifetime = resources[r].lifetime;
        is_image_ = resources[r].is_image;
        has_buffer_view_ = resources[r].image.buffer_view;
        const bool rests = lifetime == Lifetime::persistent || lifetime == Lifetime::constant;
        if (events_.empty() && (rests || has_buffer_view_)) {
            events_.push_back(use_event(Access::transfer_write, "set-up", command_++));
            layout_ = VK_IMAGE_LAYOUT_GENERAL;
        }
        if (!rests && !has_buffer_view_) layout_ = VK_IMAGE_LAYOUT_UNDEFINED;
        holds_contents_ = rests;
        bool written = false;
        for (const PlannedPass& planned : execution.plan->passes) {
            for (const Barrier& barrier : planned.barriers) add_barrier(r, barrier);
            const Pass& pass = execution.graph->passes()[planned.pass];
            ++command_;
            for (const Use& use : pass.uses) {
                if (use.handle.resource != r) continue;
                add_use(use_event(use.access, pass.name, command_));
                written = written || events_.back().writes() != 0;
            }
        }
        for (const Barrier& barrier : execution.plan->final_barriers) add_barrier(r, barrier);
        ++command_;
        if (lifetime == Lifetime::host_output && written) {
            add_use(use_event(Access::host_read, "host after the plan", command_));
        }
        if (is_image_ && (rests || has_buffer_view_) && layout_ != VK_IMAGE_LAYOUT_GENERAL) {
            layout_hazards_.push_back({name_, "plan", "end of plan", "does not rest in GENERAL"});
        }
    }

    void add_use(Event event) {
        if (is_image_ && event.layout != layout_) {
            layout_hazards_.push_back({name_, "layout", event.name, "used in the wrong layout"});
        }
        holds_contents_ = holds_contents_ || event.writes() != 0;
        events_.push_back(std::move(event));
    }

    void add_barrier(std::uint32_t resource, const Barrier& barrier) {
        if (barrier.resource != resource) return;
        Event event;
        event.name = "barrier (" + barrier.reason + ")";
        event.command = ++command_;
        event.is_barrier = true;
        event.barrier = barrier;
        event.barrier.source_stages = expand_stages(barrier.source_stages);
        event.barrier.destination_stages = expand_stages(barrier.destination_stages);
        event.barrier.source_accesses = expand_accesses(barrier.source_accesses);
        event.barrier.destination_accesses = expand_accesses(barrier.destination_accesses);
        if (event.changes_layout()) {
            if (barrier.old_layout == VK_IMAGE_LAYOUT_UNDEFINED ? holds_contents_ : barrier.old_layout != layout_) {
                layout_hazards_.push_back({name_, "layout", event.name, "changed from a layout it is not in"});
            }
            // An image's barrier covers accesses through the image alone; the use may be one through the buffer.
            if (has_buffer_view_)
                layout_hazards_.push_back({name_, "layout", event.name, "changed under a buffer view"});
            layout_ = barrier.new_layout;
        }
        events_.push_back(std::move(event));
    }

    std::string name_;
    bool is_image_ = false, has_buffer_view_ = false;
    bool holds_contents_ = false;
    VkImageLayout layout_ = VK_IMAGE_LAYOUT_UNDEFINED;
    std::size_t command_ = 0;
    std::vector<Event> events_;
    std::vector<Hazard> layout_hazards_;
};

}  // namespace

std::vector<Hazard> find_hazards(std::span<const Execution> sequence, const std::string& only) {
    std::set<std::string> names;
    for (const Execution& execution : sequence) {
        for (const Resource& resource : execution.graph->resources()) names.insert(resource.name);
    }
    if (!only.empty()) names = {only};
    std::vector<Hazard> hazards;
    for (const std::string& name : names) History(sequence, name).find(hazards);
    return hazards;
}

std::vector<BarrierPlace> barrier_places(const Plan& plan) {
    std::vector<BarrierPlace> places;
    for (std::size_t p = 0; p < plan.passes.size(); ++p) {
        for (std::size_t b = 0; b < plan.passes[p].barriers.size(); ++b) places.push_back({p, b});
    }
    for (std::size_t b = 0; b < plan.final_barriers.size(); ++b) places.push_back({plan.passes.size(), b});
    return places;
}

namespace {
std::vector<Barrier>& barriers_of(Plan& plan, std::size_t pass) {
    return pass < plan.passes.size() ? plan.passes[pass].barriers : plan.final_barriers;
}
}  // namespace

Barrier& barrier_at(Plan& plan, BarrierPlace place) { return barriers_of(plan, place.pass)[place.index]; }

void remove_barrier(Plan& plan, BarrierPlace place) {
    auto& barriers = barriers_of(plan, place.pass);
    barriers.erase(barriers.begin() + static_cast<std::ptrdiff_t>(place.index));
}

std::vector<BarrierPlace> redundant_barriers(const Graph& graph, const Plan& plan) {
    std::vector<BarrierPlace> redundant;
    for (const BarrierPlace place : barrier_places(plan)) {
        Plan weaker = plan;
        const std::string resource = graph.resources()[barrier_at(weaker, place).resource].name;
        remove_barrier(weaker, place);
        const Execution executions[] = {{&graph, &weaker}, {&graph, &weaker}};
        if (find_hazards(executions, resource).empty()) redundant.push_back(place);
    }
    return redundant;
}

}  // namespace drape::graph
