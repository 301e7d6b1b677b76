#include "frame_loop.h"

#include "passes/readback_pass.h"

namespace drape {

namespace {

std::vector<RasterCloth> raster_cloths(const SimulationModel& model, const std::vector<ClothState>& states) {
    std::vector<RasterCloth> cloths;
    for (const ClothState& state : states) {
        const Cloth& cloth = model.scene.cloths[state.index];
        const Grid& grid = state.model->grid;
        cloths.push_back({cloth.name, grid.columns(), grid.rows(), cloth.size[0], cloth.size[1], cloth.appearance,
                          state.position, state.normal, state.triangles,
                          static_cast<std::uint32_t>(grid.triangle_indices().size())});
    }
    return cloths;
}

}  // namespace

FrameLoop::FrameLoop(const vulkan::Device& device, const SimulationModel& model, const FrameLoopOptions& options)
    : device_(device), model_(model), options_(options), solver_(device, model), slots_(device) {
    if (options.draw)
        raster_ = std::make_unique<RasterPass>(device, model.scene, options.width, options.height, options.samples);
    std::vector<std::pair<const graph::Graph*, const graph::Plan*>> plans;
    for (std::size_t kind = 0; kind < frame_kind_count; ++kind) {
        build(static_cast<FrameKind>(kind));
        plans.emplace_back(&frames_[kind].graph, &frames_[kind].plan);
    }
    pool_ = std::make_unique<graph::ResourcePool>(device, plans);
    for (Frame& frame : frames_)
        frame.recorded = std::make_unique<graph::RecordedPlan>(frame.graph, frame.plan, *pool_, options.timestamps,
                                                               options.barrier_filter);
    solver_.upload(*pool_);
}

FrameLoop::~FrameLoop() {
    // The slots wait for what is in flight before the recordings and images go.
    for (std::uint32_t slot = 0; slot < vulkan::frame_slot_count; ++slot) {
        try {
            slots_.wait(slot);
        } catch (const vulkan::VulkanError&) {  // a lost device has nothing in flight
        }
    }
}

void FrameLoop::build(FrameKind kind) {
    Frame& frame = frames_[static_cast<std::size_t>(kind)];
    const bool output = kind != FrameKind::simulate;
    solver_.declare(frame.graph, output && options_.draw);
    if (kind != FrameKind::initial) solver_.add_simulation(frame.graph);
    if (output && options_.draw) {
        solver_.add_normals(frame.graph);
        raster_->add(frame.graph, raster_cloths(model_, solver_.cloths()));
    } else if (!options_.draw) {
        frame.graph.skip("normals, raster and colour readback", "no picture is wanted");
    }
    if (output && options_.positions) {
        for (ClothState state : solver_.cloths()) add_position_readback(frame.graph, state);
    } else if (!options_.positions) {
        frame.graph.skip("position readback", "no position export is wanted");
    }
    if (output && options_.statistics)
        solver_.add_statistics(frame.graph);
    else if (!options_.statistics)
        frame.graph.skip("statistics", "nobody asked for them");
    frame.plan = graph::make_plan(frame.graph);
}

void FrameLoop::submit(std::uint32_t slot, std::uint32_t frame, FrameKind kind) {
    // The initial frame simulates nothing, but its statistics need to know where the colliders are.
    if (kind != FrameKind::initial || options_.statistics) solver_.write_inputs(*pool_, slot, frame);
    if (kind != FrameKind::simulate && raster_) raster_->write_frame(*pool_, slot, frame / model_.scene.time.fps);
    slots_.submit(slot, frames_[static_cast<std::size_t>(kind)].recorded->commands(slot));
    in_flight_[slot] = InFlight{frame, kind, kind != FrameKind::simulate};
}

void FrameLoop::deliver(std::uint32_t slot, const std::function<void(const FinishedFrame&)>& finished) {
    slots_.wait(slot);
    if (!in_flight_[slot]) return;
    const InFlight done = *in_flight_[slot];
    in_flight_[slot].reset();
    FinishedFrame result{done.frame, {}, {}, {}, frames_[static_cast<std::size_t>(done.kind)].recorded->timings(slot)};
    if (done.output && options_.draw) {
        const std::span<std::byte> bytes = pool_->buffer(RasterPass::readback_name, slot).mapped();
        result.rgba = {reinterpret_cast<const std::uint8_t*>(bytes.data()), raster_->readback_byte_count()};
    }
    if (done.output && options_.positions)
        for (const ClothModel& cloth : model_.cloths) {
            const std::span<std::byte> bytes = pool_->buffer(position_readback_name(cloth), slot).mapped();
            result.positions.push_back(
                {reinterpret_cast<const float*>(bytes.data()), cloth.grid.particle_count() * 4});
        }
    if (done.output && options_.statistics) result.statistics = solver_.statistics(*pool_, slot);
    if (done.output) finished(result);
}

bool FrameLoop::run(std::uint32_t last, const std::function<bool(std::uint32_t)>& wanted,
                    const std::function<void(const FinishedFrame&)>& finished, const std::function<bool()>& stop) {
    bool complete = true;
    std::uint32_t next_slot = 0;
    for (std::uint32_t frame = 0; frame <= last; ++frame) {
        const bool output = wanted(frame);
        if (frame == 0 && !output) continue;  // the initial state is already there
        if (stop && stop()) {
            complete = false;
            break;
        }
        deliver(next_slot, finished);
        const FrameKind kind = frame == 0 ? FrameKind::initial
                               : output   ? FrameKind::simulate_and_output
                                          : FrameKind::simulate;
        submit(next_slot, frame, kind);
        next_slot = (next_slot + 1) % vulkan::frame_slot_count;
    }
    for (std::uint32_t slot = 0; slot < vulkan::frame_slot_count; ++slot)
        deliver((next_slot + slot) % vulkan::frame_slot_count, finished);
    return complete;
}

}  // namespace drape
