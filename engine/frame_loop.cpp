#include "frame_loop.h"

#include <algorithm>
#include <cstring>

#include "passes/cut_pass.h"
#include "passes/readback_pass.h"

namespace drape {

namespace {

std::vector<RasterCloth> raster_cloths(const SimulationModel& model, const std::vector<ClothState>& states) {
    std::vector<RasterCloth> cloths;
    for (const ClothState& state : states) {
        const Cloth& cloth = model.scene.cloths[state.index];
        const Grid& grid = state.model->grid;
        cloths.push_back({cloth.name, grid.columns(), grid.rows(), cloth.size[0], cloth.size[1], cloth.appearance,
                          state[Field::position], state[Field::normal], state[Field::triangles], state.index_count,
                          state[Field::cut_vertices]});
    }
    return cloths;
}

}  // namespace

FrameLoop::FrameLoop(const vulkan::Device& device, const SimulationModel& model, const FrameLoopOptions& options)
    : device_(device), model_(model), options_(options), solver_(device, model_), slots_(device) {
    build_graphs();
    allocate_and_record();
    solver_.upload(*pool_);
}

void FrameLoop::build_graphs() {
    frames_ = {};
    const bool cut =
        std::ranges::any_of(solver_.topologies(), [](const CutTopology& t) { return !t.vertices().empty(); });
    if (options_.draw && (!raster_ || cut != draws_cut_)) {
        raster_ = std::make_unique<RasterPass>(device_, model_.scene, options_.width, options_.height, options_.samples,
                                               RasterOptions{.cut = cut});
        draws_cut_ = cut;
    }
    for (std::size_t kind = 0; kind < kind_count(); ++kind) build(static_cast<FrameKind>(kind));
}

void FrameLoop::allocate_and_record() {
    std::vector<std::pair<const graph::Graph*, const graph::Plan*>> plans;
    for (std::size_t kind = 0; kind < kind_count(); ++kind)
        plans.emplace_back(&frames_[kind].graph, &frames_[kind].plan);
    pool_.reset();
    pool_ = std::make_unique<graph::ResourcePool>(device_, plans);
    record();
}

void FrameLoop::record() {
    for (std::size_t kind = 0; kind < kind_count(); ++kind)
        frames_[kind].recorded = std::make_unique<graph::RecordedPlan>(frames_[kind].graph, frames_[kind].plan, *pool_,
                                                                       options_.timestamps, options_.barrier_filter);
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

bool FrameLoop::cutters_active_in(std::uint32_t frame) const {
    const double fps = model_.scene.time.fps;
    return cutters_active(model_.scene.cutters, frame == 0 ? 0 : (frame - 1) / fps, frame / fps);
}

void FrameLoop::take_cuts(std::uint32_t slot, std::uint32_t frame) {
    struct Hit {
        std::size_t cloth;
        CutFindings findings;
        CutImages before;
    };
    std::vector<Hit> hits;  // all are fetched before any resource changes
    for (std::size_t cloth = 0; cloth < model_.cloths.size(); ++cloth) {
        const ClothModel& model = model_.cloths[cloth];
        std::uint32_t crossed = 0;
        std::memcpy(&crossed, pool_->buffer(cut_count_name(model), slot).mapped().data(), sizeof crossed);
        if (crossed > 0) hits.push_back({cloth, read_findings(*pool_, model), solver_.cut_images(cloth)});
    }
    bool new_resources = false;
    for (const Hit& hit : hits) {
        CutTopology& topology = solver_.topologies()[hit.cloth];
        new_resources = new_resources || !topology.masked();
        const CutCounts counts = topology.apply(hit.findings);
        new_resources = new_resources || outgrown(hit.before, topology);
        if (options_.on_cut) options_.on_cut({frame, hit.cloth, counts}, topology);
    }
    if (new_resources) return rebuild_resources();
    for (const Hit& hit : hits) solver_.upload_cut(*pool_, hit.cloth, hit.before);
    if (hits.empty() || !options_.draw) return;
    build_graphs();  // how much is drawn is part of the recording
    record();
}

bool FrameLoop::outgrown(const CutImages& before, const CutTopology& topology) const {
    const auto other_size = [](std::size_t was, std::size_t is) {
        return (was == 0) != (is == 0) || draw_list_capacity(was) != draw_list_capacity(is);
    };
    return options_.draw && (other_size(before.index_count, topology.indices().size()) ||
                             other_size(before.vertex_count, topology.vertices().size()));
}

void FrameLoop::rebuild_resources() {
    const auto state = solver_.download_state(*pool_);
    for (Frame& frame : frames_) frame.recorded.reset();
    build_graphs();
    allocate_and_record();
    solver_.upload(*pool_);
    solver_.upload_state(*pool_, state);
}

void FrameLoop::build(FrameKind kind) {
    Frame& frame = frames_[static_cast<std::size_t>(kind)];
    const bool output = plain(kind) != FrameKind::simulate;
    solver_.declare(frame.graph, {.drawing = output && (options_.draw || options_.normals),
                                  .statistics = output && options_.statistics});
    if (plain(kind) != FrameKind::initial) solver_.add_simulation(frame.graph);
    if (searches_cuts(kind)) {
        solver_.add_cuts(frame.graph);
    } else {
        frame.graph.skip("cut search", model_.scene.cutters.empty() ? "no cutter in the scene"
                                                                    : "no cutter is active in this kind of frame");
    }
    if (output && (options_.draw || options_.normals)) solver_.add_normals(frame.graph);
    if (output && options_.draw)
        raster_->add(frame.graph, raster_cloths(model_, solver_.cloths()));
    else if (!options_.draw)
        frame.graph.skip(options_.normals ? "raster and colour readback" : "normals, raster and colour readback",
                         "no picture is wanted");
    if (output && options_.normals)
        for (ClothState state : solver_.cloths()) add_readback(frame.graph, state, state[Field::normal], "normal");
    if (output && options_.positions) {
        for (ClothState state : solver_.cloths()) add_readback(frame.graph, state, state[Field::position], "position");
    } else if (!options_.positions) {
        frame.graph.skip("position readback", "no position export is wanted");
    }
    if (output && options_.statistics)
        solver_.add_statistics(frame.graph);
    else if (!options_.statistics)
        frame.graph.skip("statistics", "nobody asked for them");
    frame.plan = graph::make_plan(frame.graph);
}

void FrameLoop::submit(std::uint32_t slot, std::uint32_t frame, FrameKind kind, bool output) {
    // The initial frame simulates nothing, but its statistics need to know where the colliders are.
    const double fps = model_.scene.time.fps;
    if (plain(kind) != FrameKind::initial || options_.statistics) solver_.write_inputs(*pool_, slot, frame);
    if (searches_cuts(kind)) solver_.write_cutters(*pool_, slot, frame == 0 ? 0 : (frame - 1) / fps, frame / fps);
    if (plain(kind) != FrameKind::simulate && raster_) raster_->write_frame(*pool_, slot, frame / fps);
    slots_.submit(slot, frames_[static_cast<std::size_t>(kind)].recorded->commands(slot));
    in_flight_[slot] = InFlight{frame, kind, output};
}

void FrameLoop::deliver(std::uint32_t slot, const std::function<void(const FinishedFrame&)>& finished) {
    slots_.wait(slot);
    if (!in_flight_[slot]) return;
    const InFlight done = *in_flight_[slot];
    in_flight_[slot].reset();
    FinishedFrame result;
    result.frame = done.frame;
    for (graph::Timing& timing : frames_[static_cast<std::size_t>(done.kind)].recorded->timings(slot))
        result.timings.push_back({std::move(timing.name), timing.milliseconds});
    if (done.output && options_.draw) {
        const std::span<std::byte> bytes = pool_->buffer(RasterPass::readback_name, slot).mapped();
        result.rgba = {reinterpret_cast<const std::uint8_t*>(bytes.data()), raster_->readback_byte_count()};
    }
    const auto read = [&](std::string_view what) {
        std::vector<std::span<const float>> arrays;
        for (const ClothModel& cloth : model_.cloths) {
            const std::span<std::byte> bytes = pool_->buffer(readback_name(cloth, what), slot).mapped();
            arrays.push_back({reinterpret_cast<const float*>(bytes.data()), cloth.grid.particle_count() * 4});
        }
        return arrays;
    };
    if (done.output && options_.positions) result.positions = read("position");
    if (done.output && options_.normals) result.normals = read("normal");
    if (done.output && options_.statistics) result.statistics = solver_.statistics(*pool_, slot);
    if (done.output) finished(result);
}

bool FrameLoop::run(std::uint32_t last, const std::function<bool(std::uint32_t)>& wanted,
                    const std::function<void(const FinishedFrame&)>& finished, const std::function<bool()>& stop) {
    bool complete = true;
    for (; next_frame_ <= last; ++next_frame_) {
        const std::uint32_t frame = next_frame_;
        const bool output = wanted(frame);
        const bool cutting = cutters_active_in(frame);
        if (frame == 0 && !output && !cutting) continue;  // the initial state is already there
        if (stop && stop()) {
            complete = false;
            break;
        }
        deliver(next_slot_, finished);
        const FrameKind kind = frame == 0 ? FrameKind::initial
                               : output   ? FrameKind::simulate_and_output
                                          : FrameKind::simulate;
        submit(next_slot_, frame, cutting ? with_cut_search(kind) : kind, output);
        const std::uint32_t slot = next_slot_;
        next_slot_ = (next_slot_ + 1) % vulkan::frame_slot_count;
        if (!cutting) continue;
        // A cut acts from the next frame on, always: so that frame waits for this one's findings.
        deliver(next_slot_, finished);
        deliver(slot, finished);
        take_cuts(slot, frame);
    }
    for (std::uint32_t slot = 0; slot < vulkan::frame_slot_count; ++slot)
        deliver((next_slot_ + slot) % vulkan::frame_slot_count, finished);
    return complete;
}

std::vector<std::uint32_t> FrameLoop::whole_triangles(std::size_t cloth) const {
    return solver_.topologies()[cloth].whole_triangles();
}

}  // namespace drape
