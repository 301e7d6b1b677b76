#include "picture/pictures.h"

#include <algorithm>
#include <cstring>

#include "solver/position_upload.h"
#include "solver/state_transfer.h"

namespace drape {

namespace {

/// Returns how many frames may wait for their pictures: those of a probe and a few more, while their positions take at
/// most 64 MiB. Where cloth is cut, only frames in flight may wait, since a cut requires the pictures of all earlier
/// frames.
std::size_t most_pending(const SimulationModel& model) {
    constexpr std::size_t most = 16, most_bytes = std::size_t{64} << 20;
    if (model.scene.comes_apart()) return vulkan::frame_slot_count;
    std::size_t bytes = 0;
    for (const ClothModel& cloth : model.cloths) bytes += cloth.grid.particle_count() * sizeof(float[4]);
    return std::clamp<std::size_t>(most_bytes / bytes, vulkan::frame_slot_count, most);
}

}  // namespace

Pictures::Pictures(const vulkan::Device& device, const SimulationModel& model, const PictureOptions& options)
    : device_(device),
      model_(model),
      options_(options),
      solver_(device, model, Kernels()),
      slots_(device),
      most_pending_(most_pending(model)) {
    build();
    allocate();
}

void Pictures::build() {
    raster_.fit(device_, model_.scene, options_, solver_.layout().topologies);
    graph_ = {};
    solver_.declare(graph_, {.drawing = true});
    solver_.add_positions(graph_);
    solver_.add_normals(graph_);
    raster_.add(graph_, raster_cloths(model_, solver_.cloths()));
    plan_ = graph::make_plan(graph_);
}

void Pictures::allocate() {
    recorded_.reset();
    pool_.reset();
    const std::pair<const graph::Graph*, const graph::Plan*> plans[] = {{&graph_, &plan_}};
    pool_ = std::make_unique<graph::ResourcePool>(device_, plans);
    upload_start(solver_.layout(), *pool_);
    raster_.upload(*pool_);
    record();
}

void Pictures::record() {
    recorded_ = std::make_unique<graph::RecordedPlan>(graph_, plan_, *pool_, options_.timestamps);
}

void Pictures::follow(const std::vector<CutTopology>& topologies) {
    for (PendingPicture& picture : pending_) {
        if (picture.has_picture) continue;
        if (!picture.slot) begin(picture, *free_slot());  // earlier frames have freed theirs
        FrameCopy kept;                                   // the slot's buffer may be reused
        kept.keep(drawn(picture));
        picture = {std::move(kept), {}, true};
    }
    bool new_resources = false;
    std::vector<CutImages> before;
    for (std::size_t cloth = 0; cloth < topologies.size(); ++cloth) {
        before.push_back(cut_images(solver_.layout(), cloth));
        new_resources = new_resources || draws_outgrown(before[cloth], topologies[cloth]) ||
                        solver_.layout().topologies[cloth].masked() != topologies[cloth].masked();
    }
    solver_.layout().topologies = topologies;
    build();  // the recording says how much is drawn
    if (new_resources) return allocate();
    for (std::size_t cloth = 0; cloth < topologies.size(); ++cloth)
        upload_cut(solver_.layout(), *pool_, cloth, before[cloth]);
    record();
}

std::optional<std::uint32_t> Pictures::free_slot() const {
    for (std::uint32_t slot = 0; slot < vulkan::frame_slot_count; ++slot)
        if (std::ranges::none_of(pending_, [&](const PendingPicture& picture) { return picture.slot == slot; }))
            return slot;
    return {};
}

void Pictures::begin(PendingPicture& picture, std::uint32_t slot) {
    submit(picture.frame.frame(), slot, options_.motion_blur - 1);
    picture.slot = slot;
}

void Pictures::submit(const FinishedFrame& frame, std::uint32_t slot, std::uint32_t moment) {
    const double fps = model_.scene.time.fps, ago = open_shutter / fps * moment / options_.motion_blur;
    for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth) {
        std::vector<float> before;
        if (moment > 0) before = positions_before(frame.positions[cloth], frame.velocities[cloth], ago);
        const auto bytes = std::as_bytes(moment > 0 ? std::span<const float>(before) : frame.positions[cloth]);
        std::memcpy(pool_->buffer(position_upload_name(model_.cloths[cloth]), slot).mapped().data(), bytes.data(),
                    bytes.size());
    }
    raster_.write_frame(*pool_, slot, frame.frame / fps - ago, bodies_before(frame.bodies, ago));
    slots_.submit(slot, recorded_->commands(slot));
}

void Pictures::add_timings(FinishedFrame& frame, std::uint32_t slot) const {
    for (graph::Timing& timing : recorded_->timings(slot)) {
        const auto known = std::ranges::find(frame.timings, timing.name, &StageTime::name);
        if (known == frame.timings.end())
            frame.timings.push_back({std::move(timing.name), timing.milliseconds});
        else
            known->milliseconds += timing.milliseconds;
    }
}

void Pictures::blur(FinishedFrame& frame, std::uint32_t slot) {
    mean_.clear();
    mean_.add(frame.rgba);
    for (std::uint32_t moment = options_.motion_blur - 1; moment-- > 0;) {
        submit(frame, slot, moment);
        slots_.wait(slot);
        raster_.read(*pool_, slot, frame);
        add_timings(frame, slot);
        mean_.add(frame.rgba);
    }
    frame.rgba = mean_.mean();
}

void Pictures::begin_waiting() {
    for (PendingPicture& picture : pending_) {
        if (picture.slot || picture.has_picture) continue;
        const auto slot = free_slot();
        if (!slot) return;
        begin(picture, *slot);
    }
}

FinishedFrame Pictures::drawn(const PendingPicture& picture) {
    const std::uint32_t slot = *picture.slot;
    slots_.wait(slot);
    FinishedFrame frame = picture.frame.frame();
    raster_.read(*pool_, slot, frame);
    add_timings(frame, slot);
    if (options_.motion_blur > 1) blur(frame, slot);
    if (!options_.positions) frame.positions.clear();
    if (!options_.velocities) frame.velocities.clear();
    return frame;
}

bool Pictures::is_there(const PendingPicture& picture) const {
    return picture.has_picture || (picture.slot && slots_.is_done(*picture.slot));
}

void Pictures::deliver(const Finished& finished) {
    const PendingPicture& first = pending_.front();
    const FinishedFrame frame = first.has_picture ? first.frame.frame() : drawn(first);
    const PendingPicture done = std::move(pending_.front());  // the frame's spans point into it
    pending_.pop_front();
    finished(frame);
}

void Pictures::draw(const FinishedFrame& frame, const Finished& finished) {
    pending_.emplace_back().frame.keep(frame);
    go_on(finished);
    while (pending_.size() > most_pending_) {
        deliver(finished);
        begin_waiting();
    }
}

void Pictures::go_on(const Finished& finished) {
    begin_waiting();
    while (!pending_.empty() && is_there(pending_.front())) {
        deliver(finished);
        begin_waiting();
    }
}

void Pictures::flush(const Finished& finished) {
    while (!pending_.empty()) {
        begin_waiting();
        deliver(finished);
    }
}

}  // namespace drape
