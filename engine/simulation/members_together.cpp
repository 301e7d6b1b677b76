// Members of one shape are one model to the solver: a step of all is one graph, whose dispatches they share.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <numeric>
#include <stdexcept>

#include "cloth/contact_state.h"
#include "cloth/members.h"
#include "simulation/contact_report.h"
#include "simulation/member_runs.h"
#include "solver/cloth_solver.h"
#include "solver/readback_pass.h"

namespace drape {

namespace {

struct Planned {
    graph::Graph graph;
    graph::Plan plan;
    std::unique_ptr<graph::RecordedPlan> recorded;
};

std::vector<const SimulationModel*> models_of(const Members& members, std::size_t count) {
    std::vector<const SimulationModel*> models;
    for (std::size_t k = 0; k < count; ++k) models.push_back(&members[k]->model);
    return models;
}

class MembersTogether : public MemberRuns {
  public:
    MembersTogether(const vulkan::Device& device, Members& members, std::size_t count, const MemberRunOptions& options)
        : device_(device),
          members_(members),
          options_(options),
          cloths_each_(members.front()->model.cloths.size()),
          all_(models_of(members, count)),
          solver_(device, all_, options.kernels),
          slots_(device) {
        plan_all();
    }
    std::uint64_t bytes() const { return graph::planned_bytes(plans()); }
    void begin() {
        allocate();
        submit(look_, 0);
        for (std::size_t k = 0; k < members_.size(); ++k) take_statistics(k);
        for (const auto& member : members_) start_statistics_.push_back(member->statistics);
    }

    void step(const std::function<void()>& meanwhile) override {
        if (meet()) still_failed();
        submit(step_, 1, meanwhile);
        while (meet() && lists_were_short()) submit(step_, 1);
        for (const auto& member : members_) ++member->frame;
        for (std::size_t k = 0; k < members_.size(); ++k) {
            take_statistics(k);
            if (std::optional<SelfContactReport>& report = members_[k]->self_contact)
                note_contact(*report, members_[k]->model, members_[k]->frame, solver_.self_record_of(*pool_, slot, k));
        }
    }

    void reset(std::span<const std::size_t> numbers) override {
        put_starts(numbers);
        if (meet()) put_borne(numbers, std::vector<std::vector<std::byte>>(numbers.size()));
        for (const std::size_t number : numbers) members_[number]->statistics = start_statistics_[number];
    }

    SimulationState save(std::size_t number) const override {
        std::vector<std::size_t> cloths(cloths_each_);
        std::iota(cloths.begin(), cloths.end(), number * cloths_each_);
        SimulationState state;
        const std::vector<ClothBytes> fields = solver_.download_cloths(*pool_, cloths);
        for (std::size_t k = 0; k < cloths_each_; ++k)
            for (const auto& [name, bytes] : fields[k]) state[fmt::format("field/{}/{}", k, name)] = bytes;
        if (meet()) state[borne_part] = solver_.download_borne(*pool_)[number];
        return state;
    }

    void restore(std::span<const std::size_t> numbers, std::span<const SimulationState> saved) override {
        std::vector<std::vector<std::byte>> borne;
        if (meet())
            for (std::size_t i = 0; i < numbers.size(); ++i) borne.push_back(borne_in(numbers[i], saved[i]));
        std::vector<ClothBytes> fields(numbers.size() * cloths_each_);
        std::map<std::size_t, const ClothBytes*> states;
        for (std::size_t i = 0; i < numbers.size(); ++i)
            for (std::size_t k = 0; k < cloths_each_; ++k) {
                ClothBytes& own = fields[i * cloths_each_ + k];
                const std::string prefix = fmt::format("field/{}/", k);
                for (const auto& [name, bytes] : saved[i])
                    if (name.starts_with(prefix)) own[name.substr(prefix.size())] = bytes;
                states[numbers[i] * cloths_each_ + k] = &own;
            }
        put(states);
        if (meet()) put_borne(numbers, borne);
    }

