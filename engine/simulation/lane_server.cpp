#include "simulation/lane_server.h"

#include <algorithm>
#include <cstring>
#include <thread>

#include "cloth/members.h"

namespace drape {

namespace {

constexpr std::uint32_t device_slot = 0;

std::vector<const SimulationModel*> pointers_to(const std::vector<SimulationModel>& models) {
    std::vector<const SimulationModel*> all;
    for (const SimulationModel& model : models) all.push_back(&model);
    return all;
}

bool compares(AttemptStep step) {
    using enum AttemptStep;
    return step == compare || step == compare_companion || step == compare_disturbed;
}

bool is_frame(const LanePart& part) { return part.kind == LanePart::Kind::substeps; }

/// Gives inputs of a member that takes no part the size that they have for so many substeps.
void fill(const SimulationModel& model, std::uint32_t substeps, FrameInputs& inputs) {
    inputs.wind.assign(model.windy ? substeps * (model.weighs ? 2u : 1u) : 0u, {});
    std::size_t records = 0;
    for (const std::vector<KeptCollider>& list : model.kept_colliders) records += list.size();
    inputs.colliders.assign(records, {});
    inputs.collider_sets = 1;
    inputs.pins.resize(model.cloths.size());
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
        inputs.pins[cloth].assign(model.cloths[cloth].dynamic_pins.size() * substeps, {});
}

}  // namespace

class LaneServer::Lane : public LoopLane {
  public:
    Lane(LaneServer& server, std::size_t place) : server_(server), place_(place) {}
    void submit(std::uint32_t slot, const LaneWork& work) override { server_.submit(place_, slot, work); }
    SimulationState download() const override { return server_.download(place_); }
    void upload(const SimulationState& state) override { server_.upload(place_, state); }
    LaneResult& result_in(std::uint32_t slot) { return results_[slot]; }

