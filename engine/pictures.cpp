#include "pictures.h"

#include <algorithm>
#include <cstring>

#include "passes/position_upload.h"

namespace drape {

Pictures::Pictures(const vulkan::Device& device, const SimulationModel& model, const FrameLoopOptions& options)
    : device_(device), model_(model), options_(options), solver_(device, model, Schedule::images), slots_(device) {
    build();
    allocate();
}

void Pictures::build() {
    raster_.fit(device_, model_.scene, options_, solver_.topologies());
    graph_ = {};
    solver_.declare(graph_, {.drawing = true});
    solver_.add_positions(graph_);
    solver_.add_normals(graph_);
    raster_->add(graph_, raster_cloths(model_, solver_.cloths()));
    plan_ = graph::make_plan(graph_);
}

void Pictures::allocate() {
    recorded_.reset();
    pool_.reset();
    const std::pair<const graph::Graph*, const graph::Plan*> plans[] = {{&graph_, &plan_}};
    pool_ = std::make_unique<graph::ResourcePool>(device_, plans);
    solver_.upload(*pool_);
    record();
}

void Pictures::record() {
    recorded_ = std::make_unique<graph::RecordedPlan>(graph_, plan_, *pool_, options_.timestamps);
}

void Pictures::follow(const std::vector<CutTopology>& topologies) {
    for (std::uint32_t slot = 0; slot < vulkan::frame_slot_count; ++slot) {
        if (!pending_[slot] || pending_[slot]->has_picture) continue;
        PendingPicture kept;  // the slot's buffer may go
        kept.frame.keep(drawn(slot));
        kept.has_picture = true;
        pending_[slot] = std::move(kept);
    }
    bool new_resources = false;
    std::vector<CutImages> before;
    for (std::size_t cloth = 0; cloth < topologies.size(); ++cloth) {
        before.push_back(solver_.cut_images(cloth));
        new_resources = new_resources || draws_outgrown(before[cloth], topologies[cloth]) ||
                        solver_.topologies()[cloth].masked() != topologies[cloth].masked();
    }
    solver_.topologies() = topologies;
    build();  // how much is drawn is part of the recording
    if (new_resources) return allocate();
    for (std::size_t cloth = 0; cloth < topologies.size(); ++cloth) solver_.upload_cut(*pool_, cloth, before[cloth]);
    record();
}

void Pictures::draw(const FinishedFrame& frame, const Finished& finished) {
    const std::uint32_t slot = next_slot_;
    deliver(slot, finished);
    next_slot_ = (next_slot_ + 1) % vulkan::frame_slot_count;
    for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth) {
        const std::span<const std::byte> bytes = std::as_bytes(frame.positions[cloth]);
        std::memcpy(pool_->buffer(position_upload_name(model_.cloths[cloth]), slot).mapped().data(), bytes.data(),
                    bytes.size());
    }
    raster_->write_frame(*pool_, slot, frame.frame / model_.scene.time.fps);
    slots_.submit(slot, recorded_->commands(slot));
    FinishedFrame kept = frame;
    if (!options_.positions) kept.positions.clear();
    pending_[slot].emplace().frame.keep(kept);
}

FinishedFrame Pictures::drawn(std::uint32_t slot) {
    slots_.wait(slot);
    FinishedFrame frame = pending_[slot]->frame.frame();
    for (graph::Timing& timing : recorded_->timings(slot))
        frame.timings.push_back({std::move(timing.name), timing.milliseconds});
    const std::span<std::byte> bytes = pool_->buffer(RasterPass::readback_name, slot).mapped();
    raster_->finish(bytes.first(raster_->readback_byte_count()));
    frame.rgba = {reinterpret_cast<const std::uint8_t*>(bytes.data()), raster_->readback_byte_count()};
    return frame;
}

void Pictures::deliver(std::uint32_t slot, const Finished& finished) {
    if (!pending_[slot]) return;
    const FinishedFrame frame = pending_[slot]->has_picture ? pending_[slot]->frame.frame() : drawn(slot);
    const PendingPicture done = std::move(*pending_[slot]);  // what the frame's spans are of
    pending_[slot].reset();
    finished(frame);
}

void Pictures::flush(const Finished& finished) {
    for (std::uint32_t slot = 0; slot < vulkan::frame_slot_count; ++slot)
        deliver((next_slot_ + slot) % vulkan::frame_slot_count, finished);
}

}  // namespace drape
