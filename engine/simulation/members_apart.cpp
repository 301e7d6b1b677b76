// Members whose steps differ have a frame loop each: with a device of its own, or in a lane of a server that takes what
// several ask for alike together.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "base/byte_stream.h"
#include "picture/frame_copy.h"
#include "simulation/frame_loop.h"
#include "simulation/lane_server.h"
#include "simulation/member_runs.h"

namespace drape {

namespace {

constexpr const char* frame_part = "last frame";

class MembersApart : public MemberRuns {
  public:
    MembersApart(const vulkan::Device& device, Members& members, const MemberRunOptions& options, bool in_lanes)
        : device_(device), members_(members), lanes_(members.size()) {
        loop_options_.draw = false;
        loop_options_.positions = loop_options_.velocities = loop_options_.statistics = true;
        loop_options_.normals = options.normals;
        loop_options_.kernels = options.kernels;
        loop_options_.keep_promises = false;
        frames_.resize(members.size());
        starts_.resize(members.size());
        over_.resize(members.size());
        if (in_lanes) make_servers(options);
        for (std::size_t k = 0; k < members.size(); ++k) {
            loops_.push_back(nullptr);
            try {
                make_loop(k);
            } catch (const vulkan::VulkanError& error) {
                throw vulkan::VulkanError(fmt::format("{} of {} members fit: {}", k, members.size(), error.what()));
            }
            if (!lanes_[k].server) starts_[k] = loops_[k]->save();
        }
        simulate(all_numbers());
    }

    void step(const std::function<void()>& meanwhile) override {
        meanwhile();
        for (const auto& member : members_) ++member->frame;
        simulate(all_numbers());
    }

    void reset(std::span<const std::size_t> numbers) override {
        for (const std::size_t number : numbers) {
            over_[number] = 0;
            if (!lanes_[number].server) {
                loops_[number]->restore(starts_[number]);
                continue;
            }
            lanes_[number].server->reset(lanes_[number].place);
            make_loop(number);
        }
        simulate({numbers.begin(), numbers.end()});
    }

    SimulationState save(std::size_t number) const override {
        if (!loops_[number]->can_save())
            throw Error(fmt::format("member {} cannot be saved in frame {}: method auto has begun a probe", number,
                                    members_[number]->frame));
        SimulationState state = loops_[number]->save();
        ByteWriter writer;
        const_cast<MembersApart*>(this)->transfer(writer, number);  // a writer changes nothing
        state[frame_part] = writer.take();
        return state;
    }

    void restore(std::span<const std::size_t> numbers, std::span<const SimulationState> states) override {
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            SimulationState state = states[i];
            const auto part = state.find(frame_part);
            if (part == state.end()) throw Error("the saved state is not of this scene: it has no last frame");
            ByteReader reader(part->second);
            transfer(reader, numbers[i]);
            state.erase(frame_part);
            loops_[numbers[i]]->restore(state);
            over_[numbers[i]] = 0;
        }
    }

    MemberArray array(std::size_t cloth, MemberValue value) const override {
        const Grid& grid = members_.front()->model.cloths[cloth].grid;
        const std::size_t stride = std::size_t{4} * grid.particle_count();
        std::vector<float>& gathered = gathered_[{cloth, value}];
        gathered.resize(stride * members_.size());
        for (std::size_t k = 0; k < members_.size(); ++k)
            std::ranges::copy(frames_[k][static_cast<std::size_t>(value)][cloth],
                              gathered.begin() + static_cast<std::ptrdiff_t>(k * stride));
        return {gathered.data(), members_.size(), grid.rows(), grid.columns(), stride};
    }
    std::size_t pass_count() const override {
        std::size_t count = 0;
        for (std::size_t k = 0; k < loops_.size(); ++k)
            if (!lanes_[k].server) count += loops_[k]->plan(FrameKind::simulate_and_output).passes.size();
        for (const auto& server : servers_) count += server->pass_count();
        return count;
    }

  private:
    /// It has an array for each MemberValue and cloth.
    using Frame = std::array<std::vector<std::vector<float>>, 3>;

    /// Where a member's loop has its lane.
    struct Seat {
        LaneServer* server = nullptr;  ///< null: the loop has a device of its own
        std::size_t place = 0;
    };