  private:
    LaneServer& server_;
    std::size_t place_;
};

LaneServer::LaneServer(const vulkan::Device& device, const std::vector<const SimulationModel*>& models,
                       const MemberRunOptions& options)
    : device_(device),
      models_(models),
      options_(options),
      cloths_each_(models.front()->cloths.size()),
      all_(models),
      solver_(device, all_, options.kernels, true),
      slots_(device),
      inputs_(models.size()),
      answered_(models.size()),
      waiting_(models.size()) {
    for (std::size_t place = 0; place < models.size(); ++place) lanes_.push_back(std::make_unique<Lane>(*this, place));
    plan_looks();
    plan_attempts();
    for (std::size_t k = 0; k < state_set_count; ++k)
        if (const auto set = static_cast<StateSet>(k); has(set)) plan_rung(set, rungs_[k][all_.scene.solver.substeps]);
}

LaneServer::~LaneServer() = default;

LoopLane& LaneServer::lane(std::size_t place) { return *lanes_[place]; }

bool LaneServer::fits(const vulkan::Device& device, const std::vector<const SimulationModel*>& models,
                      const MemberRunOptions& options) {
    const SimulationModel all(models);
    return ClothSolver(device, all, options.kernels, true).all_together();
}

std::uint64_t LaneServer::bytes_each() const { return graph::planned_bytes(plans()) / models_.size(); }

std::size_t LaneServer::pass_count() const { return rungs_[0].begin()->second.planned.plan.passes.size(); }

void LaneServer::plan_looks() {
    for (Planned* const planned : {&look_, &statistics_}) {
        solver_.declare(planned->graph, {.drawing = options_.normals, .statistics = planned == &statistics_});
        add_look(planned->graph, solver_, options_.normals);
        if (planned == &statistics_) solver_.add_statistics(planned->graph);
        planned->plan = graph::make_plan(planned->graph);
    }
}

void LaneServer::plan_attempts() {
    for (std::size_t set = 0; set < state_set_count; ++set)
        for (const AttemptStep step : attempt_steps(all_, static_cast<StateSet>(set))) {
            Planned& planned = attempts_[set][static_cast<std::size_t>(step)];
            solver_.declare(planned.graph, {}, all_, static_cast<StateSet>(set));
            solver_.add_attempt(planned.graph, step);
            planned.plan = graph::make_plan(planned.graph);
        }
}

void LaneServer::plan_rung(StateSet set, Rung& rung) {
    std::uint32_t substeps = 0;
    for (const auto& [each, planned] : rungs_[static_cast<std::size_t>(set)])
        if (&planned == &rung) substeps = each;
    std::vector<SimulationModel> own;
    own.reserve(models_.size());
    for (const SimulationModel* const model : models_) own.emplace_back(*model, substeps);
    rung.model = std::make_unique<SimulationModel>(pointers_to(own));
    graph::Graph& graph = rung.planned.graph;
    const bool is_run = set == StateSet::run;
    solver_.declare(graph, {.statistics = is_run}, *rung.model, set);
    solver_.add_simulation(graph);
    if (is_run) solver_.add_statistics(graph);
    rung.planned.plan = graph::make_plan(graph);
}

std::vector<std::pair<const graph::Graph*, const graph::Plan*>> LaneServer::plans() const {
    std::vector<std::pair<const graph::Graph*, const graph::Plan*>> all;
    const auto add = [&](const Planned& planned) {
        if (!planned.plan.passes.empty()) all.emplace_back(&planned.graph, &planned.plan);
    };
    add(look_);
    add(statistics_);
    for (const auto& set : attempts_) std::ranges::for_each(set, add);
    for (const auto& set : rungs_)
        for (const auto& [substeps, rung] : set) add(rung.planned);
    return all;
}

void LaneServer::record(Planned& planned) const {
    planned.recorded =
        std::make_unique<graph::RecordedPlan>(planned.graph, planned.plan, *pool_, graph::TimestampMode::none);
}

void LaneServer::allocate() {
    pool_ = std::make_unique<graph::ResourcePool>(device_, plans());
    record(look_);
    record(statistics_);
    for (std::size_t set = 0; set < state_set_count; ++set) {
        for (const AttemptStep step : attempt_steps(all_, static_cast<StateSet>(set)))
            record(attempts_[set][static_cast<std::size_t>(step)]);
        for (auto& [substeps, rung] : rungs_[set]) record(rung.planned);
    }
    solver_.upload(*pool_);
}

LaneServer::Rung& LaneServer::rung(StateSet set, std::uint32_t substeps) {
    Rung& rung = rungs_[static_cast<std::size_t>(set)][substeps];
    if (rung.planned.recorded) return rung;
    plan_rung(set, rung);
    record(rung.planned);
    return rung;
}

VkCommandBuffer LaneServer::commands_of(const LanePart& part) {
    switch (part.kind) {
        case LanePart::Kind::attempt:
            return attempts_[static_cast<std::size_t>(part.set)][static_cast<std::size_t>(part.step)]
                .recorded->commands(device_slot);
        case LanePart::Kind::substeps:
            return rung(part.set, part.substeps).planned.recorded->commands(device_slot);
        case LanePart::Kind::look:
            return look_.recorded->commands(device_slot);
        case LanePart::Kind::statistics:
            break;
    }
    return statistics_.recorded->commands(device_slot);
}

void LaneServer::serve(const std::vector<std::size_t>& places, const std::function<void(std::size_t)>& run) {
    running_ = places.size();
    failed_ = nullptr;
    std::vector<std::jthread> threads;
    for (const std::size_t place : places)
        threads.emplace_back([&, place] {
            std::exception_ptr thrown;
            try {
                run(place);
            } catch (...) {
                thrown = std::current_exception();
            }
            const std::scoped_lock lock(mutex_);
            if (thrown && !failed_) failed_ = thrown;
            if (--running_ == 0) asked_.notify_one();
        });
    std::unique_lock lock(mutex_);
    for (;;) {
        asked_.wait(lock, [&] { return running_ == 0; });
        const std::vector<std::size_t> group = largest_group();
        if (group.empty()) break;
        if (!failed_) {
            try {
                take(group);
            } catch (...) {
                failed_ = std::current_exception();
            }
        }
        for (const std::size_t place : group) {
            waiting_[place].work = nullptr;
            ++running_;
            answered_[place].notify_one();
        }
    }
    lock.unlock();
    threads.clear();
    if (failed_) std::rethrow_exception(failed_);
}

void LaneServer::submit(std::size_t place, std::uint32_t slot, const LaneWork& work) {
    std::unique_lock lock(mutex_);
    waiting_[place] = {&work, slot};
    if (--running_ == 0) asked_.notify_one();
    answered_[place].wait(lock, [&] { return waiting_[place].work == nullptr; });
    if (failed_) std::rethrow_exception(failed_);
}

std::vector<std::size_t> LaneServer::largest_group() const {
    std::map<std::vector<LanePart>, std::vector<std::size_t>> groups;
    for (std::size_t place = 0; place < waiting_.size(); ++place)
        if (waiting_[place].work) groups[waiting_[place].work->parts].push_back(place);
    const auto largest = std::ranges::max_element(groups, {}, [](const auto& group) { return group.second.size(); });
    return largest == groups.end() ? std::vector<std::size_t>() : largest->second;
}

void LaneServer::take(const std::vector<std::size_t>& places) {
    const LaneWork& first = *waiting_[places.front()].work;
    std::vector<VkCommandBuffer> all;
    for (const LanePart& part : first.parts) all.push_back(commands_of(part));
    write(first, places);
    slots_.submit(device_slot, all);
    slots_.wait(device_slot);
    hand_out(first, places);
}

void LaneServer::write(const LaneWork& first, const std::vector<std::size_t>& places) {
    std::vector<bool> present(all_.cloths.size());
    for (const std::size_t place : places)
        std::fill_n(present.begin() + static_cast<std::ptrdiff_t>(place * cloths_each_), cloths_each_, true);
    solver_.write_present(*pool_, device_slot, present);
    if (!first.changes.empty()) write_changes(places);
    const auto frame = std::ranges::find_if(first.parts, is_frame);
    if (frame != first.parts.end()) return write_frame(places, frame->substeps);
    solver_.write_constants(*pool_, device_slot, all_.scene.solver.substeps);
    if (first.parts.front().kind == LanePart::Kind::statistics) write_look(places);
}

void LaneServer::write_frame(const std::vector<std::size_t>& places, std::uint32_t substeps) {
    const SimulationModel& joint = *rung(StateSet::run, substeps).model;
    for (std::size_t place = 0; place < models_.size(); ++place) fill(*models_[place], substeps, inputs_[place]);
    for (const std::size_t place : places)
        take_frame_inputs(*waiting_[place].work->run, waiting_[place].work->frame, inputs_[place]);
    join_inputs(joint, inputs_, joined_);
    solver_.write_inputs(*pool_, device_slot, joined_, substeps);
    solver_.write_constants(*pool_, device_slot, substeps);
}

/// The statistics of a frame that was not simulated look for colliders where its last substep has them.
void LaneServer::write_look(const std::vector<std::size_t>& places) {
    const std::uint32_t substeps = all_.scene.solver.substeps;
    for (std::size_t place = 0; place < models_.size(); ++place) fill(*models_[place], substeps, inputs_[place]);
    for (const std::size_t place : places) {
        const LaneWork& work = *waiting_[place].work;
        const FrameInputs own = frame_inputs(*work.run, work.frame);
        const auto count = static_cast<std::ptrdiff_t>(own.colliders.size() / own.collider_sets);
        inputs_[place].colliders.assign(own.colliders.end() - count, own.colliders.end());
    }
    join_inputs(all_, inputs_, joined_);
    solver_.write_inputs(*pool_, device_slot, joined_, substeps);
}

void LaneServer::write_changes(const std::vector<std::size_t>& places) {
    std::vector<glsl::SubstepChange> all(all_.cloths.size());
    for (const std::size_t place : places)
        std::ranges::copy(waiting_[place].work->changes,
                          all.begin() + static_cast<std::ptrdiff_t>(place * cloths_each_));
    solver_.write_changes(*pool_, device_slot, all);
}

void LaneServer::hand_out(const LaneWork& first, const std::vector<std::size_t>& places) {
    using Kind = LanePart::Kind;
    const bool looks = first.parts.front().kind == Kind::look || first.parts.front().kind == Kind::statistics;
    const bool counts = std::ranges::any_of(first.parts, [](const LanePart& part) {
        return part.kind == Kind::statistics || (is_frame(part) && part.set == StateSet::run);
    });
    const bool differs = std::ranges::any_of(
        first.parts, [](const LanePart& part) { return part.kind == Kind::attempt && compares(part.step); });
    std::vector<std::span<const std::byte>> records;
    if (counts) records = solver_.statistics_records(*pool_, device_slot);
    std::vector<double> differences;
    if (differs) differences = solver_.differences(*pool_, device_slot);
    std::map<std::string_view, std::vector<std::span<const float>>> arrays;
    if (looks)
        for (const std::string_view what : {"position", "displacement", "excess displacement", "normal"})
            if (what != "normal" || options_.normals) arrays[what] = solver_.readback(*pool_, device_slot, what);
    for (const std::size_t place : places) {
        LaneResult& result = lanes_[place]->result_in(waiting_[place].slot);
        const auto own = [&](const auto& all) { return std::span(all).subspan(place * cloths_each_, cloths_each_); };
        result = {};
        if (counts)
            for (const std::span<const std::byte> bytes : own(records))
                std::memcpy(&result.statistics.emplace_back(), bytes.data(), sizeof(glsl::StatisticsRecord));
        if (differs) result.differences.assign(own(differences).begin(), own(differences).end());
        for (const auto& [what, all] : arrays)
            for (const std::span<const float> array : own(all))
                result.arrays[std::string(what)].emplace_back(array.begin(), array.end());
    }
}

SimulationState LaneServer::download(std::size_t place) const {
    std::vector<std::size_t> cloths;
    for (std::size_t k = 0; k < cloths_each_; ++k) cloths.push_back(place * cloths_each_ + k);
    SimulationState state;
    for (std::size_t k = 0; k < state_set_count; ++k) {
        const auto set = static_cast<StateSet>(k);
        if (!has(set)) continue;
        const std::vector<ClothBytes> fields = solver_.download_cloths(*pool_, cloths, set);
        for (const FieldRow& row : cloth_fields())
            for (std::size_t cloth = 0; cloth < cloths_each_; ++cloth)
                if (std::vector<std::byte> bytes = field_of(fields[cloth], row.field); !bytes.empty())
                    state[resource_name(models_[place]->cloths[cloth], row, set)] = std::move(bytes);
    }
    return state;
}

void LaneServer::upload(std::size_t place, const SimulationState& state) {
    for (std::size_t k = 0; k < state_set_count; ++k) {
        const auto set = static_cast<StateSet>(k);
        if (!has(set)) continue;
        std::vector<ClothBytes> fields(cloths_each_);
        std::map<std::size_t, const ClothBytes*> by_cloth;
        for (std::size_t cloth = 0; cloth < cloths_each_; ++cloth) {
            for (const FieldRow& row : cloth_fields())
                if (const auto found = state.find(resource_name(models_[place]->cloths[cloth], row, set));
                    found != state.end())
                    fields[cloth][std::string(row.name)] = found->second;
            by_cloth[place * cloths_each_ + cloth] = &fields[cloth];
        }
        solver_.upload_cloths(*pool_, by_cloth, set);
    }
}

void LaneServer::reset(std::size_t place) {
    std::map<std::size_t, const ClothBytes*> starts;
    for (std::size_t cloth = 0; cloth < cloths_each_; ++cloth) starts[place * cloths_each_ + cloth] = nullptr;
    for (std::size_t set = 0; set < state_set_count; ++set)
        if (has(static_cast<StateSet>(set))) solver_.upload_cloths(*pool_, starts, static_cast<StateSet>(set));
}

}  // namespace drape