    void look() override {
        if (options_.normals) submit(look_, 0);
    }

    MemberArray array(std::size_t cloth, MemberValue value) const override {
        std::vector<float>& gathered = gathered_[{cloth, value}];
        if (value == MemberValue::velocity) return velocities(cloth, gathered);
        return array_of(value == MemberValue::position ? positions_ : normals_, cloth, gathered);
    }
    std::size_t pass_count() const override { return step_.plan.passes.size(); }
    double device_milliseconds() const override { return milliseconds_; }

  private:
    static constexpr std::uint32_t slot = 0;
    static constexpr const char* borne_part = "contact/borne";
    using Views = std::vector<std::span<const float>>;

    /// Returns whether members have contact of cloth with cloth: lists that may prove too short.
    bool meet() const { return all_.self_contact.has_value(); }

    void plan_all() {
        plan(look_, false);
        plan(step_, true);
        if (!meet()) return;
        for (const auto& [planned, step] : {std::pair{&keep_, AttemptStep::keep}, {&restore_, AttemptStep::restore}}) {
            *planned = {};
            solver_.declare(planned->graph, {});
            solver_.add_attempt(planned->graph, step);
            planned->plan = graph::make_plan(planned->graph);
        }
    }
    std::vector<Planned*> planned() {
        std::vector<Planned*> all{&look_, &step_};
        if (meet()) all.insert(all.end(), {&keep_, &restore_});
        return all;
    }
    void allocate() {
        pool_ = std::make_unique<graph::ResourcePool>(device_, plans());
        for (Planned* each : planned())
            each->recorded =
                std::make_unique<graph::RecordedPlan>(each->graph, each->plan, *pool_, graph::TimestampMode::stages);
        solver_.upload(*pool_);
        solver_.write_constants(*pool_, slot, all_.scene.solver.substeps);
        positions_ = solver_.readback(*pool_, slot, "position");
        moved_ = solver_.readback(*pool_, slot, "displacement");
        excess_ = solver_.readback(*pool_, slot, "excess displacement");
        if (options_.normals) normals_ = solver_.readback(*pool_, slot, "normal");
        records_ = solver_.statistics_records(*pool_, slot);
    }
    /// Gives the lists of contact the room that they now are to have.
    void allocate_anew() {
        const auto state = solver_.download_state(*pool_);
        for (Planned* each : planned()) each->recorded.reset();
        plan_all();
        pool_.reset();
        allocate();
        solver_.upload_state(*pool_, state);
    }

    /// Returns whether the step has to be taken again, from its start and with longer lists. Throws VulkanError where
    /// the device cannot list what it found.
    bool lists_were_short() {
        const glsl::SelfRecord record = solver_.self_record(*pool_, slot);
        const double use = solver_.self_list_use(record);
        if (use <= 1) return false;
        if (!solver_.grow_lists(record))
            throw vulkan::VulkanError(
                fmt::format("the members' cloths meet in more places than a buffer of the device can list: {:.3g} "
                            "times as many; fewer members, more substeps or a smaller self_collision.thickness make "
                            "them fewer",
                            use));
        slots_.submit(slot, restore_.recorded->commands(slot));
        slots_.wait(slot);
        allocate_anew();
        return true;
    }