    /// Members of one method go along with each other.
    void make_servers(const MemberRunOptions& options) {
        std::map<SolverMethod, std::vector<std::size_t>> by_method;
        for (std::size_t k = 0; k < members_.size(); ++k)
            by_method[members_[k]->model.scene.solver.method].push_back(k);
        for (const auto& [method, numbers] : by_method) {
            std::vector<const SimulationModel*> models;
            for (const std::size_t number : numbers) models.push_back(&members_[number]->model);
            if (models.size() < 2 || !LaneServer::fits(device_, models, options)) continue;
            LaneServer* const server =
                servers_.emplace_back(std::make_unique<LaneServer>(device_, models, options)).get();
            server->allocate();
            for (std::size_t place = 0; place < numbers.size(); ++place) lanes_[numbers[place]] = {server, place};
        }
    }
    void make_loop(std::size_t number) {
        FrameLoopOptions options = loop_options_;
        if (const Seat& seat = lanes_[number]; seat.server) {
            options.lane = &seat.server->lane(seat.place);
            options.plans = false;
        }
        loops_[number] = std::make_unique<FrameLoop>(device_, members_[number]->model, options);
    }
    std::vector<std::size_t> all_numbers() const {
        std::vector<std::size_t> all(members_.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        return all;
    }

    /// Brings members to the frames that they are to be at.
    void simulate(const std::vector<std::size_t>& numbers) {
        std::map<LaneServer*, std::map<std::size_t, std::size_t>> by_server;  // numbers by place
        for (const std::size_t number : numbers) {
            if (over_[number]) continue;
            if (const Seat& seat = lanes_[number]; seat.server)
                by_server[seat.server][seat.place] = number;
            else
                simulate(number);
        }
        for (const auto& served : by_server) {
            const std::map<std::size_t, std::size_t>& seated = served.second;
            std::vector<std::size_t> places;
            for (const auto& [place, number] : seated) places.push_back(place);
            served.first->serve(places, [&](std::size_t place) { simulate(seated.at(place)); });
        }
    }

    void simulate(std::size_t number) {
        Member& member = *members_[number];
        const std::uint32_t frame = member.frame;
        try {
            loops_[number]->run(
                frame, [&](std::uint32_t each) { return each == frame; },
                [&](const FinishedFrame& finished) { keep(number, finished); });
        } catch (const FrameError& gave_up) {
            over_[number] = 1;
            member.failure = gave_up.failure();
        }
    }
    void keep(std::size_t number, const FinishedFrame& finished) {
        members_[number]->statistics = finished.statistics;
        members_[number]->effort = finished.effort;
        members_[number]->self_contact = loops_[number]->self_contact();
        const std::array all{&finished.positions, &finished.velocities, &finished.normals};
        for (std::size_t value = 0; value < all.size(); ++value) {
            frames_[number][value].clear();
            for (const std::span<const float> array : *all[value])
                frames_[number][value].emplace_back(array.begin(), array.end());
        }
    }
    template <class Archive>
    void transfer(Archive& archive, std::size_t number) {
        for (std::vector<std::vector<float>>& value : frames_[number])
            for (std::vector<float>& array : value) archive(array);
    }

    const vulkan::Device& device_;
    Members& members_;
    FrameLoopOptions loop_options_;
    std::vector<std::unique_ptr<LaneServer>> servers_;
    std::vector<Seat> lanes_;  ///< by member
    std::vector<std::unique_ptr<FrameLoop>> loops_;
    std::vector<SimulationState> starts_;  ///< of loops with a device of their own
    std::vector<Frame> frames_;
    std::vector<char> over_;  ///< a loop gave up, and stays where it was; not bits, as threads write them
};

}  // namespace

void check_lane_room(const vulkan::Device& device, Members& two, std::size_t count, const MemberRunOptions& options) {
    const std::vector<const SimulationModel*> models{&two[0]->model, &two[1]->model};
    const bool share =
        models[0]->scene.solver.method == models[1]->scene.solver.method && LaneServer::fits(device, models, options);
    if (share) check_bytes(device, LaneServer(device, models, options).bytes_each(), count);
}

std::unique_ptr<MemberRuns> run_apart(const vulkan::Device& device, Members& members, const MemberRunOptions& options) {
    return std::make_unique<MembersApart>(device, members, options, false);
}

std::unique_ptr<MemberRuns> run_in_lanes(const vulkan::Device& device, Members& members,
                                         const MemberRunOptions& options) {
    return std::make_unique<MembersApart>(device, members, options, true);
}

}  // namespace drape
