// A frame loop keeps these from frame to frame, as the parts of a checkpoint: the state fields of every cloth by the
// table (cloth/cloth_state.h), its cuts, and what the loop knows (engine/docs/checkpoint.md). The rest follows from the
// scene and the frame alone, such as the bounds of the watch, and is computed again.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/byte_stream.h"
#include "cloth/directions.h"
#include "cloth/statistics_transfer.h"
#include "cloth/texels.h"
#include "simulation/contact_report.h"
#include "simulation/frame_loop.h"
#include "world/frame_limit.h"

namespace drape {

namespace {

constexpr const char* loop_part = "loop";
constexpr std::string_view field_prefix = "field/";

std::string cuts_part(const ClothModel& cloth) { return "cuts/" + cloth.name; }

[[noreturn]] void refuse(const std::string& why) { throw Error("the saved state is not of this scene: " + why); }

/// Returns per particle and direction (cloth/directions.h) the fraction of its spring where it was cut, -1: not cut.
std::vector<std::byte> cut_bytes(const CutTopology& topology) {
    ByteWriter writer;
    const std::size_t count = topology.cloth().grid.particle_count();
    for (std::size_t particle = 0; particle < count; ++particle)
        for (std::size_t direction = 0; direction < spring_directions.size(); ++direction)
            writer(topology.cut_fraction(particle, direction));
    return writer.take();
}

}  // namespace

template <class Archive>
void FrameLoop::transfer(Archive& archive) {
    archive(next_frame_, state_substeps_, simulated_, motion_error_, beside_substeps_);
    sensitivity_.transfer(archive);
    if (!position_error_.transfer(archive)) refuse("not as many cloths that have errors");
    if (self_contact_) transfer_report(archive, *self_contact_);
    if (control_ && !control_->transfer(archive)) refuse("no such substeps");
    if (!sleep_.transfer(archive)) refuse("more speeds than are remembered");
    if (!drive_.transfer(archive)) refuse("not as many cloths that are driven");
    bool has_statistics = !attempt_statistics_.empty();
    archive(has_statistics);
    if (!has_statistics) return attempt_statistics_.clear();
    // A sleeping frame repeats the last one's, and its successor's ways begin there.
    if (attempt_statistics_.empty()) attempt_statistics_.emplace_back(model_.cloths.size());
    for (ClothStatistics& statistics : attempt_statistics_.back()) transfer_statistics(archive, statistics);
}

std::vector<std::byte> FrameLoop::host_state() const {
    ByteWriter writer;
    const_cast<FrameLoop*>(this)->transfer(writer);  // a writer changes nothing
    return writer.take();
}

bool FrameLoop::take_host_state(std::span<const std::byte> bytes) {
    ByteReader reader(bytes);
    transfer(reader);
    return reader.left() == 0 && can_be();
}

SimulationState FrameLoop::save() const {
    SimulationState state;
    for (auto& [name, bytes] : device_state()) state[std::string(field_prefix) + name] = std::move(bytes);
    for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth) {
        const CutTopology& topology = solver_.topologies()[cloth];
        if (model_.scene.comes_apart() && topology.masked())
            state[cuts_part(model_.cloths[cloth])] = cut_bytes(topology);
    }
    state[loop_part] = host_state();
    return state;
}

bool FrameLoop::can_be() const {
    // A loop may run beyond its scene's frames, but not beyond any scene's.
    const std::uint32_t most = std::max(scene_frame_limit, model_.scene.time.frame_count);
    if (std::max(next_frame_, simulated_) > most) return false;
    if (beside_substeps_.size() != state_set_count || std::ranges::count(beside_substeps_, 0u) > 0) return false;
    const bool as_it_begins = state_substeps_ == model_.scene.solver.substeps;
    if (!as_it_begins &&
        !(control_ && std::ranges::count(substep_rungs(row_of(model_.scene.solver.method)), state_substeps_) == 1))
        return false;
    // A sleeping frame needs the one that it repeats.
    return !sleep_.remembers() || !attempt_statistics_.empty();
}

void FrameLoop::restore_cuts(const SimulationState& state) {
    for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth) {
        CutTopology& topology = solver_.topologies()[cloth];
        if (model_.scene.comes_apart()) topology = CutTopology(topology.cloth());
        const auto part = state.find(cuts_part(model_.cloths[cloth]));
        if (part == state.end()) continue;
        CutFindings findings;
        findings.fractions.resize(model_.cloths[cloth].grid.particle_count());
        if (part->second.size() != findings.fractions.size() * sizeof(glsl::vec4)) refuse(part->first);
        std::memcpy(findings.fractions.data(), part->second.data(), part->second.size());
        topology.apply(findings);  // the order of the cuts changes neither what is cut nor what that splits
    }
}

void FrameLoop::restore(const SimulationState& state) {
    const auto loop = state.find(loop_part);
    if (loop == state.end()) refuse("it has no part 'loop'");
    withheld_.clear();  // a probe's, of the motion that is left
    if (!take_host_state(loop->second) || !can_save()) refuse("its part 'loop' is of something else");
    restore_cuts(state);
    SimulationState fields;
    for (const auto& [name, bytes] : state)
        if (name.starts_with(field_prefix)) fields[name.substr(field_prefix.size())] = bytes;
    for (const auto& [name, bytes] : device_state()) {
        const auto found = fields.find(name);
        if (found == fields.end() || !solver_.takes(name, bytes, found->second))
            refuse(fmt::format("field '{}'", name));
    }
    if (options_.lane) return options_.lane->upload(fields);
    rebuild_resources(fields);
}

}  // namespace drape