    /// Members that failed begin each frame as they start: what is not finite would meet itself everywhere.
    void still_failed() {
        std::vector<std::size_t> failed;
        for (std::size_t k = 0; k < members_.size(); ++k) {
            members_[k]->judge();
            if (members_[k]->failure) failed.push_back(k);
        }
        if (!failed.empty()) put_starts(failed);
    }
    void put_starts(std::span<const std::size_t> numbers) {
        std::map<std::size_t, const ClothBytes*> states;
        for (const std::size_t number : numbers)
            for (std::size_t k = 0; k < cloths_each_; ++k) states[number * cloths_each_ + k] = nullptr;
        put(states);
    }
    /// Returns what pairs of a member bore in a saved state. Throws Error where it is not of this scene.
    std::vector<std::byte> borne_in(std::size_t number, const SimulationState& state) const {
        const auto part = state.find(borne_part);
        if (part == state.end() || !is_borne_state(part->second, *members_[number]->model.self_contact))
            throw Error("the saved state is not of this scene: what its contacts bore");
        return part->second;
    }
    void put_borne(std::span<const std::size_t> numbers, const std::vector<std::vector<std::byte>>& own) {
        std::vector<std::vector<std::byte>> all = solver_.download_borne(*pool_);
        for (std::size_t i = 0; i < numbers.size(); ++i) all[numbers[i]] = own[i];
        if (solver_.upload_borne(*pool_, all)) return;
        allocate_anew();
        if (!solver_.upload_borne(*pool_, all))
            throw vulkan::VulkanError("a buffer of the device has no room for what the members' contacts bore");
    }

    void plan(Planned& planned, bool simulates) {
        planned = {};
        graph::Graph& graph = planned.graph;
        solver_.declare(graph, {.drawing = options_.normals, .statistics = true});
        if (simulates) solver_.add_simulation(graph);
        add_look(graph, solver_, options_.normals);
        solver_.add_statistics(graph);
        planned.plan = graph::make_plan(graph);
    }
    std::vector<std::pair<const graph::Graph*, const graph::Plan*>> plans() const {
        std::vector<std::pair<const graph::Graph*, const graph::Plan*>> all{{&look_.graph, &look_.plan},
                                                                            {&step_.graph, &step_.plan}};
        if (meet()) all.insert(all.end(), {{&keep_.graph, &keep_.plan}, {&restore_.graph, &restore_.plan}});
        return all;
    }

    /// Runs it with every member's inputs of a frame `further` than the one that it is at.
    void submit(Planned& planned, std::uint32_t further, const std::function<void()>& meanwhile = {}) {
        inputs_.resize(members_.size());
        for (std::size_t k = 0; k < members_.size(); ++k)
            take_frame_inputs(members_[k]->model, members_[k]->frame + further, inputs_[k]);
        join_inputs(all_, inputs_, joined_);
        solver_.write_inputs(*pool_, slot, joined_, all_.scene.solver.substeps);
        std::vector<VkCommandBuffer> commands;
        if (further > 0 && meet()) commands.push_back(keep_.recorded->commands(slot));
        commands.push_back(planned.recorded->commands(slot));
        slots_.submit(slot, commands);
        if (meanwhile) meanwhile();
        slots_.wait(slot);
        milliseconds_ = 0;
        for (const graph::Timing& timing : planned.recorded->timings(slot)) milliseconds_ += timing.milliseconds;
    }

    void put(const std::map<std::size_t, const ClothBytes*>& states) {
        try {
            solver_.upload_cloths(*pool_, states);
        } catch (const std::invalid_argument& wrong) {
            throw Error(wrong.what());
        }
        // The arrays on the host are as a look would leave them, which is as long as a pass over all members.
        for (const auto& [cloth, state] : states)
            for (const auto& [field, views] :
                 {std::pair{Field::position, &positions_}, std::pair{Field::displacement, &moved_},
                  std::pair{Field::end_excess, &excess_}}) {
                const std::vector<std::byte> bytes =
                    state ? field_of(*state, field) : solver_.start_of_field(cloth, field);
                std::memcpy(const_cast<float*>((*views)[cloth].data()), bytes.data(), bytes.size());
            }
    }

    void take_statistics(std::size_t number) {
        Member& member = *members_[number];
        member.statistics.clear();
        member.effort.substeps = member.frame == 0 ? 0 : all_.scene.solver.substeps;
        for (std::size_t k = 0; k < cloths_each_; ++k) {
            glsl::StatisticsRecord record;
            std::memcpy(&record, records_[number * cloths_each_ + k].data(), sizeof record);
            member.statistics.push_back(cloth_statistics(member.model, member.model.cloths[k], record, member.frame));
        }
    }

