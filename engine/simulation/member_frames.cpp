#include "simulation/member_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <utility>

#include "base/byte_stream.h"
#include "simulation/member_state.h"
#include "solver/readback_pass.h"
#include "solver/state_transfer.h"

namespace drape {

namespace {

constexpr const char* arrays_part = "arrays";
constexpr std::array<std::string_view, 3> lasting_arrays{"position", "displacement", "excess displacement"};
constexpr std::array<Field, 3> lasting_fields{Field::position, Field::displacement, Field::end_excess};

FrameOptions frame_options(const SimulationModel& model, const MemberFrameOptions& wanted, bool lasting, bool alone) {
    FrameOptions options;
    options.draw = false;
    options.positions = options.velocities = options.statistics = options.judges = true;
    options.arrays_later = lasting;
    options.normals = wanted.normals;
    options.fields = model.scene.force_fields;
    options.kernels = wanted.kernels;
    if (model.closed_loop() && !alone) options.timestamps = graph::TimestampMode::none;
    return options;
}

/// Returns what was read back of one cloth among all of a server's, in its only slot.
std::span<const float> read_back(const FrameServer& server, std::size_t cloth, std::string_view what) {
    return read_back(server.graphs().layout(), server.graphs().pool(), 0, what)[cloth];
}

template <class Archive, class Arrays>
void transfer_arrays(Archive& archive, Arrays& all) {
    for (auto& value : all)
        for (auto& array : value) archive(array);
}

std::vector<const SimulationModel*> models_of(const Members& members, const std::vector<std::size_t>& numbers) {
    std::vector<const SimulationModel*> models;
    for (const std::size_t number : numbers) models.push_back(&members[number]->model);
    return models;
}

/// Returns whether one device can simulate all cloths of these members of a closed loop together.
bool fit_together(const vulkan::Device& device, const std::vector<const SimulationModel*>& models,
                  const Kernels& kernels) {
    const SimulationModel all(models);
    return ClothSolver(device, all, kernels, true).layout().all_together();
}

}  // namespace

MemberFrames::MemberFrames(const vulkan::Device& device, Members& members, const MemberFrameOptions& options,
                           bool share)
    : members_(members),
      options_(options),
      seats_(members.size()),
      arrays_(members.size()),
      starts_(members.size()),
      over_(members.size()) {
    for (const std::vector<std::size_t>& numbers : groups_of(device, share)) {
        try {
            make_group(device, numbers);
        } catch (const vulkan::VulkanError& error) {
            if (share) throw;
            throw vulkan::VulkanError(
                fmt::format("{} of {} members fit: {}", groups_.size(), members.size(), error.what()));
        }
    }
    for (std::size_t number = 0; number < members.size(); ++number)
        if (server_of(number).size() == 1) starts_[number] = saved_state(server_of(number), 0);
    std::vector<std::size_t> all(members.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    simulate(all);
    for (const auto& member : members) {
        start_statistics_.push_back(member->statistics);
        start_bodies_.push_back(member->bodies);
    }
}

std::vector<std::vector<std::size_t>> MemberFrames::groups_of(const vulkan::Device& device, bool share) const {
    std::map<SolverMethod, std::vector<std::size_t>> by_method;
    for (std::size_t number = 0; number < members_.size(); ++number)
        by_method[members_[number]->model.scene.solver.method].push_back(number);
    std::vector<std::vector<std::size_t>> groups;
    for (const auto& [method, numbers] : by_method) {
        const bool closed = members_[numbers.front()]->model.closed_loop();
        const bool together = share && (!closed || numbers.size() == 1 ||
                                        fit_together(device, models_of(members_, numbers), options_.kernels));
        if (together)
            groups.push_back(numbers);
        else
            for (const std::size_t number : numbers) groups.push_back({number});
    }
    return groups;
}

void MemberFrames::make_group(const vulkan::Device& device, const std::vector<std::size_t>& numbers) {
    const SimulationModel& first = members_[numbers.front()]->model;
    const bool alone = numbers.size() == 1;
    const bool lasting =
        !alone && !first.closed_loop() && !first.self_contact && !options_.normals && !first.scene.force_fields;
    FrameOptions options = frame_options(first, options_, lasting, alone);
    options.meanwhile = [this] {
        if (meanwhile_) std::exchange(meanwhile_, {})();
    };
    RunListener listener;
    listener.keep_promises = false;
    auto server = std::make_unique<FrameServer>(device, models_of(members_, numbers), options,
                                                std::vector(numbers.size(), listener));
    if (!alone) drape::check_room(device, server->graphs(), numbers.size());
    server->graphs().allocate();
    for (std::size_t place = 0; place < numbers.size(); ++place) seats_[numbers[place]] = {groups_.size(), place};
    groups_.push_back({numbers, std::move(server), lasting});
}

void MemberFrames::check_room(const vulkan::Device& device, const Members& two, std::size_t count,
                              const MemberFrameOptions& options) {
    const auto models = models_of(two, {0, 1});
    const SimulationModel& first = *models.front();
    if (first.closed_loop() && (first.scene.solver.method != models.back()->scene.solver.method ||
                                !fit_together(device, models, options.kernels)))
        return;
    FrameGraphs graphs(device, models, frame_options(first, options, false, false));
    drape::check_room(device, graphs, count);
}

/// Members that failed begin each frame from their start: values that are not finite would spread through shared work.
void MemberFrames::begin_still_failed(const Group& group) {
    if (group.server->size() == 1 || !group.server->graphs().joint().self_contact) return;
    std::vector<std::size_t> places;
    for (std::size_t place = 0; place < group.numbers.size(); ++place) {
        Member& member = *members_[group.numbers[place]];
        member.judge();
        if (member.failure) places.push_back(place);
    }
    if (!places.empty()) put_starts(*group.server, places);
}

void MemberFrames::step(const std::function<void()>& meanwhile) {
    for (const Group& group : groups_) begin_still_failed(group);
    // Groups are simulated one after the other, so with several groups nothing may be read while the device works.
    if (groups_.size() == 1 && !groups_.front().server->graphs().joint().closed_loop())
        meanwhile_ = meanwhile;
    else
        meanwhile();
    std::vector<std::size_t> all;
    for (std::size_t number = 0; number < members_.size(); ++number) {
        ++members_[number]->frame;
        all.push_back(number);
    }
    simulate(all);
    if (meanwhile_) std::exchange(meanwhile_, {})();
}

void MemberFrames::take_actions(std::size_t number) { server_of(number).graphs().take_actions(seats_[number].place); }

void MemberFrames::wake(std::size_t number) { server_of(number).member(seats_[number].place).pilot().wake(); }

void MemberFrames::simulate(const std::vector<std::size_t>& numbers) {
    for (const std::size_t number : numbers) {
        if (over_[number]) continue;
        const std::uint32_t frame = members_[number]->frame;
        server_of(number).ask(seats_[number].place,
                              {.last = frame,
                               .wanted = [frame](std::uint32_t each) { return each == frame; },
                               .finished = [this, number](const FinishedFrame& each) { keep(number, each); }});
    }
    const auto gave_up = [&](std::size_t number, const FrameError& error) {
        over_[number] = 1;
        members_[number]->failure = error.failure();
    };
    for (const Group& group : groups_) {
        try {
            group.server->serve();
        } catch (const FrameError& error) {  // a single member throws its own exception
            gave_up(group.numbers.front(), error);
        }
    }
    for (const std::size_t number : numbers) {
        const std::exception_ptr failure = server_of(number).failure(seats_[number].place);
        if (!failure || over_[number]) continue;
        try {
            std::rethrow_exception(failure);
        } catch (const FrameError& error) {
            gave_up(number, error);
        }
    }
}

void MemberFrames::keep(std::size_t number, const FinishedFrame& finished) {
    Member& member = *members_[number];
    member.statistics = finished.statistics;
    member.bodies = finished.bodies;
    member.effort = finished.effort;
    member.self_contact = server_of(number).member(seats_[number].place).self_contact();
    if (lasts(number)) return;
    const std::array<const std::vector<std::span<const float>>*, member_value_count> all{
        &finished.positions, &finished.velocities, &finished.normals, &finished.tensions, &finished.contact_forces};
    for (std::size_t value = 0; value < all.size(); ++value) {
        arrays_[number][value].clear();
        for (const std::span<const float> array : *all[value])
            arrays_[number][value].emplace_back(array.begin(), array.end());
    }
}

void MemberFrames::reset(std::span<const std::size_t> numbers) {
    std::vector<std::size_t> simulated;
    for (std::size_t k = 0; k < groups_.size(); ++k) {
        Group& group = groups_[k];
        std::vector<std::size_t> places;
        for (const std::size_t number : numbers)
            if (seats_[number].group == k) places.push_back(seats_[number].place);
        if (places.empty()) continue;
        const bool alone = group.server->size() == 1;
        if (alone) restore_states(*group.server, places, std::span(&starts_[group.numbers.front()], 1));
        if (!alone) put_starts(*group.server, places);
        for (const std::size_t place : places) {
            const std::size_t number = group.numbers[place];
            over_[number] = 0;
            if (!alone) group.server->put_run(place, group.server->fresh_run(place));
            if (!group.lasting)
                simulated.push_back(number);
            else
                put_back(number);
        }
    }
    simulate(simulated);
}

/// Shows the start of a member of a `lasting` group without simulating all members.
void MemberFrames::put_back(std::size_t number) {
    FrameServer& server = server_of(number);
    const Seat seat = seats_[number];
    const std::size_t each = server.graphs().cloths_each();
    for (std::size_t k = 0; k < lasting_arrays.size(); ++k)
        for (std::size_t cloth = 0; cloth < each; ++cloth) {
            const std::size_t place = seat.place * each + cloth;
            const std::vector<std::byte> bytes = start_of_field(server.graphs().layout(), place, lasting_fields[k]);
            std::memcpy(const_cast<float*>(read_back(server, place, lasting_arrays[k]).data()), bytes.data(),
                        bytes.size());
        }
    server.member(seat.place).skip_start();
    members_[number]->statistics = start_statistics_[number];
    members_[number]->bodies = start_bodies_[number];
}

SimulationState MemberFrames::save(std::size_t number) const {
    const FrameServer& server = server_of(number);
    const Seat seat = seats_[number];
    if (!server.member(seat.place).can_save())
        throw Error(fmt::format("member {} cannot be saved in frame {}: method auto has begun a probe", number,
                                members_[number]->frame));
    SimulationState state = saved_state(server, seat.place);
    if (lasts(number)) return state;
    ByteWriter writer;
    transfer_arrays(writer, arrays_[number]);
    state[arrays_part] = writer.take();
    return state;
}

void MemberFrames::restore(std::span<const std::size_t> numbers, std::span<const SimulationState> states) {
    std::vector<Arrays> arrays;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        arrays.push_back(arrays_[numbers[i]]);
        if (lasts(numbers[i])) continue;
        const auto part = states[i].find(arrays_part);
        if (part == states[i].end()) throw Error("the saved state is not of this scene: it has no arrays");
        ByteReader reader(part->second);
        transfer_arrays(reader, arrays.back());
    }
    for (std::size_t k = 0; k < groups_.size(); ++k) {
        std::vector<std::size_t> places;
        std::vector<SimulationState> own;
        for (std::size_t i = 0; i < numbers.size(); ++i)
            if (seats_[numbers[i]].group == k) {
                places.push_back(seats_[numbers[i]].place);
                own.push_back(states[i]);
            }
        if (!places.empty()) restore_states(*groups_[k].server, places, own);
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        over_[numbers[i]] = 0;
        arrays_[numbers[i]] = std::move(arrays[i]);
        if (lasts(numbers[i])) show(numbers[i], states[i]);
    }
}

void MemberFrames::show(std::size_t number, const SimulationState& state) {
    const FrameServer& server = server_of(number);
    const Seat seat = seats_[number];
    const std::size_t each = server.graphs().cloths_each();
    for (std::size_t k = 0; k < lasting_arrays.size(); ++k)
        for (std::size_t cloth = 0; cloth < each; ++cloth) {
            const std::vector<std::byte>& bytes =
                state.at(field_part(server.graphs().member(seat.place).cloths[cloth], lasting_fields[k]));
            std::memcpy(const_cast<float*>(read_back(server, seat.place * each + cloth, lasting_arrays[k]).data()),
                        bytes.data(), bytes.size());
        }
}

std::span<const float> MemberFrames::view(std::size_t number, std::size_t cloth, MemberValue value) const {
    return arrays_[number][static_cast<std::size_t>(value)][cloth];
}

MemberArray MemberFrames::array(std::size_t cloth, MemberValue value) const {
    const Grid& grid = members_.front()->model.cloths[cloth].grid;
    const std::size_t stride = std::size_t{4} * grid.particle_count();
    MemberArray array{nullptr, members_.size(), grid.rows(), grid.columns(), stride};
    std::vector<float>& gathered = gathered_[{cloth, value}];
    const auto own = [&](std::size_t member) { return std::span(gathered).subspan(member * stride, stride); };
    const Group& first = groups_.front();
    if (!first.lasting) {
        gathered.resize(stride * members_.size());
        for (std::size_t member = 0; member < members_.size(); ++member)
            std::ranges::copy(view(member, cloth, value), own(member).begin());
        array.data = gathered.data();
        return array;
    }
    // Members that share dispatches are one group. In what the device left, their positions may be evenly spaced.
    const FrameGraphs& graphs = first.server->graphs();
    const std::size_t each = graphs.cloths_each();
    const auto read = [&](std::string_view what) { return read_back(graphs.layout(), graphs.pool(), 0, what); };
    const auto positions = read("position");
    const auto of = [&](std::size_t member) { return positions[member * each + cloth].data(); };
    const std::ptrdiff_t step = of(1) - of(0);
    bool even = value == MemberValue::position && step > 0;
    for (std::size_t member = 1; even && member < members_.size(); ++member) even = of(member) - of(member - 1) == step;
    if (even) {
        array.data = of(0);
        array.member_stride = static_cast<std::size_t>(step);
        return array;
    }
    gathered.resize(stride * members_.size());
    array.data = gathered.data();
    const auto moved = read("displacement"), excess = read("excess displacement");
    const double per_second = graphs.joint().scene.time.fps * graphs.joint().scene.solver.substeps;
    for (std::size_t member = 0; member < members_.size(); ++member)
        if (const std::size_t k = member * each + cloth; value == MemberValue::velocity)
            write_velocities(moved[k], excess[k], per_second, own(member));
        else
            std::ranges::copy(positions[k], own(member).begin());
    return array;
}

void MemberFrames::refresh() const {
    for (const auto& [which, gathered] : gathered_) array(which.first, which.second);
}

std::size_t MemberFrames::pass_count() const {
    std::size_t count = 0;
    for (const Group& group : groups_) {
        FrameGraphs& graphs = group.server->graphs();
        const bool shares_closed = graphs.member_count() > 1 && graphs.joint().closed_loop();
        count += graphs.planned(graphs.contents(true, !shares_closed)).plan.passes.size();
    }
    return count;
}

double MemberFrames::device_milliseconds() const {
    return groups_.size() == 1 ? groups_.front().server->device_milliseconds() : 0;
}

}  // namespace drape
