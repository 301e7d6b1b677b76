// Members of one shape are one model to the solver: a step of all is one graph, whose dispatches they share.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <numeric>
#include <stdexcept>

#include "cloth/members.h"
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
        : members_(members),
          options_(options),
          cloths_each_(members.front()->model.cloths.size()),
          all_(models_of(members, count)),
          solver_(device, all_, options.kernels),
          slots_(device) {
        plan(look_, false);
        plan(step_, true);
    }
    std::uint64_t bytes() const { return graph::planned_bytes(plans()); }
    void allocate(const vulkan::Device& device) {
        pool_ = std::make_unique<graph::ResourcePool>(device, plans());
        for (Planned* planned : {&look_, &step_})
            planned->recorded = std::make_unique<graph::RecordedPlan>(planned->graph, planned->plan, *pool_,
                                                                      graph::TimestampMode::stages);
        solver_.upload(*pool_);
        solver_.write_constants(*pool_, slot, all_.scene.solver.substeps);
        positions_ = solver_.readback(*pool_, slot, "position");
        moved_ = solver_.readback(*pool_, slot, "displacement");
        excess_ = solver_.readback(*pool_, slot, "excess displacement");
        if (options_.normals) normals_ = solver_.readback(*pool_, slot, "normal");
        records_ = solver_.statistics_records(*pool_, slot);
        submit(look_, 0);
        for (std::size_t k = 0; k < members_.size(); ++k) take_statistics(k);
        for (const auto& member : members_) start_statistics_.push_back(member->statistics);
    }

    void step(const std::function<void()>& meanwhile) override {
        submit(step_, 1, meanwhile);
        for (const auto& member : members_) ++member->frame;
        for (std::size_t k = 0; k < members_.size(); ++k) take_statistics(k);
    }

    void reset(std::span<const std::size_t> numbers) override {
        std::map<std::size_t, const ClothBytes*> states;
        for (const std::size_t number : numbers)
            for (std::size_t k = 0; k < cloths_each_; ++k) states[number * cloths_each_ + k] = nullptr;
        put(states);
        for (const std::size_t number : numbers) members_[number]->statistics = start_statistics_[number];
    }

    SimulationState save(std::size_t number) const override {
        std::vector<std::size_t> cloths(cloths_each_);
        std::iota(cloths.begin(), cloths.end(), number * cloths_each_);
        SimulationState state;
        const std::vector<ClothBytes> fields = solver_.download_cloths(*pool_, cloths);
        for (std::size_t k = 0; k < cloths_each_; ++k)
            for (const auto& [name, bytes] : fields[k]) state[fmt::format("field/{}/{}", k, name)] = bytes;
        return state;
    }

    void restore(std::span<const std::size_t> numbers, std::span<const SimulationState> saved) override {
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
    using Views = std::vector<std::span<const float>>;

    void plan(Planned& planned, bool simulates) {
        graph::Graph& graph = planned.graph;
        solver_.declare(graph, {.drawing = options_.normals, .statistics = true});
        if (simulates) solver_.add_simulation(graph);
        if (options_.normals) {
            solver_.add_normals(graph);
            solver_.add_readback(graph, Field::normal, "normal");
        }
        solver_.add_readback(graph, Field::position, "position");
        solver_.add_readback(graph, Field::displacement, "displacement");
        solver_.add_readback(graph, Field::end_excess, "excess displacement");
        solver_.add_statistics(graph);
        planned.plan = graph::make_plan(graph);
    }
    std::array<std::pair<const graph::Graph*, const graph::Plan*>, 2> plans() const {
        return {{{&look_.graph, &look_.plan}, {&step_.graph, &step_.plan}}};
    }

    /// Runs it with every member's inputs of a frame `further` than the one that it is at.
    void submit(Planned& planned, std::uint32_t further, const std::function<void()>& meanwhile = {}) {
        inputs_.resize(members_.size());
        for (std::size_t k = 0; k < members_.size(); ++k)
            take_frame_inputs(members_[k]->model, members_[k]->frame + further, inputs_[k]);
        join_inputs(all_, inputs_, joined_);
        solver_.write_inputs(*pool_, slot, joined_, all_.scene.solver.substeps);
        slots_.submit(slot, planned.recorded->commands(slot));
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
        bool even = array.members == 1 || stride > 0;
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

    Members& members_;
    MemberRunOptions options_;
    std::size_t cloths_each_;
    SimulationModel all_;
    ClothSolver solver_;
    Planned look_, step_;
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

void check_room(const vulkan::Device& device, Members& two, std::size_t count, const MemberRunOptions& options) {
    const std::uint64_t each = MembersTogether(device, two, two.size(), options).bytes() / two.size();
    const std::uint64_t room = device.budget().limit() - device.budget().used();
    if (each * count > room)
        throw vulkan::VulkanError(fmt::format("{} members need {} MiB, and the device has {} MiB left: {} fit", count,
                                              (each * count) >> 20, room >> 20, room / each));
}

std::unique_ptr<MemberRuns> run_together(const vulkan::Device& device, Members& members,
                                         const MemberRunOptions& options) {
    auto together = std::make_unique<MembersTogether>(device, members, members.size(), options);
    together->allocate(device);
    return together;
}

}  // namespace drape