    /// Returns the views of every member's cloth as one array, gathered first where they do not lie evenly.
    MemberArray array_of(const Views& views, std::size_t cloth, std::vector<float>& gathered) const {
        const Grid& grid = all_.cloths[cloth].grid;
        MemberArray array{nullptr, members_.size(), grid.rows(), grid.columns(),
                          std::size_t{4} * grid.particle_count()};
        const auto of = [&](std::size_t member) { return views[member * cloths_each_ + cloth]; };
        const std::ptrdiff_t stride = array.members > 1 ? of(1).data() - of(0).data() : 0;
        // Where lists grow, what the device left moves, and arrays that were handed out must stay.
        bool even = !meet() && (array.members == 1 || stride > 0);
        for (std::size_t k = 1; even && k < array.members; ++k) even = of(k).data() - of(k - 1).data() == stride;
        array.data = of(0).data();
        if (even && array.members > 1) array.member_stride = static_cast<std::size_t>(stride);
        if (even) return array;
        gathered.resize(array.member_stride * array.members);
        for (std::size_t k = 0; k < array.members; ++k)
            std::ranges::copy(of(k), gathered.begin() + static_cast<std::ptrdiff_t>(k * array.member_stride));
        array.data = gathered.data();
        return array;
    }

    MemberArray velocities(std::size_t cloth, std::vector<float>& gathered) const {
        const double per_second = all_.scene.time.fps * all_.scene.solver.substeps;
        const Grid& grid = all_.cloths[cloth].grid;
        const std::size_t stride = std::size_t{4} * grid.particle_count();
        gathered.resize(stride * members_.size());
        for (std::size_t k = 0; k < members_.size(); ++k) {
            const std::size_t at = k * cloths_each_ + cloth;
            write_velocities(moved_[at], excess_[at], per_second, std::span(gathered).subspan(k * stride, stride));
        }
        return {gathered.data(), members_.size(), grid.rows(), grid.columns(), stride};
    }

    const vulkan::Device& device_;
    Members& members_;
    MemberRunOptions options_;
    std::size_t cloths_each_;
    SimulationModel all_;
    ClothSolver solver_;
    Planned look_, step_;
    Planned keep_, restore_;  ///< of what a step begins with, where its members meet themselves
    std::unique_ptr<graph::ResourcePool> pool_;
    vulkan::FrameSlots slots_;  ///< goes, and waits for work in flight, before what that uses
    double milliseconds_ = 0;
    // The slot's last frame left these on the host, cloth by cloth, member by member.
    Views positions_, moved_, excess_, normals_;
    std::vector<std::span<const std::byte>> records_;
    std::vector<std::vector<ClothStatistics>> start_statistics_;  ///< by member
    std::vector<FrameInputs> inputs_;                             ///< by member
    FrameInputs joined_;
};

}  // namespace

void add_look(graph::Graph& graph, ClothSolver& solver, bool normals) {
    if (normals) {
        solver.add_normals(graph);
        solver.add_readback(graph, Field::normal, "normal");
    }
    solver.add_readback(graph, Field::position, "position");
    solver.add_readback(graph, Field::displacement, "displacement");
    solver.add_readback(graph, Field::end_excess, "excess displacement");
}

void check_room(const vulkan::Device& device, Members& two, std::size_t count, const MemberRunOptions& options) {
    check_bytes(device, MembersTogether(device, two, two.size(), options).bytes() / two.size(), count);
}

void check_bytes(const vulkan::Device& device, std::uint64_t each, std::size_t count) {
    const std::uint64_t room = device.budget().limit() - device.budget().used();
    if (each * count > room)
        throw vulkan::VulkanError(fmt::format("{} members need {} MiB, and the device has {} MiB left: {} fit", count,
                                              (each * count) >> 20, room >> 20, room / each));
}

std::unique_ptr<MemberRuns> run_together(const vulkan::Device& device, Members& members,
                                         const MemberRunOptions& options) {
    auto together = std::make_unique<MembersTogether>(device, members, members.size(), options);
    together->begin();
    return together;
}

}  // namespace drape
